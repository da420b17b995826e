// What blocks a path today and may be gone tomorrow: people, and what came to where the vehicle flew before. A map
// without it tells a way that is blocked for a time from one that is walled.
//
//   grid, people, trail --> things that may go --> the grid without them --> a path only there: blocked for a time
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/disc.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::autonomy {

struct MayGo {
  common::Disc disc;     ///< All that is mapped in it goes with it.
  const char* who = "";  ///< "a person".
  bool came = true;      ///< It was not there before; else it has only the size of a person.
};

/// Whether a look at its target was one past what stands at the place: it counts no longer once that has gone.
bool isLookPast(const planning::ExplorationAttempt& attempt, const Eigen::Vector2d& place_map_m);

/// Remembers where people went who are not tracked any more: who stands still is soon part of the map. Not thread-safe.
class WhoMayGo {
 public:
  /// Once for each update of the map.
  void remember(std::span<const common::DynamicObstacle> people, const planning::CostMap& map);

  /// What may go in that map. `flown_map_m` is the vehicle's trail: what stands in it came later. What has once stood
  /// alone is remembered: of somebody who sways a laser soon draws pieces, none of which is as wide as a person.
  std::vector<MayGo> in(const planning::CostMap& map, std::span<const Eigen::Vector2d> flown_map_m);

 private:
  struct Person {
    int id = 0;
    Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  };
  std::vector<Person> people_;       ///< Where they last moved, the newest last.
  std::vector<common::Disc> stood_;  ///< What stood alone, and has not gone.
};

/// The grid as if all of them had gone, with room for a hull in what they hide.
common::OccupancyGrid gridWithout(std::span<const MayGo> things, const common::OccupancyGrid& grid);

}  // namespace swiftlet::autonomy
