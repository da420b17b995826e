// The odometry in a rendered room, whose motion is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

double distance_m(const Pose3& a, const Pose3& b) { return (a.position_m - b.position_m).norm(); }
double turn_deg(const Pose3& a, const Pose3& b) { return a.rotation.angularDistance(b.rotation) / common::kRadPerDeg; }

TEST(RgbdOdometry, TracksAWalkWithChangingExposure) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  const Pose3 start = walk(0.0);
  for (int i = 0; i < 60; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s, 1.0 + 0.2 * std::sin(time_s)));
    ASSERT_EQ(pose.state, TrackState::kTracked) << i;
    const Pose3 truth = start.inverse() * walk(time_s);
    ASSERT_LT(distance_m(pose.T_map_camera, truth), 0.008) << i;
    ASSERT_LT(turn_deg(pose.T_map_camera, truth), 0.25) << i;
  }
  EXPECT_GT(odometry.keyFrames().size(), 2u);
  EXPECT_LT(odometry.keyFrames().size(), 25u);
}

/// Most of a hall is farther away than the cloud of the map reaches.
TEST(RgbdOdometry, TracksARecordingOfAHall) {
  TexturedRoom hall;
  hall.half_size_m = {7.0, 7.0, 3.0};
  RgbdOdometry odometry(configOfRecordings().odometry);
  for (int i = 0; i < 60; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    const RgbdPose pose = odometry.process(hall.seen(walk(time_s), time_s));
    ASSERT_EQ(pose.state, TrackState::kTracked) << i;
    ASSERT_LT(distance_m(pose.T_map_camera, walk(0.0).inverse() * walk(time_s)), 0.05) << i;
  }
}

TEST(RgbdOdometry, StepsOfFourDegreesAtFiveFramesASecond) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  for (int i = 0; i < 25; ++i) {
    const Pose3 pose = walk(0.1 * i);
    const RgbdPose found = odometry.process(room.seen(pose, i / 5.0));
    ASSERT_TRUE(found.isTracked()) << i;
    ASSERT_LT(distance_m(found.T_map_camera, walk(0.0).inverse() * pose), 0.015) << i;
  }
}

/// As a slow radio sends them: their pyramids have three and four levels.
TEST(RgbdOdometry, TracksFramesWhoseSizeChanges) {
  TexturedRoom room;
  const common::PinholeCamera large = room.camera, small{160, 120, 145.0, 145.0, 79.5, 59.5};
  RgbdOdometry odometry({});
  for (int i = 0; i < 40; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    room.camera = i / 5 % 2 == 0 ? small : large;
    const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s));
    ASSERT_EQ(pose.state, TrackState::kTracked) << i;
    ASSERT_LT(distance_m(pose.T_map_camera, walk(0.0).inverse() * walk(time_s)), 0.015) << i;
  }
}

TEST(RgbdOdometry, WhatIsTooFastIsLostAndNeverWrong) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  int tracked = 0;
  for (int i = 0; i < 25; ++i) {
    const Pose3 pose = walk(0.45 * i);
    const RgbdPose found = odometry.process(room.seen(pose, i / 5.0));
    if (!found.isTracked()) continue;
    ++tracked;
    ASSERT_LT(distance_m(found.T_map_camera, walk(0.0).inverse() * pose), 0.03) << i;
  }
  EXPECT_GT(tracked, 5);
}

TEST(RgbdOdometry, ASeedCarriesItOverAGapThatIsTooLongToPredict) {
  const TexturedRoom room;
  RgbdOdometry odometry({});
  const Pose3 T_seed_map{common::expSO3({0.0, 0.0, 0.3}), {1.0, 2.0, 0.0}};
  const auto seed = [&](double time_s) { return CameraSeed{T_seed_map * walk(time_s), 0, false}; };
  RgbdPose pose = odometry.process(room.seen(walk(0.0), 0.0), seed(0.0));
  EXPECT_LT(distance_m(pose.T_map_camera, seed(0.0).T_map_camera), 1e-12);
  pose = odometry.process(room.seen(walk(1.1), 1.1), seed(1.1));
  ASSERT_EQ(pose.state, TrackState::kTracked);
  EXPECT_LT(distance_m(pose.T_map_camera, seed(1.1).T_map_camera), 0.01);
}

