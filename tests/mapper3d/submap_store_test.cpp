// Which submap a frame is drawn into, and what a submap says of itself.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "mapping3d/model/submap_store.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::KeyPoses;
using common::Pose3;
using common::Submap3d;

/// Frames seen along a line there and back, placed by key scans.
struct Commute {
  TexturedRoom room;
  SubmapConfig config;
  std::shared_ptr<const KeyPoses> scans;

  Commute() {
    config.reach_m = 0.5;
    auto placed = std::make_shared<KeyPoses>();
    placed->keys.resize(100);
    scans = placed;
  }
  void fly(SubmapStore& store, double from_m, double to_m, int scan) const {
    constexpr int kFrames = 12;
    for (int i = 0; i < kFrames; ++i) {
      const Pose3 pose{Eigen::Quaterniond::Identity(), {from_m + (to_m - from_m) * i / (kFrames - 1), 0.0, 0.0}};
      const common::RgbdFrame frame = room.seen(pose, 0.1 * i);
      store.draw({frame, frame, pose, scan, {}, false}, *scans);
    }
  }
  SubmapStore store() const { return {config, VoxelConfig(), vision::DepthNoiseConfig()}; }
};

TEST(SubmapStore, GoesOnWhereTheCameraComesBack) {
  const Commute commute;
  SubmapStore store = commute.store();
  commute.fly(store, -0.6, 0.6, 0);
  const std::vector<Submap3d> there = store.snapshot();
  ASSERT_EQ(there.size(), 3u);
  commute.fly(store, 0.6, -0.6, 5);
  commute.fly(store, -0.6, 0.6, 0);
  const std::vector<Submap3d> back = store.snapshot();
  ASSERT_EQ(back.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(back[i].T_key_submap.position_m.isApprox(there[i].T_key_submap.position_m));
    // Its points are those of before, averaged with the new ones.
    ASSERT_GE(back[i].points->size(), there[i].points->size());
    for (std::size_t k = 0; k < there[i].points->size(); k += 97)
      EXPECT_LT(((*back[i].points)[k].position_m - (*there[i].points)[k].position_m).norm(), 0.035F);
    EXPECT_GE(back[i].voxels->blockCount(), there[i].voxels->blockCount());
  }
}

TEST(SubmapStore, SaysWhichFramesAreInASubmap) {
  const Commute commute;
  SubmapStore store = commute.store();
  commute.fly(store, -0.6, 0.6, 0);
  const std::vector<Submap3d> there = store.snapshot();
  ASSERT_EQ(there.size(), 3u);
  EXPECT_EQ(there[0].first_frame, 0u);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ(there[i].first_frame, there[i - 1].last_frame + 1);
  EXPECT_EQ(there[2].last_frame, 11u) << "twelve frames in all";
  commute.fly(store, 0.6, -0.6, 0);
  const Submap3d first = store.snapshot().front();
  EXPECT_EQ(first.first_frame, 0u);
  EXPECT_EQ(first.last_frame, 23u) << "it has gone on";
}

TEST(SubmapStore, SaysHowManyPointsAreOfLargeCubes) {
  const Commute commute;
  for (const double sigma_per_m2 : {1e-3, 1.0}) {
    SubmapStore store(commute.config, VoxelConfig(), vision::DepthNoiseConfig{sigma_per_m2});
    commute.fly(store, -0.6, 0.6, 0);
    for (const Submap3d& submap : store.snapshot())
      EXPECT_EQ(submap.coarse, sigma_per_m2 < 0.5 ? 0u : submap.points->size());
  }
}

TEST(SubmapStore, AfterALongPathANewOneBegins) {
  const Commute commute;
  SubmapStore store = commute.store();
  commute.fly(store, -0.6, 0.6, 0);
  commute.fly(store, 0.6, -0.6, 60);
  EXPECT_GT(store.snapshot().size(), 4u);
  // The vehicle is placed by an old key scan again.
  const std::size_t submaps = store.snapshot().size();
  commute.fly(store, -0.6, 0.6, 1);
  EXPECT_EQ(store.snapshot().size(), submaps);
}

TEST(SubmapStore, ASnapshotKeepsItsVoxelsWhenTheSubmapGoesOn) {
  const Commute commute;
  VoxelConfig unsaturated;
  unsaturated.least_log_odds = -6.0;
  SubmapStore store(commute.config, unsaturated, vision::DepthNoiseConfig());
  commute.fly(store, -0.6, 0.6, 0);
  const Submap3d first = store.snapshot().front();
  const common::VoxelIndex voxel = first.voxels->voxelAt({1.0, 0.02, 0.02});
  ASSERT_LT(first.voxels->evidence(voxel), 0);
  const std::int8_t before = first.voxels->evidence(voxel);
  commute.fly(store, 0.6, -0.6, 0);
  EXPECT_EQ(first.voxels->evidence(voxel), before);
  EXPECT_NE(store.snapshot().front().voxels->evidence(voxel), before) << "it was seen again";
}

}  // namespace
}  // namespace swiftlet::mapping3d
