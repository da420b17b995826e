// Explorations of a volume by an ideal depth camera: they end, and nothing that it could see is left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "common/voxel_map.hpp"
#include "grid_builder.hpp"
#include "planning/exploration/exploration.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight_m = 2.4, kCamera_m = 1.0;

/// A room of 6 m by 4 m that the laser knows, seen by a camera that is turned to each viewpoint at once.
struct CameraRoom : testing::Test {
  CameraRoom() {
    common::OccupancyGrid grid = test::room(120, 80);
    auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
    map->update(grid.snapshot(), {});
    input.cost_map = map;
    input.pose_map = {2.0, 2.0, 0.0};
    input.leave_building = true;
    config.camera = CameraFrustum{std::tan(0.506), 0.75 * std::tan(0.506), 0.17, 0.8, 5.0};
    show();
  }

  void show() { input.volume = {std::make_shared<const common::VoxelMap>(seen.snapshot()), kCamera_m}; }

  static bool isInside(const Vector3d& p) {
    return p.x() > 0.0 && p.x() < 6.0 && p.y() > 0.0 && p.y() < 4.0 && p.z() > 0.0 && p.z() < kHeight_m;
  }

  void look(const common::Pose2& pose) {
    constexpr int kAcross = 60, kUp = 45;
    const CameraFrustum& camera = *config.camera;
    const Eigen::AngleAxisd turn(pose.yaw_rad, Vector3d::UnitZ()), pitch(camera.pitch_down_rad, Vector3d::UnitY());
    const Vector3d from(pose.x_m, pose.y_m, kCamera_m);
    for (int i = 0; i < kAcross * kUp; ++i) {
      const Vector3d ray = turn * pitch *
                           Vector3d(1.0, camera.tangent_across * (2.0 * (i % kAcross) / (kAcross - 1) - 1.0),
                                    camera.tangent_up * (2.0 * (i / kAcross) / (kUp - 1) - 1.0));
      for (double depth_m = camera.range_min_m; depth_m < camera.range_max_m; depth_m += 0.04) {
        const Vector3d point = from + depth_m * ray;
        seen.set(seen.voxelAt(point), isInside(point) ? -40 : 40);
        if (!isInside(point)) break;
      }
    }
  }

  /// Until it is done. Returns the number of looks.
  int explore(bool sees) {
    int looks = 0;
    for (ExplorationResult result = exploreByCameraTour(input, config); !result.done && looks < 200;
         result = exploreByCameraTour(input, config)) {
      if (!result.next) {
        ADD_FAILURE() << result.reason;
        return looks;
      }
      EXPECT_GT(result.next->gain_m3, 0.0) << "the laser knows all of the room";
      input.pose_map = result.next->pose_map;
      if (sees) look(input.pose_map);
      show();
      input.attempts.push_back(attemptFrom(*result.next));
      ++looks;
    }
    return looks;
  }

  /// The room is convex, so that a place sees what lies within its picture.
  bool couldBeSeen(const Vector3d& point) const {
    const CameraFrustum& camera = *config.camera;
    for (double x = 0.5; x <= 5.5; x += 0.25)
      for (double y = 0.5; y <= 3.5; y += 0.25) {
        const double away_m = (point.head<2>() - Vector2d(x, y)).norm(), above_m = point.z() - kCamera_m;
        const double depth_m = away_m * std::cos(camera.pitch_down_rad) - above_m * std::sin(camera.pitch_down_rad);
        const double up_m = away_m * std::sin(camera.pitch_down_rad) + above_m * std::cos(camera.pitch_down_rad);
        if (depth_m > camera.range_min_m && depth_m < camera.range_max_m &&
            std::abs(up_m) < camera.tangent_up * depth_m)
          return true;
      }
    return false;
  }

  double unseenShare() const {
    int could = 0, unseen = 0;
    for (double x = 0.1; x < 6.0; x += 0.2)
      for (double y = 0.1; y < 4.0; y += 0.2)
        for (double z = 0.1; z < kHeight_m; z += 0.2) {
          if (!couldBeSeen({x, y, z})) continue;
          ++could;
          bool known = false;
          for (int i = 0; i < 8; ++i)
            known |= seen.isKnown(
                seen.voxelAt({x + (i & 1 ? 0.05 : -0.05), y + (i & 2 ? 0.05 : -0.05), z + (i & 4 ? 0.05 : -0.05)}));
          unseen += known ? 0 : 1;
        }
    return static_cast<double>(unseen) / could;
  }

  common::VoxelMap seen{0.1};
  ExplorationInput input;
  ExplorerConfig config;
};

TEST_F(CameraRoom, EndsWhenAllThatCouldBeSeenWasSeen) {
  EXPECT_GT(unseenShare(), 0.99) << "at the beginning";
  const int looks = explore(true);
  RecordProperty("looks", looks);
  RecordProperty("unseen_share", fmt::format("{:.4f}", unseenShare()));
  EXPECT_LT(looks, 30);
  EXPECT_LT(unseenShare(), 0.01);
}

TEST_F(CameraRoom, WhatASecondLookDoesNotShowIsNotLookedAtAgain) {
  const int looks = explore(false);
  EXPECT_GT(looks, 3);
  EXPECT_LT(looks, 60);
}

TEST_F(CameraRoom, ExpectsNothingBehindWallsThatTheLaserKnows) {
  for (double x = 0.05; x < 6.0; x += 0.1)
    for (double y = 0.05; y < 4.0; y += 0.1)
      for (double z = 0.05; z < kHeight_m; z += 0.1) seen.set(seen.voxelAt({x, y, z}), -40);
  EXPECT_FALSE(exploreByCameraTour(input, config).done) << "above it there might be more";
  for (double x = 0.05; x < 6.0; x += 0.1)
    for (double y = 0.05; y < 4.0; y += 0.1) {
      seen.set(seen.voxelAt({x, y, kHeight_m + 0.05}), 40);
      seen.set(seen.voxelAt({x, y, -0.05}), 40);
    }
  show();
  EXPECT_TRUE(exploreByCameraTour(input, config).done);
}

TEST_F(CameraRoom, KeepsItsViewpointUntilMostOfItWasSeen) {
  input.current = exploreByCameraTour(input, config).next;
  ASSERT_TRUE(input.current);
  const ExplorationResult again = exploreByCameraTour(input, config);
  ASSERT_TRUE(again.next);
  EXPECT_TRUE(again.kept_current);
  EXPECT_EQ(again.next->pose_map.position_m(), input.current->pose_map.position_m());
  look(input.current->pose_map);
  show();
  EXPECT_FALSE(exploreByCameraTour(input, config).kept_current);
}

TEST_F(CameraRoom, WithoutACameraItIsTheTourOfTheLaser) {
  config.camera.reset();
  EXPECT_TRUE(exploreByCameraTour(input, config).done);
}

}  // namespace
}  // namespace swiftlet::planning
