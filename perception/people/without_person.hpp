// The map and the discs of people, without one person: the world in which a path behind that person is planned. A
// person who stands is mapped, and the map takes seconds to forget it.
#pragma once

#include <vector>

#include "common/disc.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/people/person_watch.hpp"
#include "perception/people/seen_points.hpp"

namespace swiftlet::perception {

/// Occupied cells on the person's trail, those near the person, and those near the trail that the newest scan sees
/// past, are free; `grid` is a snapshot, `seen` null before the first scan. The person is known.
common::OccupancyGrid mapWithout(const PersonWatch& person, common::Time now, const common::OccupancyGrid& grid,
                                 const SeenPoints* seen);
/// Without the present and predicted places of the person, who is known.
std::vector<common::Disc> discsWithout(const PersonWatch& person, common::Time now, std::vector<common::Disc> discs);

}  // namespace swiftlet::perception
