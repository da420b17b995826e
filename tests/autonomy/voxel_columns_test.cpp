// A column of voxels is free only where all of it was seen to be.
#include "autonomy/planning_jobs/voxel_columns.hpp"

#include <gtest/gtest.h>

#include "tests/autonomy/voxel_room.hpp"

namespace swiftlet::autonomy {
namespace {

struct Columns : testing::Test {
  ColumnState at(double x_m, double y_m, double low_m = 0.2, double high_m = 0.8) {
    return VoxelColumns(*room.layer(), low_m, high_m, {x_m, y_m}, 6.0).at({x_m, y_m});
  }
  Columns() { room.draw({0, 0, 0.1}, {2, 2, 1.0}, VoxelRoom::kSeenFree); }
  VoxelRoom room;
};

TEST_F(Columns, SeenSpaceIsFree) {
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kFree);
  EXPECT_EQ(at(3.0, 1.0), ColumnState::kUnknown) << "nobody looked there";
}

TEST_F(Columns, WhereAPartWasNotSeenItIsUnknown) { EXPECT_EQ(at(1.0, 1.0, 0.2, 1.2), ColumnState::kUnknown); }

TEST_F(Columns, TheVoxelsOfTheFloorCountAsNothing) {
  room.draw({0, 0, 0.0}, {2, 2, 0.1}, VoxelRoom::kSeenOccupied);
  EXPECT_EQ(at(1.0, 1.0, 0.0, 0.8), ColumnState::kFree);
}

TEST_F(Columns, ABeamInItMakesItOccupiedAndOneAboveDoesNot) {
  room.draw({0.9, 0, 0.75}, {1.1, 2, 1.0}, VoxelRoom::kSeenOccupied);
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kOccupied);
  EXPECT_EQ(at(1.0, 1.0, 0.2, 0.7), ColumnState::kFree);
}

TEST_F(Columns, WhatOneFrameSawIsNeitherFreeNorOccupied) {
  room.draw({0.9, 0, 0.5}, {1.1, 2, 0.6}, 17);
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kUnknown);
}

TEST_F(Columns, WhatALaterSubmapSawFreeHasGone) {
  room.draw({0.9, 0.9, 0.1}, {1.1, 1.1, 1.0}, VoxelRoom::kSeenOccupied);
  room.beginSubmap(1.5);
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kOccupied);
  room.draw({0, 0, 0.1}, {2, 2, 1.0}, VoxelRoom::kSeenFree);
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kFree);
}

TEST_F(Columns, WhatWasSeenAfterTheOtherSubmapWasBegunIsThere) {
  room.draw({0.9, 0.9, 0.1}, {1.1, 1.1, 1.0}, VoxelRoom::kSeenOccupied);
  room.beginSubmap(1.5, -1);
  room.draw({0, 0, 0.1}, {2, 2, 1.0}, VoxelRoom::kSeenFree);
  EXPECT_EQ(at(1.0, 1.0), ColumnState::kOccupied);
}

}  // namespace
}  // namespace swiftlet::autonomy
