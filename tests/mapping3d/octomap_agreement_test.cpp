// The same points given to OctoMap and to our mapper leave the same voxels free and occupied.
#include <octomap/octomap.h>

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "mapping3d/voxels/voxel_mapper.hpp"
#include "tests/mapping3d/rooms.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

/// Voxels of one class: in both maps, and in at least one.
struct ClassAgreement {
  int in_both = 0;
  int in_either = 0;

  void count(bool ours, bool theirs) {
    in_both += ours && theirs;
    in_either += ours || theirs;
  }
  double share() const { return static_cast<double>(in_both) / in_either; }
};

struct Agreement {
  ClassAgreement free, occupied;
};

Agreement agreementOf(const VoxelMap& map, octomap::OcTree& tree) {
  tree.expand();
  Agreement agreement;
  std::size_t in_tree = 0;
  for (const VoxelIndex block : map.blocks()) {
    for (int i = 0; i < VoxelBlock::kVoxels; ++i) {
      const VoxelIndex voxel = VoxelMap::voxelOf(block, i);
      const Eigen::Vector3d center_m = map.centerOf(voxel);
      const octomap::OcTreeNode* node = tree.search(center_m.x(), center_m.y(), center_m.z());
      in_tree += node != nullptr;
      agreement.free.count(map.isFree(voxel), node != nullptr && node->getLogOdds() <= 0.0F);
      agreement.occupied.count(map.isOccupied(voxel), node != nullptr && node->getLogOdds() > 0.0F);
    }
  }
  // Leaves of the tree in blocks that our map does not have.
  const auto missed = static_cast<int>(tree.getNumLeafNodes() - in_tree);
  agreement.free.in_either += missed;
  agreement.occupied.in_either += missed;
  return agreement;
}

enum class Given { kDepths, kPoints };

Agreement agreementAfterFrames(unsigned seed, Given given, double shift_m = 0.0) {
  std::mt19937 random(seed);
  const Room room = randomRoom(random);
  // Depth images are drawn for the camera that flies; points have no pixels.
  const common::PinholeCamera camera = given == Given::kDepths ? xtion() : smallCamera();
  VoxelMapper mapper(VoxelConfig{});
  octomap::OcTree tree(0.05);
  for (int frame = 0; frame < 4; ++frame) {
    const common::Pose3 T_room_camera = randomView(room, random);
    const common::DepthImage depth = depthImage(room, camera, T_room_camera, random, 0.02, 0.0);
    const common::Pose3 T_map_camera = T_map_room * T_room_camera;
    std::vector<Eigen::Vector3d> points_map_m;
    octomap::Pointcloud cloud;
    for (int v = 0; v < depth.height_px; ++v)
      for (int u = 0; u < depth.width_px; ++u) {
        const float depth_m = depth.at(u, v);
        if (!common::isMeasured(depth_m)) continue;
        const Eigen::Vector3f point_m =
            (T_map_camera * camera.point_camera_m(u, v, static_cast<double>(depth_m))).cast<float>();
        points_map_m.emplace_back(point_m.cast<double>());
        cloud.push_back(point_m.x() + static_cast<float>(shift_m), point_m.y(), point_m.z());
      }
    if (given == Given::kDepths)
      mapper.insert(depth, camera, T_map_camera);
    else
      mapper.insert(raysFrom(T_map_camera.position_m, points_map_m));
    const Eigen::Vector3f origin_m = T_map_camera.position_m.cast<float>();
    tree.insertPointCloud(cloud, {origin_m.x(), origin_m.y(), origin_m.z()}, 5.0);
  }
  return agreementOf(mapper.map(), tree);
}

class AgreesWithOctomap : public testing::TestWithParam<Given> {};
INSTANTIATE_TEST_SUITE_P(Given, AgreesWithOctomap, testing::Values(Given::kDepths, Given::kPoints));

TEST_P(AgreesWithOctomap, InEachClass) {
  for (unsigned seed = 31; seed <= 34; ++seed) {
    const Agreement agreement = agreementAfterFrames(seed, GetParam());
    EXPECT_GE(agreement.free.in_both, 50'000) << seed;
    EXPECT_GE(agreement.occupied.in_both, 2'000) << seed;
    EXPECT_GE(agreement.free.share(), 0.99) << seed;
    EXPECT_GE(agreement.occupied.share(), 0.97) << seed;
    RecordProperty("free_" + std::to_string(seed), std::to_string(agreement.free.share()));
    RecordProperty("occupied_" + std::to_string(seed), std::to_string(agreement.occupied.share()));
  }
}

/// A tenth of a voxel is seen.
TEST(AgreementWithOctomap, FallsWhereTheirPointsAreShifted) {
  EXPECT_LT(agreementAfterFrames(31, Given::kDepths, 0.005).occupied.share(), 0.97);
}

}  // namespace
}  // namespace swiftlet::mapping3d
