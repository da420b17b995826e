#include "common/voxel_map.hpp"

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

TEST(VoxelMap, IsUnknownWhereNothingWasWritten) {
  VoxelMap map(0.05);
  EXPECT_FALSE(map.isKnown({1, 2, 3}));
  map.set({1, 2, 3}, 17);
  EXPECT_TRUE(map.isOccupied({1, 2, 3}));
  EXPECT_FALSE(map.isKnown({1, 2, 4}));
  EXPECT_EQ(map.blockCount(), 1u);
}

TEST(VoxelMap, TheVoxelsOfABlockAreThoseOfItsOffsets) {
  const VoxelIndex block{-2, 0, 3};
  for (int offset = 0; offset < VoxelBlock::kVoxels; ++offset) {
    const VoxelIndex voxel = VoxelMap::voxelOf(block, offset);
    EXPECT_EQ(VoxelMap::blockOf(voxel), block);
    EXPECT_EQ(VoxelBlock::offsetOf(voxel), offset);
  }
}

TEST(VoxelMap, NegativeCoordinatesHaveVoxelsOfTheirOwn) {
  VoxelMap map(0.1);
  EXPECT_EQ(map.voxelAt({-0.05, 0.05, -0.15}), (VoxelIndex{-1, 0, -2}));
  EXPECT_EQ(VoxelMap::blockOf({-1, 8, -9}), (VoxelIndex{-1, 1, -2}));
  map.set({-1, -1, -1}, -8);
  EXPECT_TRUE(map.isFree({-1, -1, -1}));
  EXPECT_FALSE(map.isKnown({7, 7, 7}));
}

TEST(VoxelMap, TheCentreOfAVoxelIsInIt) {
  const VoxelMap map(0.05);
  for (const VoxelIndex voxel : {VoxelIndex{0, 0, 0}, VoxelIndex{-7, 12, 3}})
    EXPECT_EQ(map.voxelAt(map.centerOf(voxel)), voxel);
}

TEST(VoxelMap, ASnapshotKeepsWhatItShows) {
  VoxelMap map(0.05);
  map.set({1, 1, 1}, 17);
  map.set({100, 1, 1}, 17);
  VoxelMap snapshot = map.snapshot();
  EXPECT_EQ(snapshot.block({0, 0, 0}), map.block({0, 0, 0}));
  map.set({1, 1, 1}, -8);
  snapshot.set({2, 2, 2}, 5);
  EXPECT_TRUE(snapshot.isOccupied({1, 1, 1}));
  EXPECT_TRUE(map.isFree({1, 1, 1}));
  EXPECT_FALSE(map.isKnown({2, 2, 2}));
  EXPECT_EQ(snapshot.block({12, 0, 0}), map.block({12, 0, 0})) << "what nobody wrote to is still shared";
}

TEST(VoxelMap, BlocksAreListedInOrder) {
  VoxelMap map(0.05);
  for (const int x : {40, -40, 0, 16}) map.set({x, 0, 0}, 1);
  EXPECT_EQ(map.blocks(), (std::vector<VoxelIndex>{{-5, 0, 0}, {0, 0, 0}, {2, 0, 0}, {5, 0, 0}}));
}

}  // namespace
}  // namespace swiftlet::common
