// Targets from frame to frame: placed in the map, kept apart, confirmed, dropped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "perception/targets/target_tracker.hpp"
#include "tests/targets/target_scene.hpp"

namespace swiftlet::perception::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A camera that sees targets at known places, with the errors that the test gives it.
class Watch {
 public:
  explicit Watch(const TargetTrackerConfig& config = {}) : tracker_(config, redAndGreen(), 5.0) {
    keys_.keys = {{{}, {0.0, 0.0, 0.0}}, {{}, {3.0, 0.0, 0.0}}};
    frame_.camera = flyingCamera().camera();
    frame_.depth = {frame_.camera.width_px, frame_.camera.height_px,
                    std::vector<float>(static_cast<std::size_t>(frame_.camera.pixels()), 0.0F)};
  }

  /// Sightings of the targets from a place at height 0, looking at the first of them.
  void look(const Eigen::Vector2d& from_map_m, const std::vector<Eigen::Vector3d>& targets_map_m, int key = 0,
            const Eigen::Vector3d& mount_error_rad = Eigen::Vector3d::Zero(), std::uint8_t color = 0) {
    const Eigen::Vector2d ahead = targets_map_m.front().head<2>() - from_map_m;
    const common::Pose3 T_map_camera =
        common::lifted({from_map_m.x(), from_map_m.y(), std::atan2(ahead.y(), ahead.x())}, 0.0);
    std::vector<TargetSighting> sightings;
    for (const Eigen::Vector3d& target_map_m : targets_map_m)
      sightings.push_back({color, common::expSO3(mount_error_rad) * (T_map_camera.inverse() * target_map_m),
                           0.0004 * Eigen::Matrix3d::Identity(), 0.25});
    add(sightings, T_map_camera, key);
  }
  void add(const std::vector<TargetSighting>& sightings, const common::Pose3& T_map_camera, int key = 0) {
    tracker_.add(sightings, {frame_, key, keys_.T_map_level(key).inverse() * T_map_camera, 0.0, 0.0, keys_});
  }
  void seesFarther(float depth_m) { std::fill(frame_.depth.depth_m.begin(), frame_.depth.depth_m.end(), depth_m); }
  std::vector<common::Target> targets() const { return tracker_.targets(keys_); }

  common::KeyPoses keys_;

 private:
  TargetTracker tracker_;
  common::RgbdFrame frame_;
};

const Eigen::Vector3d kPlace(2.0, 1.0, -0.4);

Eigen::Vector2d around(double angle_deg, double radius_m = 1.8) {
  const double angle_rad = angle_deg * common::kRadPerDeg;
  return kPlace.head<2>() + radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
}

TEST(TargetTracker, SeenFromAllSidesItIsOneAndFoundAfterThreePlaces) {
  Watch watch;
  watch.look(around(0), {kPlace});
  ASSERT_THAT(watch.targets(), SizeIs(1));
  EXPECT_EQ(watch.targets()[0].state, common::TargetState::kCandidate);
  EXPECT_EQ(labelOf(watch.targets()[0]), "red ?");
  for (int i = 0; i < 10; ++i) watch.look(around(0), {kPlace});
  EXPECT_EQ(watch.targets()[0].state, common::TargetState::kCandidate) << "ten pictures from one place are one view";
  for (double angle_deg = 40; angle_deg < 360; angle_deg += 40) watch.look(around(angle_deg), {kPlace});
  ASSERT_THAT(watch.targets(), SizeIs(1));
  EXPECT_EQ(labelOf(watch.targets()[0]), "red 1");
  EXPECT_EQ(watch.targets()[0].views, 9);
  EXPECT_LT((watch.targets()[0].position_map_m - kPlace).norm(), 1e-6);
}

TEST(TargetTracker, SeveralOfOneColourStaySeparateAndAreCounted) {
  Watch watch;
  const Eigen::Vector3d other = kPlace + Eigen::Vector3d(0.0, 0.45, 0.0);
  for (const double angle_deg : {-20, 0, 20, 40}) watch.look(around(angle_deg), {kPlace, other});
  watch.look(around(10), {kPlace + Eigen::Vector3d(0.0, 0.2, 0.5)}, 0, {}, 1);
  const auto targets = watch.targets();
  ASSERT_THAT(targets, SizeIs(3));
  EXPECT_EQ(labelOf(targets[0]) + ", " + labelOf(targets[1]) + ", " + labelOf(targets[2]), "red 1, red 2, green ?");
  EXPECT_LT((targets[1].position_map_m - other).norm(), 0.01);
}

TEST(TargetTracker, TheOtherSideTellsMoreThanTheSameSideAgain) {
  TargetTrackerConfig config;
  config.mount_sigma_deg = 1.5;
  Watch same(config), opposite(config);
  for (const double angle_deg : {0, 8, 16, 24}) same.look(around(angle_deg), {kPlace});
  for (const double angle_deg : {0, 90, 180, 270}) opposite.look(around(angle_deg), {kPlace});
  EXPECT_GT(same.targets()[0].sigma_m(), 1.3 * opposite.targets()[0].sigma_m());
}

