// Random floors of corridors. The settings of the SLAM were not tuned on them, so they show the effect of a change on
// unknown buildings.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::benchmarks {

struct FloorPlan {
  test::PlanarWorld world;
  std::vector<Eigen::Vector2d> corners_m;  ///< The corners of a drive through all of its corridors, in order.
};

/// A ring of corridors, 120 m by 80 m and 2.4 m wide, with a corridor across; along the walls closed doors, pillars,
/// cabinets and open rooms with furniture. The same for the same seed.
FloorPlan makeFloorPlan(std::uint64_t seed);

}  // namespace swiftlet::benchmarks