TEST(RgbdOdometry, ElsewhereItIsLostAndIsFoundAgainWhereItWasBefore) {
  const TexturedRoom room;
  TexturedRoom other;
  other.walls = 100;
  other.half_size_m = {1.3, 3.0, 1.1};
  RgbdOdometry odometry({});
  double time_s = 0.0;
  for (; time_s < 2.0; time_s += 1.0 / kWalkFrames_Hz)
    ASSERT_TRUE(odometry.process(room.seen(walk(time_s), time_s)).isTracked());
  const std::size_t keys = odometry.keyFrames().size();
  for (int i = 0; i < 5; ++i) {
    time_s += 1.0 / kWalkFrames_Hz;
    EXPECT_EQ(odometry.process(other.seen({}, time_s)).state, TrackState::kLost);
  }
  EXPECT_EQ(odometry.keyFrames().size(), keys);
  // Back near the first place, seen from a little aside.
  const Pose3 there = walk(0.0) * Pose3{common::expSO3({0.03, -0.02, 0.05}), {0.05, -0.04, 0.03}};
  const RgbdPose pose = odometry.process(room.seen(there, time_s + 1.0));
  EXPECT_EQ(pose.state, TrackState::kFoundAgain);
  EXPECT_LT(distance_m(pose.T_map_camera, walk(0.0).inverse() * there), 0.01);
}

/// Noise looks like texture that moves with the camera. Taken for a measurement, it tells the filter that it does not
/// move, which the seed said.
TEST(RgbdOdometry, TheNoiseOfABareWallMeasuresNoMotionAlongIt) {
  for (const bool bare : {true, false}) {
    TexturedRoom room;
    room.contrast = bare ? 0.0 : 1.0;
    room.gray_noise = bare ? 2.0 : 1.0;
    room.vignetting = 0.2;
    RgbdOdometry odometry({});
    for (int i = 0; i < 12; ++i) {
      const double time_s = i / 15.0, sinks_m = bare ? 0.2 * time_s : 0.0;
      Pose3 truth, rest;
      rest.position_m = {1.4, 0.0, 0.2};
      truth.position_m = {1.4, 0.0, 0.2 - sinks_m};
      const RgbdPose pose = odometry.process(room.seen(truth, time_s), CameraSeed{rest});
      if (i == 0) continue;
      ASSERT_EQ(pose.state, TrackState::kTracked) << i;
      // Of each axis alone, with the others known.
      const Eigen::Matrix<double, 6, 1> variance = pose.measured->covariance.inverse().diagonal().cwiseInverse();
      EXPECT_LT(variance[0], 1e-4) << "the distance to the wall: " << i;
      if (bare)
        EXPECT_GT(variance[2], 0.01) << i;
      else
        EXPECT_LT(variance[2], 1e-4) << i;
    }
  }
}

/// A first frame with surfaces beyond the range only, as a dropout gives it, must not cost the recording.
TEST(RgbdOdometry, BeginsWithTheFirstFrameThatShowsEnough) {
  const TexturedRoom room;
  for (const bool seeded : {false, true}) {
    RgbdOdometry odometry({});
    const auto seed = [&](double time_s) {
      return seeded ? std::optional(CameraSeed{walk(time_s), 0, false}) : std::nullopt;
    };
    common::RgbdFrame poor = room.seen(walk(0.0), 0.0);
    for (float& depth_m : poor.depth.depth_m) depth_m = 6.5F;
    const RgbdPose first = odometry.process(poor, seed(0.0));
    EXPECT_EQ(first.state, TrackState::kLost);
    EXPECT_FALSE(first.became_key_frame);
    EXPECT_TRUE(odometry.keyFrames().isEmpty());
    for (int i = 1; i < 10; ++i) {
      const double time_s = i / kWalkFrames_Hz;
      const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s), seed(time_s));
      ASSERT_EQ(pose.state, TrackState::kTracked) << i;
      const Pose3 truth = (seeded ? Pose3{} : walk(1 / kWalkFrames_Hz).inverse()) * walk(time_s);
      ASSERT_LT(distance_m(pose.T_map_camera, truth), 0.01) << i;
    }
  }
}

TEST(RgbdOdometry, TracksWithPicturesOfAnySize) {
  for (const common::PinholeCamera& camera : {common::PinholeCamera{640, 480, 580.0, 580.0, 319.5, 239.5},
                                              {848, 480, 620.0, 620.0, 423.5, 239.5},
                                              {333, 251, 300.0, 300.0, 166.0, 125.0}}) {
    TexturedRoom room;
    room.camera = camera;
    RgbdOdometry odometry({});
    for (int i = 0; i < 6; ++i) {
      const double time_s = i / kWalkFrames_Hz;
      const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s));
      ASSERT_EQ(pose.state, TrackState::kTracked) << camera.width_px << " px, frame " << i;
      ASSERT_LT(distance_m(pose.T_map_camera, walk(0.0).inverse() * walk(time_s)), 0.01) << camera.width_px;
    }
  }
}

TEST(RgbdOdometry, EqualFramesGiveEqualBits) {
  const TexturedRoom room;
  RgbdOdometry one({}), other({});
  for (int i = 0; i < 12; ++i) {
    const common::RgbdFrame frame = room.seen(walk(0.2 * i), 0.2 * i);
    const Pose3 pose = one.process(frame).T_map_camera, again = other.process(frame).T_map_camera;
    EXPECT_EQ(pose.position_m, again.position_m);
    EXPECT_EQ(pose.rotation.coeffs(), again.rotation.coeffs());
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
