// Saeedi's Algorithm 1 in the rendered room: the parts against what is known exactly, then the whole.
#include "mapping3d/landmarks/model_icp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "mapping3d/model/mapper3d.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"
#include "tests/rgbd_odometry/walk.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

double distance_m(const Pose3& a, const Pose3& b) { return (a.position_m - b.position_m).norm(); }

/// Its usual texture is smooth and has few corners.
TexturedRoom roomOfCorners(int walls = 0) {
  TexturedRoom room;
  room.contrast = 3.0;
  room.walls = walls;
  return room;
}

std::vector<vision::Feature> featuresOf(const common::RgbdFrame& frame) {
  const FramePyramid pyramid = makePyramid(frame);
  return vision::findFeatures(pyramid.front().gray, pyramid.front().depth, pyramid.front().camera, {});
}

TEST(LandmarkIcp, RecoversAKnownMotion) {
  const TexturedRoom room = roomOfCorners();
  LandmarkModel model;
  for (const auto& feature : featuresOf(room.seen(walk(0.0), 0.0))) model.add(feature, walk(0.0), 0, 0);
  const Pose3 truth = walk(0.0) * Pose3{common::expSO3({0.006, -0.007, 0.008}), {0.012, 0.01, -0.008}};
  const ModelMatch match = matchToModel(featuresOf(room.seen(truth, 1.0)), model.all(), {walk(0.0), Matrix6d::Zero()});
  EXPECT_GT(match.fit.points, 100);
  EXPECT_GT(match.fit.agreement, 0.5);
  EXPECT_LT(distance_m(match.fit.T_map_camera, truth), 0.005);
  EXPECT_LT(match.fit.T_map_camera.rotation.angularDistance(truth.rotation), 0.003);
}

TEST(LandmarkIcp, OfAnotherPlaceFewMatch) {
  const TexturedRoom room = roomOfCorners();
  const TexturedRoom other = roomOfCorners(100);
  LandmarkModel model;
  for (const auto& feature : featuresOf(room.seen(walk(0.0), 0.0))) model.add(feature, walk(0.0), 0, 0);
  const ModelMatch match =
      matchToModel(featuresOf(other.seen(walk(0.0), 1.0)), model.all(), {walk(0.0), Matrix6d::Zero()});
  EXPECT_LT(match.fit.agreement, 0.3);
}

TEST(LandmarkModel, AnUpdateIsTheMeanWeightedByTheInformation) {
  LandmarkModel model;
  vision::Feature feature{{}, {2.0, 0.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()};
  const std::uint64_t number = model.add(feature, {}, 0, 1);
  feature.mean_camera_m.y() = 0.03;
  feature.covariance_camera_m2 *= 2.0;
  model.update(number, feature, {}, 2);
  EXPECT_NEAR(model.find(number)->mean_map_m.y(), 0.01, 1e-12);
  EXPECT_NEAR(model.find(number)->covariance_map_m2(1, 1), 1e-4 / 1.5, 1e-12);
  EXPECT_EQ(model.find(number)->last_seen, 2U);
}

TEST(LandmarkModel, DropsWhatWasSeenLongestAgo) {
  LandmarkModel model(2);
  const vision::Feature feature{{}, {2.0, 0.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()};
  for (std::uint64_t frame = 1; frame <= 3; ++frame) model.add(feature, {}, 0, frame);
  model.update(0, feature, {}, 4);
  model.shrink();
  EXPECT_EQ(model.all().size(), 2U);
  EXPECT_NE(model.find(0), nullptr);
  EXPECT_EQ(model.find(1), nullptr);
}

TEST(LandmarkModel, MovesWithItsKeyScans) {
  LandmarkModel model;
  const vision::Feature feature{{}, {2.0, 0.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity()};
  model.add(feature, {}, 0, 1);
  model.add(feature, {}, 1, 1);
  const common::KeyPoses before{1, {{{}, {}}, {{}, {}}}};
  common::KeyPoses after = before;
  after.keys[1].T_map_key = {0.0, 1.0, 0.0};
  model.moveTo(before, after);
  EXPECT_EQ(model.all()[0].mean_map_m, Eigen::Vector3d(2.0, 0.0, 0.0));
  EXPECT_LT((model.all()[1].mean_map_m - Eigen::Vector3d(2.0, 1.0, 0.0)).norm(), 1e-12);
}

TEST(ModelIcp, TracksAWalk) {
  const TexturedRoom room = roomOfCorners();
  ModelIcp odometry({});
  int keys = 0, motions = 0;
  for (int i = 0; i < 60; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s));
    ASSERT_EQ(pose.state, TrackState::kTracked) << i;
    ASSERT_LT(distance_m(pose.T_map_camera, walk(0.0).inverse() * walk(time_s)), 0.06) << i;
    keys += pose.became_key_frame ? 1 : 0;
    motions += pose.motion ? 1 : 0;
    ASSERT_LE(odometry.landmarks().all().size(), 3000U);
  }
  EXPECT_GT(keys, 3);
  EXPECT_GT(motions, 1);
}

TEST(ModelIcp, ASeedInTheMapHoldsIt) {
  const TexturedRoom room = roomOfCorners();
  ModelIcp odometry({});
  for (int i = 0; i < 45; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    // Two frames of every ten are lost on the radio.
    if (i % 10 > 7) continue;
    const RgbdPose pose = odometry.process(room.seen(walk(time_s), time_s), CameraSeed{walk(time_s)});
    ASSERT_TRUE(pose.isTracked()) << i;
    ASSERT_LT(distance_m(pose.T_map_camera, walk(time_s)), 0.03) << i;
  }
}

TEST(ModelIcp, ElsewhereItIsLostAndTheSeedBeginsAnother) {
  const TexturedRoom room = roomOfCorners();
  const TexturedRoom other = roomOfCorners(100);
  ModelIcp odometry({});
  odometry.process(room.seen(walk(0.0), 0.0), CameraSeed{walk(0.0)});
  int lost = 0;
  for (int i = 1; i < 10; ++i) {
    const RgbdPose pose = odometry.process(other.seen(walk(0.0), i / kWalkFrames_Hz), CameraSeed{walk(0.0)});
    lost += pose.isTracked() ? 0 : 1;
    EXPECT_LT(distance_m(pose.T_map_camera, walk(0.0)), 0.005);
    EXPECT_EQ(pose.state, i == 6 ? TrackState::kFoundAgain : i < 6 ? TrackState::kLost : TrackState::kTracked) << i;
  }
  EXPECT_EQ(lost, 5);
}

TEST(ModelIcp, EqualFramesGiveEqualBitsInAMap) {
  const TexturedRoom room = roomOfCorners();
  Mapper3dConfig config;
  config.odometry.method = RgbdOdometryConfig::Method::kModelIcp;
  Mapper3d one(config), other(config);
  for (int i = 0; i < 20; ++i) {
    const double time_s = i / kWalkFrames_Hz;
    const common::RgbdFrame frame = room.seen(walk(time_s), time_s);
    const MappedFrame mapped = one.add(frame, {}), again = other.add(frame, {});
    ASSERT_TRUE(mapped.pose.isTracked()) << i;
    EXPECT_EQ(mapped.pose.T_map_camera.position_m, again.pose.T_map_camera.position_m);
    EXPECT_EQ(mapped.pose.T_map_camera.rotation.coeffs(), again.pose.T_map_camera.rotation.coeffs());
  }
}

}  // namespace
}  // namespace swiftlet::mapping3d
