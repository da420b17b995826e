// Visual odometry over paths that are rendered, with what is true of them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>

#include "common/config.hpp"
#include "common/random.hpp"
#include "pair_rig.hpp"
#include "perception/visual_odometry/visual_odometry.hpp"
#include "vision/stereo_matcher.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose3;
using simulation::Pattern;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d errorOf(const VisualMotion& motion, const Pose3& true_motion) {
  const Pose3 error = motion.T_from_to.inverse() * true_motion;
  Vector6d vector;
  vector << error.position_m, common::logSO3(error.rotation);
  return vector;
}

TEST(GaussianRegistration, IsAsExactAsItsCovarianceSays) {
  common::RandomStream random(3, "pairs");
  const auto vector = [&](double sigma) {
    return Eigen::Vector3d(random.gaussian(sigma), random.gaussian(sigma), random.gaussian(sigma));
  };
  const Pose3 truth{common::expSO3({0.1, -0.05, 0.2}), {0.2, 0.1, -0.05}};
  double nees = 0.0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<PointPair> pairs;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d to(random.uniform(1.0, 3.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      const Eigen::Vector3d sigma(0.03, 0.004, 0.004);
      const Eigen::Matrix3d covariance = sigma.cwiseAbs2().asDiagonal();
      PointPair pair;
      pair.to = {to + vector(1.0).cwiseProduct(sigma), covariance};
      pair.from = {truth * to + vector(1.0).cwiseProduct(sigma), covariance};
      if (i % 10 == 0) pair.from.mean_camera_m += Eigen::Vector3d(0.5, 0.2, 0.0);  // Of another corner.
      pairs.push_back(pair);
    }
    const auto fit = refined(pairs, truth * Pose3{common::expSO3({0.01, 0.0, 0.01}), {0.02, 0.0, 0.0}}, 15);
    ASSERT_TRUE(fit);
    EXPECT_GE(fit->pairs, 45);
    const Pose3 error = fit->T_from_to.inverse() * truth;
    Vector6d e;
    e << error.position_m, common::logSO3(error.rotation);
    nees += e.dot(fit->covariance.inverse() * e);
  }
  EXPECT_NEAR(nees / kTrials / 6.0, 1.0, 0.3);
}

TEST(GaussianRegistration, NoneWithTooFewPairs) {
  std::vector<PointPair> pairs(10);
  for (PointPair& pair : pairs) {
    pair.from = {Eigen::Vector3d::Random(), Eigen::Matrix3d::Identity()};
    pair.to = pair.from;
  }
  EXPECT_FALSE(refined(pairs, {}, 15));
}

/// Follows a path and compares each motion with the true one.
struct Track {
  int frames = 0, motions = 0, key_frames = 0;
  double worst_m = 0.0, nees = 0.0, milliseconds = 0.0;
  double end_error_m = 0.0, length_m = 0.0, deviation_m = 0.0;
  std::map<std::string, int> missing;
};

Track follow(PairRig& rig, vision::StereoMatcher& matcher, VisualOdometry& odometry, const std::vector<Pose3>& path,
             double period_s = 0.25) {
  Track track;
  std::map<common::Time, Pose3> truth, estimated;
  const Pose3 T_body_camera = rig.T_body_camera();
  std::optional<Pose3> last;
  Pose3 last_truth;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double time_s = 1.0 + period_s * static_cast<double>(i);
    const Pose3& next = path[std::min(i + 1, path.size() - 1)];
    const Eigen::Vector3d speed_m_s = (path[i].inverse() * next).position_m / period_s;
    const double rate_rad_s = common::logSO3((path[i].inverse() * next).rotation).z() / period_s;
    const common::RgbdFrame pair = rig.taken(path[i], time_s, speed_m_s, rate_rad_s);
    const std::clock_t begin = std::clock();
    const auto frame = matcher.match(pair);
    ++track.frames;
    if (i > 0) track.length_m += (path[i].position_m - path[i - 1].position_m).norm();
    if (!frame) {
      ++track.missing[std::string(frame.error().name())];
      continue;
    }
    const VisualStep step = odometry.add(*frame);
    track.milliseconds += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const common::Time now = pair.stamps.measured;
    truth[now] = path[i] * T_body_camera;
    track.key_frames += step.became_key_frame ? 1 : 0;
    // Where the track breaks, what follows is compared from there on.
    if (!step.motion) {
      if (!step.missing.name().empty()) ++track.missing[std::string(step.missing.name())];
      estimated[now] = last ? *last * (last_truth.inverse() * truth.at(now)) : truth.at(now);
    } else {
      ++track.motions;
      const Pose3 true_motion = truth.at(step.motion->from).inverse() * truth.at(now);
      const Vector6d error = errorOf(*step.motion, true_motion);
      track.worst_m = std::max(track.worst_m, error.head<3>().norm());
      track.nees += error.dot(step.motion->covariance.inverse() * error) / 6.0;
      track.deviation_m += deviation_m(step.motion->covariance);
      estimated[now] = estimated.at(step.motion->from) * step.motion->T_from_to;
    }
    last = estimated.at(now);
    last_truth = truth.at(now);
    track.end_error_m = (last->position_m - truth.at(now).position_m).norm();
  }
  track.deviation_m /= std::max(1, track.motions);
  track.nees /= std::max(1, track.motions);
  track.milliseconds /= std::max(1, track.frames);
  return track;
}

