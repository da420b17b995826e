// A loop closure over hundreds of key scans: what is asked of a point and what a picture shows are right at once, the
// fused map some seconds later.
#include <ctime>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "autonomy/estimation/map3d_publisher.hpp"
#include "common/world.hpp"
#include "rendering/map3d_renderer.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::KeyPoses;
using common::Submap3d;
using common::Time;
using Eigen::Vector3d;

/// RTAB-Map's table has a closure over 860 key frames of 350 m (Labbe and Michaud, J. Field Robotics 2019).
constexpr int kScans = 860;
constexpr double kApart_m = 350.0 / kScans;
constexpr int kScansOfSubmap = 10;
constexpr double kResolution_m = 0.05;
constexpr double kDrift_rad = 0.05;  ///< Of the heading, over the whole path.

/// Around a circle; the believed heading drifts all the way.
std::shared_ptr<const KeyPoses> keysOf(std::uint64_t version, double drift_rad) {
  auto keys = std::make_shared<KeyPoses>();
  keys->version = version;
  common::Pose2 pose;
  for (int i = 0; i < kScans; ++i) {
    keys->keys.push_back({Time::fromSeconds(i), pose});
    pose = pose * common::Pose2{kApart_m, 0.0, (2.0 * std::numbers::pi + drift_rad) / kScans};
  }
  return keys;
}

/// The walls of a corridor 4 m wide, as long as a submap's path, 2.5 m high: 100 000 points and some 700 blocks.
Submap3d corridor() {
  auto points = std::make_shared<std::vector<common::SurfacePoint>>();
  auto voxels = std::make_shared<common::VoxelMap>(kResolution_m);
  for (const float side : {-1.0F, 1.0F})
    for (int i = 0; i < 400; ++i)
      for (int k = 0; k < 125; ++k) {
        common::SurfacePoint point;
        point.position_m = {0.01F * static_cast<float>(i), 2.0F * side, 0.02F * static_cast<float>(k)};
        point.normal = {0.0F, -side, 0.0F};
        point.rgb = {200, 120, 60};
        points->push_back(point);
        voxels->set(voxels->voxelAt(point.position_m.cast<double>()), 40);
      }
  for (int i = 0; i < 80; ++i)
    for (int j = -38; j < 38; ++j)
      for (int k = 0; k < 50; ++k) voxels->set({i, j, k}, -40);
  return {0, {}, points, voxels};
}

std::vector<Submap3d> submapsAlong() {
  std::vector<Submap3d> submaps;
  Submap3d submap = corridor();
  for (submap.key = 0; submap.key < kScans; submap.key += kScansOfSubmap) submaps.push_back(submap);
  return submaps;
}

/// The sum of what the submaps tell of a point.
int evidenceAt(const Vector3d& point_map_m, const common::Map3dLayer& layer) {
  int sum = 0;
  for (const Submap3d& submap : *layer.submaps) {
    const Vector3d at = submap.T_map_submap(*layer.keys).inverse() * point_map_m;
    if (const auto voxel = submap.voxels->voxelAt(at); submap.voxels->isKnown(voxel))
      sum += submap.voxels->evidence(voxel);
  }
  return sum;
}

rendering::Picture3d pictureOf(const std::shared_ptr<const common::Map3dLayer>& layer) {
  rendering::Picture3d picture;
  for (const Submap3d& submap : *layer->submaps)
    picture.surfaces.push_back({submap.points, submap.T_map_submap(*layer->keys)});
  return picture;
}

double processor_s() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A map of the whole path before a closure, shown on a stream, and the publisher that gets the closure.
class Closure : public testing::Test {
 protected:
  Closure() {
    publisher_.setSubmaps(submapsAlong());
    tickUntil(3.0);
    stream_.render(pictureOf(publisher_.layer(keys_)), view_);
  }
  /// Ticks every 50 ms.
  void tickUntil(double end_s) {
    for (; now_s_ < end_s; now_s_ += 0.05) {
      publisher_.fuse(keys_, Time::fromSeconds(now_s_));
      jobs_->deliverDue(Time::fromSeconds(now_s_));
    }
  }
  /// In the middle of a wall of a submap three quarters along the path.
  static Vector3d wall_map_m(const KeyPoses& keys) {
    return keys.T_map_level(kScans / 4 * 3 / kScansOfSubmap * kScansOfSubmap) * Vector3d(2.0, 2.0 + 1e-6, 1.01);
  }

  std::shared_ptr<const KeyPoses> keys_ = keysOf(1, kDrift_rad);
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  Map3dPublisher publisher_{kResolution_m, *jobs_};
  double now_s_ = 0.0;
  rendering::Map3dView view_;
  rendering::Map3dRenderer stream_;
};

TEST_F(Closure, APointAndThePictureAreRightWithinHalfASecond) {
  const Vector3d before_m = wall_map_m(*keys_);
  const auto closed = keysOf(2, 0.0);
  const Vector3d after_m = wall_map_m(*closed);
  ASSERT_GT((after_m - before_m).norm(), 1.0) << "the closure moves the wall";
  ASSERT_GT(evidenceAt(before_m, *publisher_.layer(keys_)), 0);
  ASSERT_LE(evidenceAt(after_m, *publisher_.layer(keys_)), 0);

  const double begin_s = processor_s();
  const auto layer = publisher_.layer(closed);
  const int there = evidenceAt(after_m, *layer), gone = evidenceAt(before_m, *layer);
  const common::Image shown = stream_.render(pictureOf(layer), view_);
  const double took_s = processor_s() - begin_s;

  EXPECT_GT(there, 0);
  EXPECT_LE(gone, 0);
  // The oracle: a map that was made of the corrected poses from the start.
  rendering::Picture3d fresh;
  for (const Submap3d& submap : submapsAlong()) fresh.surfaces.push_back({submap.points, submap.T_map_submap(*closed)});
  EXPECT_EQ(shown.rgb, rendering::renderMap3d(fresh, view_).rgb);
  EXPECT_LT(took_s, 0.5);
  RecordProperty("milliseconds", static_cast<int>(1e3 * took_s));
}

TEST_F(Closure, TheFusedMapFollowsWithinFiveSecondsAndKnowsItsAge) {
  const Vector3d before_m = wall_map_m(*keys_);
  const double closed_s = now_s_;
  keys_ = keysOf(2, 0.0);
  const Vector3d after_m = wall_map_m(*keys_);
  // The walls are one voxel thick: in a grid that is turned against theirs one may lie beside the point's own voxel.
  const auto hasWall = [&](const Vector3d& at_m) {
    const auto fused = publisher_.layer(keys_)->fused;
    for (int i = 0; i < 27; ++i) {
      const Vector3d aside_m = kResolution_m * Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (fused->isOccupied(fused->voxelAt(at_m + aside_m))) return true;
    }
    return false;
  };
  ASSERT_TRUE(publisher_.layer(keys_)->fused);
  EXPECT_TRUE(hasWall(before_m)) << "that of before the closure, until it is made again";
  EXPECT_LT(publisher_.layer(keys_)->fused_stamp.seconds(), closed_s) << "and its age says so";
  const double begin_s = processor_s();
  tickUntil(closed_s + 5.0);
  EXPECT_LT(processor_s() - begin_s, 5.0) << "as much work as fits into that time";
  EXPECT_TRUE(hasWall(after_m));
  EXPECT_FALSE(hasWall(before_m));
  EXPECT_GE(publisher_.layer(keys_)->fused_stamp.seconds(), closed_s - 1e-6);
}

}  // namespace
}  // namespace swiftlet::autonomy
