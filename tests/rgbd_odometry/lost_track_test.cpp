// Where the track may go on, where it must be lost, and where it is found again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

double error_m(const Pose3& a, const Pose3& b) { return (a.position_m - b.position_m).norm(); }

common::RgbdFrame covered(common::RgbdFrame frame) {
  for (float& depth_m : frame.depth.depth_m) depth_m = common::DepthImage::kUnknown;
  for (std::uint8_t& value : frame.color.rgb) value = 20;
  return frame;
}

/// After half a turn the room looks the same. Soon after, the camera can only be near where it was; later both
/// places are possible.
TEST(LostTrack, IsNotFoundAtAPlaceThatOnlyLooksAlike) {
  TexturedRoom room;
  room.is_symmetric = true;
  const auto pose = [](double angle_rad) {
    return Pose3{common::quaternionFrom({0.0, 0.0, angle_rad}),
                 {0.5 * std::cos(angle_rad), 0.5 * std::sin(angle_rad), 0.0}};
  };
  RgbdOdometry half_lap({});
  double time_s = 0.0, angle_rad = 0.0;
  for (; angle_rad < 0.95 * std::numbers::pi; time_s += 1.0 / kWalkFrames_Hz, angle_rad += 0.08)
    ASSERT_TRUE(half_lap.process(room.seen(pose(angle_rad), time_s)).isTracked()) << angle_rad;
  for (const auto& [covered_s, to_rad] : {std::pair{0.6, 0.6}, {2.5, 0.1}, {7.0, 0.1}}) {
    RgbdOdometry odometry = half_lap;
    ASSERT_FALSE(odometry.process(covered(room.seen(pose(angle_rad), time_s))).isTracked());
    const Pose3 there = pose(std::numbers::pi + to_rad);
    for (int i = 0; i < 3; ++i) {
      const RgbdPose found = odometry.process(room.seen(there, time_s + covered_s + 0.1 * i));
      if (!found.isTracked()) continue;
      EXPECT_LT(error_m(found.T_map_camera, pose(0.0).inverse() * there), 0.05) << covered_s;
    }
  }
}

/// Tracks a walk of which `spoil` changes the frames. Those in `lost` must be lost, all others within `within_m` of the
/// truth.
void expectTracked(int frames, const std::function<void(int, common::RgbdFrame&)>& spoil, const std::set<int>& lost,
                   double within_m) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    common::RgbdFrame frame = room.seen(walk(time_s), time_s);
    spoil(i, frame);
    const RgbdPose found = odometry.process(frame);
    ASSERT_EQ(found.isTracked(), !lost.contains(i)) << i;
    if (!found.isTracked()) continue;
    ASSERT_LT(error_m(found.T_map_camera, walk(0.0).inverse() * walk(time_s)), within_m) << i;
  }
}

/// A picture that is covered, and depths that are wrong by a third: the next frame goes on from the last pose.
TEST(LostTrack, GoesOnAfterABadFrame) {
  const auto spoil = [](int i, common::RgbdFrame& frame) {
    if (i == 12) frame = covered(std::move(frame));
    if (i == 20)
      for (float& depth_m : frame.depth.depth_m) depth_m *= 1.3F;
  };
  expectTracked(30, spoil, {12, 20}, 0.02);
}

/// The stamps of arrival over a link come in bursts.
TEST(LostTrack, StampsInPairsDoNotHoldThePose) {
  const auto spoil = [](int i, common::RgbdFrame& frame) {
    if (i % 2 == 1) frame.stamps.measured = common::Time::fromSeconds((i - 1) / kWalkFrames_Hz + 0.001);
  };
  expectTracked(60, spoil, {}, 0.01);
}

}  // namespace
}  // namespace swiftlet::mapping3d
