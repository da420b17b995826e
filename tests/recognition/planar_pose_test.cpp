#include "perception/recognition/planar_pose.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "tests/recognition/pattern_scene.hpp"

namespace swiftlet::perception {
namespace {

std::vector<PlanarMatch> matchesOf(const PlanarPose& pose, double sigma_px, std::uint64_t seed) {
  common::RandomStream random(seed, "planar_pose_test");
  std::vector<PlanarMatch> matches;
  for (const double x : {-0.25, 0.0, 0.25})
    for (const double y : {-0.25, 0.05, 0.25})
      matches.push_back({{x, y},
                         pixelOf(sceneCamera(), pose * Eigen::Vector2d(x, y)) +
                             Eigen::Vector2d(random.gaussian(sigma_px), random.gaussian(sigma_px))});
  return matches;
}

TEST(PlanarPose, IsFoundFromExactPixelsAtEveryPose) {
  for (std::uint64_t i = 0; i < 200; i += 2) {
    const PlanarPose truth = planarPose(drawScene(1, i, 0.5).pattern.T_camera_sheet);
    const auto fitted = fitPose(sceneCamera(), matchesOf(truth, 0.0, i));
    ASSERT_TRUE(fitted) << i;
    EXPECT_TRUE(fitted->pose.rotation.isApprox(truth.rotation, 1e-6)) << i;
    EXPECT_TRUE(fitted->pose.position_m.isApprox(truth.position_m, 1e-6)) << i;
    EXPECT_TRUE(fitted->pose.showsFace());
  }
}

/// One of the two poses of an exact expansion is the true one.
TEST(PlanarPose, IsOneOfTwoByTheExpansionAtAPoint) {
  for (std::uint64_t i = 0; i < 100; i += 2) {
    const PlanarPose truth = planarPose(drawScene(2, i, 0.5).pattern.T_camera_sheet);
    const Eigen::Vector2d anchor_m(0.1, -0.05);
    const auto homography = homographyOf(matchesOf(truth, 0.0, i));
    ASSERT_TRUE(homography);
    const auto poses = infinitesimalPoses(sceneCamera(), expandedAt(*homography, anchor_m), anchor_m);
    ASSERT_TRUE(poses);
    const double error =
        std::min(((*poses)[0].rotation - truth.rotation).norm(), ((*poses)[1].rotation - truth.rotation).norm());
    EXPECT_LT(error, 1e-5) << i;
  }
}

TEST(PlanarPose, HasTheCovarianceOfItsErrors) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t i = 0; i < 400; i += 2) {
    const PatternScene scene = drawScene(3, i, 0.5);
    if (scene.pattern.size_px < 60.0) continue;
    const PlanarPose truth = planarPose(scene.pattern.T_camera_sheet);
    const FittedPose fitted = fitPose(sceneCamera(), matchesOf(truth, 0.3, i), truth);
    Eigen::Matrix<double, 6, 1> error;
    error << common::logSO3(Eigen::Quaterniond(Eigen::Matrix3d(truth.rotation * fitted.pose.rotation.transpose()))),
        truth.position_m - fitted.pose.position_m;
    sum += error.dot(fitted.information * error) / (0.3 * 0.3) / 6.0;
    ++count;
  }
  EXPECT_NEAR(sum / count, 1.0, 0.25) << count;
}

TEST(PlanarPose, TheJacobianIsThatOfSmallSteps) {
  const PlanarPose pose = planarPose(drawScene(4, 0, 0.5).pattern.T_camera_sheet);
  const Eigen::Vector2d point_m(0.2, -0.1);
  const PixelJacobian jacobian = pixelJacobian(sceneCamera(), pose, pose * point_m);
  for (int i = 0; i < 6; ++i) {
    constexpr double kStep = 1e-6;
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step[i] = kStep;
    const Eigen::Vector2d change =
        (pixelOf(sceneCamera(), moved(pose, step) * point_m) - pixelOf(sceneCamera(), moved(pose, -step) * point_m)) /
        (2.0 * kStep);
    EXPECT_TRUE(change.isApprox(jacobian.col(i), 1e-4)) << i;
  }
}

TEST(PlanarPose, NeedsFourPointsThatAreNotOnALine) {
  const std::vector<PlanarMatch> three = {{{0, 0}, {0, 0}}, {{1, 0}, {10, 0}}, {{0, 1}, {0, 10}}};
  EXPECT_FALSE(homographyOf(three));
  std::vector<PlanarMatch> line;
  for (int i = 0; i < 6; ++i) line.push_back({{0.1 * i, 0.2 * i}, {10.0 * i, 5.0 * i}});
  EXPECT_FALSE(homographyOf(line));
}

}  // namespace
}  // namespace swiftlet::perception