// A filter that took the mount's error for noise would be sure of a wrong place: its figure here is above 10.
TEST(TargetTracker, ItsCovarianceAllowsForAMountThatIsTurned) {
  TargetTrackerConfig config;
  config.mount_sigma_deg = 1.0;
  config.position_sigma_m = 0.01;
  double sum = 0.0;
  constexpr int kFlights = 200;
  for (std::uint64_t flight = 0; flight < kFlights; ++flight) {
    common::RandomStream random(flight, "mount");
    const auto draw = [&](double sigma) { return sigma * random.gaussian(); };
    const Eigen::Vector3d mount_rad(draw(0.0175), draw(0.0175), draw(0.0175));
    Watch watch(config);
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d noise(draw(0.02), draw(0.02), draw(0.02));
      watch.look(around(-30.0 + 8.0 * i, 2.5), {kPlace + noise}, 0, mount_rad);
    }
    const common::Target target = watch.targets().at(0);
    const Eigen::Vector3d error_m = target.position_map_m - kPlace;
    sum += error_m.dot(target.covariance_m2.inverse() * error_m);
  }
  EXPECT_LT(sum / kFlights, 4.0) << "mean of the squared Mahalanobis distance, 3 if the covariance is right";
  EXPECT_GT(sum / kFlights, 0.8);
}

TEST(TargetTracker, ItMovesWithItsKeyScan) {
  Watch watch;
  for (const double angle_deg : {0, 30, 60}) watch.look(around(angle_deg), {kPlace}, 1);
  watch.keys_.keys[1].T_map_key = {3.0, 0.5, 0.0};  // A loop closure.
  EXPECT_LT((watch.targets()[0].position_map_m - (kPlace + Eigen::Vector3d(0.0, 0.5, 0.0))).norm(), 1e-6);
  watch.look(around(90) + Eigen::Vector2d(0.0, 0.5), {kPlace + Eigen::Vector3d(0.0, 0.5, 0.0)}, 0);
  EXPECT_THAT(watch.targets(), SizeIs(1)) << "seen again by way of another key scan";
}

TEST(TargetTracker, TwoThatACorrectionBringsTogetherAreOne) {
  Watch watch;
  watch.keys_.keys[1].T_map_key = {3.0, 1.0, 0.0};
  for (const double angle_deg : {0, 30, 60}) watch.look(around(angle_deg), {kPlace}, 0);
  const Eigen::Vector3d again = kPlace + Eigen::Vector3d(0.0, 1.0, 0.0);
  watch.look(around(0) + Eigen::Vector2d(0.0, 1.0), {again}, 1);
  ASSERT_THAT(watch.targets(), SizeIs(2));
  watch.keys_.keys[1].T_map_key = {3.0, 0.0, 0.0};
  watch.look(around(90), {kPlace}, 0);
  ASSERT_THAT(watch.targets(), SizeIs(1));
  EXPECT_EQ(labelOf(watch.targets()[0]), "red 1");
}

TEST(TargetTracker, ACandidateThatTheCameraLooksThroughIsDropped) {
  Watch watch;
  watch.look(around(0), {kPlace});
  watch.seesFarther(1.9F);
  const Eigen::Vector2d from = around(10);
  const Eigen::Vector2d ahead = kPlace.head<2>() - from;
  const auto T_map_camera = common::lifted({from.x(), from.y(), std::atan2(ahead.y(), ahead.x())}, 0.0);
  for (int i = 0; i < 20; ++i) watch.add({}, T_map_camera);
  EXPECT_THAT(watch.targets(), SizeIs(1)) << "what stands there hides nothing";
  watch.seesFarther(4.0F);
  for (int i = 0; i < 20; ++i) watch.add({}, T_map_camera);
  EXPECT_THAT(watch.targets(), IsEmpty());
}

TEST(TargetTracker, WhatIsTooFarToBeMeasuredIsBehindACandidateInRange) {
  for (const double from_m : {1.8, 4.8}) {
    Watch watch;
    watch.look(around(0), {kPlace});
    watch.seesFarther(common::DepthImage::kTooFar);
    const Eigen::Vector2d from = around(10, from_m);
    const Eigen::Vector2d ahead = kPlace.head<2>() - from;
    const auto T_map_camera = common::lifted({from.x(), from.y(), std::atan2(ahead.y(), ahead.x())}, 0.0);
    for (int i = 0; i < 20; ++i) watch.add({}, T_map_camera);
    EXPECT_THAT(watch.targets(), SizeIs(from_m < 4.0 ? 0 : 1)) << "the camera measures up to 5 m";
  }
}

TEST(TargetTracker, BadValuesAreLeftOut) {
  Watch watch;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  watch.look(around(0), {{nan, 1.0, 0.0}});
  watch.look({nan, 0.0}, {kPlace});
  watch.add({{7, {2.0, 0.0, 0.0}, Eigen::Matrix3d::Identity(), 0.2}}, {}, 0);
  EXPECT_THAT(watch.targets(), IsEmpty());
  for (const double angle_deg : {0, 30, 60}) watch.look(around(angle_deg), {kPlace});
  watch.look(around(90), {kPlace + Eigen::Vector3d(0.15, 0.0, 0.0)});  // Near enough to be it, too far to be true.
  ASSERT_THAT(watch.targets(), SizeIs(1));
  EXPECT_LT((watch.targets()[0].position_map_m - kPlace).norm(), 0.05);
}

}  // namespace
}  // namespace swiftlet::perception::testing