/// Round the middle of the room at that speed, 4 frames a second, looking ahead.
std::vector<Pose3> circle(double height_m, double speed_m_s, double radius_m, double turns) {
  std::vector<Pose3> path;
  const double step_rad = speed_m_s * 0.25 / radius_m;
  for (double angle = 0.0; angle < 2.0 * std::numbers::pi * turns; angle += step_rad)
    path.push_back(
        hovering(height_m, radius_m * std::cos(angle), radius_m * std::sin(angle), angle + 0.5 * std::numbers::pi));
  return path;
}

class Rendered : public testing::TestWithParam<Pattern> {};

TEST_P(Rendered, ACircleOfTwelveMetresIsFollowed) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(GetParam()));
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  const Track track = follow(rig, matcher, odometry, circle(1.2, 0.5, 1.9, 1.0));
  std::printf(
      "pattern %d: %d of %d frames, %d key frames, worst %.1f mm, said %.1f mm, NEES %.2f, end %.3f m of %.1f m, %.1f "
      "ms a frame\n",
      static_cast<int>(GetParam()), track.motions, track.frames, track.key_frames, 1e3 * track.worst_m,
      1e3 * track.deviation_m, track.nees, track.end_error_m, track.length_m, track.milliseconds);
  for (const auto& [name, count] : track.missing) std::printf("  %s: %d\n", name.c_str(), count);
  // The joints of tiles are all alike, and most of them have no unique disparity.
  EXPECT_GE(track.motions, GetParam() == Pattern::kTiles ? track.frames / 2 : track.frames - 8);
  EXPECT_LT(track.worst_m, 0.05);
  EXPECT_LT(track.end_error_m, 0.02 * track.length_m);
  EXPECT_LT(track.nees, 2.0) << "as exact as its covariance says";
}
INSTANTIATE_TEST_SUITE_P(VisualOdometry, Rendered,
                         testing::Values(Pattern::kCarpet, Pattern::kWood, Pattern::kTiles, Pattern::kBrick));

TEST(VisualOdometry, WhileTheCameraHoversTheErrorDoesNotGrow) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kCarpet));
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  common::RandomStream random(1, "sway");
  std::vector<Pose3> path;
  for (int i = 0; i < 40; ++i)
    path.push_back(
        hovering(1.2 + random.gaussian(0.01), random.gaussian(0.03), random.gaussian(0.03), random.gaussian(0.02)));
  const Track track = follow(rig, matcher, odometry, path);
  EXPECT_EQ(track.motions, 39);
  EXPECT_LE(track.key_frames, 3);
  EXPECT_LT(track.end_error_m, 0.01);
}

TEST(VisualOdometry, NearTheGroundItSaysWhyItMeasuresNothing) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kCarpet));
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  std::vector<Pose3> climb;
  for (double height_m = 0.2; height_m < 1.2; height_m += 0.05) climb.push_back(hovering(height_m, 0.3, 0.2));
  std::optional<double> available_m;
  for (const Pose3& pose : climb) {
    const auto frame = matcher.match(rig.taken(pose, 1.0 + pose.position_m.z()));
    ASSERT_TRUE(frame) << frame.error().text();
    const VisualStep step = odometry.add(*frame);
    if (step.motion && !available_m) available_m = pose.position_m.z();
    if (pose.position_m.z() < 0.4) {
      EXPECT_NE(step.missing.name(), "") << pose.position_m.z();
    }
  }
  ASSERT_TRUE(available_m);
  EXPECT_NEAR(*available_m, 0.65, 0.15) << "0.68 m in the paper";
  std::printf("available from %.2f m\n", *available_m);
}

TEST(VisualOdometry, WithoutTextureItSaysSo) {
  const common::RgbdCameraConfig sheet = shippedPair();
  simulation::WorldModel bare = simulation::boxRoom();
  for (simulation::Shape& shape : bare.shapes) shape.pattern = Pattern::kBlank;
  PairRig rig(sheet, bare);
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  const auto frame = matcher.match(rig.taken(hovering(1.2)));
  ASSERT_TRUE(frame);
  EXPECT_EQ(odometry.add(*frame).missing.name(), "visual-odometry.too-little-texture");
}

TEST(VisualOdometry, WithoutOverlapItSaysSoAndBeginsAnew) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kPosters));
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  const auto at = [&](const Pose3& pose, double time_s) {
    return odometry.add(*matcher.match(rig.taken(pose, time_s)));
  };
  EXPECT_TRUE(at(hovering(1.2, 2.0, 1.0), 1.0).became_key_frame);
  const VisualStep elsewhere = at(hovering(1.5, -2.3, -1.7, 2.0), 1.25);
  EXPECT_FALSE(elsewhere.motion);
  EXPECT_EQ(elsewhere.missing.name(), "visual-odometry.no-overlap");
  EXPECT_TRUE(elsewhere.became_key_frame);
  EXPECT_TRUE(at(hovering(1.5, -2.25, -1.7, 2.0), 1.5).motion);
}

TEST(VisualOdometry, ForgottenKeyFramesMeasureNothing) {
  const common::RgbdCameraConfig sheet = shippedPair();
  PairRig rig(sheet, furnishedRoom(Pattern::kCarpet));
  vision::StereoMatcher matcher(sheet);
  VisualOdometry odometry(matcher.noise());
  const auto at = [&](double time_s) { return odometry.add(*matcher.match(rig.taken(hovering(1.2), time_s))); };
  static_cast<void>(at(1.0));
  EXPECT_TRUE(at(1.25).motion);
  odometry.forget();
  const VisualStep step = at(1.5);
  EXPECT_FALSE(step.motion);
  EXPECT_TRUE(step.became_key_frame);
  EXPECT_EQ(step.missing.name(), "");
}

}  // namespace
}  // namespace swiftlet::perception
