// A map of the place that was made before the flight.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/occupancy_grid.hpp"
#include "common/pose2.hpp"

namespace swiftlet::common {

struct GivenMap {
  std::shared_ptr<const OccupancyGrid> grid;  ///< Must be usable (perception::Localizer::whyUnusable).
  Pose2 T_given_grid;                         ///< Places the grid in `given`, the frame of the map's file.
  std::uint64_t seed = 1;                     ///< Seed of the particles.
  std::string name = {};                      ///< Its file, for messages.
};

/// A given map that a mission may load.
struct OfferedMap {
  std::string file;  ///< As missions name it.
  GivenMap map;
};

}  // namespace swiftlet::common
