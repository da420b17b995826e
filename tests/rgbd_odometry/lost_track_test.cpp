// Where the track may go on, where it must be lost, and where it is found again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

double error_m(const Pose3& a, const Pose3& b) { return (a.position_m - b.position_m).norm(); }

/// The stamps of arrival over a link come in bursts.
TEST(LostTrack, StampsInPairsDoNotHoldThePose) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  for (int i = 0; i < 60; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    common::RgbdFrame frame = room.seen(walk(time_s), time_s);
    if (i % 2 == 1) frame.stamps.measured = common::Time::fromSeconds((i - 1) / kWalkFrames_Hz + 0.001);
    const RgbdPose found = odometry.process(frame);
    ASSERT_TRUE(found.isTracked()) << i;
    ASSERT_LT(error_m(found.T_map_camera, walk(0.0).inverse() * walk(time_s)), 0.01) << i;
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
