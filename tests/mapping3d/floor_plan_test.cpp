#include "mapping3d/voxels/floor_plan.hpp"

#include <gtest/gtest.h>

namespace swiftlet::mapping3d {
namespace {

namespace occupancy = common::occupancy;

/// A table top at 0.7 m with free space below, in voxels of 0.1 m.
common::VoxelMap tableTop() {
  common::VoxelMap map(0.1);
  for (int z = 0; z < 7; ++z) map.set({-3, 4, z}, -8);
  map.set({-3, 4, 7}, 17);
  map.set({-3, 4, 8}, -40);
  return map;
}

TEST(FloorPlan, IsOccupiedWhereAnythingInTheBandIs) {
  const auto plan = floorPlan(tableTop(), 0.55, 0.85);
  EXPECT_TRUE(occupancy::isOccupied(plan.at({-3, 4})));
  EXPECT_TRUE(occupancy::isUnknown(plan.at({-2, 4})));
}

TEST(FloorPlan, IsFreeBelowTheTableTop) {
  EXPECT_TRUE(occupancy::isFree(floorPlan(tableTop(), 0.05, 0.65).at({-3, 4})));
  EXPECT_TRUE(occupancy::isFree(floorPlan(tableTop(), 0.82, 0.88).at({-3, 4})));
}

TEST(FloorPlan, IsUnknownWhereTheBandIsAboveEverything) {
  EXPECT_TRUE(knownExtent(floorPlan(tableTop(), 1.0, 2.0)).empty());
}

}  // namespace
}  // namespace swiftlet::mapping3d
