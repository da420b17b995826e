// The volume that was seen: the fused map, and what only the newest submaps know, at their places.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "autonomy/planning_jobs/seen_volume.hpp"
#include "common/key_pose.hpp"
#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

using common::VoxelMap;

std::shared_ptr<const VoxelMap> voxelsWith(const Eigen::Vector3d& point_m, std::int8_t evidence) {
  auto voxels = std::make_shared<VoxelMap>(0.1);
  voxels->set(voxels->voxelAt(point_m), evidence);
  return voxels;
}

struct SeenVolume : testing::Test {
  /// A submap whose key scan stands at (10, 0), turned to the left, so that its x axis is y of the map.
  void add(const Eigen::Vector3d& point_submap_m, std::int8_t evidence) {
    submaps.push_back(
        {0, {}, std::make_shared<const std::vector<common::SurfacePoint>>(), voxelsWith(point_submap_m, evidence)});
  }
  std::int8_t evidenceAt(const Eigen::Vector3d& point_map_m) {
    layer.submaps = std::make_shared<const std::vector<common::Submap3d>>(submaps);
    auto keys = std::make_shared<common::KeyPoses>();
    keys->keys.push_back({{}, {10.0, 0.0, 0.5 * M_PI}});
    layer.keys = keys;
    const auto seen = seenVolume(layer);
    return seen ? seen->evidence(seen->voxelAt(point_map_m)) : common::VoxelBlock::kUnknown;
  }
  std::vector<common::Submap3d> submaps;
  common::Map3dLayer layer;
};

TEST_F(SeenVolume, HasWhatANewSubmapKnowsAtItsPlace) {
  EXPECT_EQ(evidenceAt({9.75, 2.05, 1.05}), common::VoxelBlock::kUnknown) << "nothing was seen";
  add({2.05, 0.25, 1.05}, -20);
  EXPECT_EQ(evidenceAt({9.75, 2.05, 1.05}), -20);
  EXPECT_EQ(evidenceAt({2.05, 0.25, 1.05}), common::VoxelBlock::kUnknown) << "that is in the frame of the submap";
}

TEST_F(SeenVolume, TakesTheFusedMapFirstAndTheNewestSubmapBeforeOlderOnes) {
  layer.fused = voxelsWith({9.75, 2.05, 1.05}, 30);
  add({2.05, 0.25, 1.05}, -20);
  EXPECT_EQ(evidenceAt({9.75, 2.05, 1.05}), 30);
  EXPECT_EQ(layer.fused->evidence(layer.fused->voxelAt({9.75, 2.05, 1.05})), 30);
  add({3.05, 0.25, 1.05}, -20);
  add({3.05, 0.25, 1.05}, 20);
  EXPECT_EQ(evidenceAt({9.75, 3.05, 1.05}), 20);
  EXPECT_FALSE(layer.fused->isKnown(layer.fused->voxelAt({9.75, 3.05, 1.05}))) << "others read the fused map";
}

}  // namespace
}  // namespace swiftlet::autonomy
