#include "perception/slam2d/scan_to_map_slam.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/slam2d/flight.hpp"
#include "tests/slam2d/ring.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

Eigen::Vector3d errorOf(const Pose2& estimate, const Pose2& truth) {
  return {estimate.x_m - truth.x_m, estimate.y_m - truth.y_m, common::wrapAngle(estimate.yaw_rad - truth.yaw_rad)};
}

/// Compares the pose relative to the last key scan with the truth.
TEST(ScanToMapSlam, ItsCovarianceAgreesWithItsErrors) {
  const GridDrawingConfig config;
  ScanToMapSlam slam(config);
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, 1);
  double nees = 0.0;
  int scans = 0;
  Pose2 truth_of_key;
  while (!flight.done()) {
    const auto step = flight.next();
    const std::uint64_t matches = slam.counts().map_matches;
    const SlamUpdate update = slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
    const bool matched = slam.counts().map_matches > matches;
    if (matched && !update.key_scan) {
      const double key_yaw_rad = slam.keyPoses().back().T_map_body.yaw_rad;
      const Eigen::Matrix3d covariance = common::turned(slam.covariance(), -key_yaw_rad);
      const Eigen::Vector3d error = errorOf(slam.T_anchor_body(), between(truth_of_key, step.truth_T_world_body));
      nees += error.dot(covariance.ldlt().solve(error));
      ++scans;
      EXPECT_GE(std::sqrt(slam.covariance()(0, 0)), ScanToMapSlam::kMapSigma_m);
      EXPECT_GE(std::sqrt(slam.covariance()(2, 2)), ScanToMapSlam::kMapSigma_deg * kRadPerDeg);
    }
    if (update.key_scan) truth_of_key = step.truth_T_world_body;
  }
  std::printf("  nees %.2f over %d matches, %d of them rejected\n", nees / scans, scans,
              static_cast<int>(slam.counts().local_failures));
  EXPECT_LT(nees / scans, 3.0) << "3 when the covariance is exact, less when it is cautious";
}

TEST(ScanToMapSlam, ARejectedMatchKeepsTheCorrection) {
  ScanToMapSlam slam{{}};
  test::Flight flight(test::flat(), test::SmoothPath(test::flatLoop(1), 1.0), {}, 3);
  test::Flight::Step step;
  for (int i = 0; i < 200; ++i) {
    step = flight.next();
    slam.addScan(step.scan, step.T_odom_body, step.covariance_since_last);
  }
  const Pose2 correction = slam.T_map_odom();
  const Eigen::Matrix3d covariance = slam.covariance();
  const SlamCounts before = slam.counts();
  ASSERT_NE(correction.x_m, 0.0);

  // Points that no wall of the map explains.
  ProjectedScan strange = step.scan;
  strange.stamp += common::Duration::fromSeconds(0.1);
  for (std::size_t i = 0; i < strange.points_level_m.size(); ++i)
    strange.points_level_m[i] *= 0.35F + 0.05F * static_cast<float>((i / 40) % 3);
  const Pose2 moved = step.T_odom_body * Pose2{0.2, 0.0, 0.0};
  const SlamUpdate update = slam.addScan(strange, moved, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal());
  EXPECT_EQ(slam.counts().map_matches, before.map_matches + 1);
  EXPECT_EQ(slam.counts().local_failures, before.local_failures + 1);
  EXPECT_EQ(slam.T_map_odom().x_m, correction.x_m);
  EXPECT_EQ(slam.T_map_odom().yaw_rad, correction.yaw_rad);
  EXPECT_EQ(update.T_map_body.x_m, (correction * moved).x_m);
  EXPECT_GT(slam.covariance()(0, 0), covariance(0, 0));
}

/// The walls do not constrain the pose along the corridor, so the odometry and its whole uncertainty remain there.
TEST(ScanToMapSlam, InACorridorTheUncertaintyGrowsAlongIt) {
  test::PlanarWorld corridor;
  corridor.addPolyline({{-50.0, -1.0}, {50.0, -1.0}}, false);
  corridor.addPolyline({{-50.0, 1.0}, {50.0, 1.0}}, false);
  common::LaserConfig laser;
  laser.mirror_beams = 0;
  laser.beams = 361;
  laser.field_of_view_deg = 180.0;
  laser.range_max_m = 5.6;
  laser.sweep_s = 0.0;
  ScanToMapSlam slam{{}};
  const double step_sigma_m = 0.03;
  const int steps = 25;
  for (int i = 0; i <= steps; ++i) {
    common::RandomStream random(4, "corridor", static_cast<std::uint64_t>(i));
    const Pose2 truth{0.2 * i, 0.0, 0.0}, odom{0.22 * i, 0.002 * i, 0.0};
    const auto pose = [&](common::Time) { return common::lifted(truth, 1.0); };
    const common::Time now = common::Time::fromSeconds(0.2 * i);
    const ProjectedScan scan = project(test::sweep(corridor, laser, pose, now, random), laser, pose, {});
    slam.addScan(scan, odom, Eigen::Vector3d(step_sigma_m * step_sigma_m, 1e-4, 1e-6).asDiagonal());
  }
  const Pose2 last = slam.T_map_odom() * Pose2{0.22 * steps, 0.002 * steps, 0.0};
  std::printf("  at %.3f, %.3f m; sigma %.3f along, %.3f m across\n", last.x_m, last.y_m,
              std::sqrt(slam.covariance()(0, 0)), std::sqrt(slam.covariance()(1, 1)));
  EXPECT_NEAR(last.x_m, 0.22 * steps, 0.05) << "as the odometry has it";
  EXPECT_NEAR(last.y_m, 0.0, 0.02) << "as the walls have it";
  EXPECT_GT(std::sqrt(slam.covariance()(0, 0)), 0.7 * step_sigma_m * std::sqrt(steps));
  EXPECT_LT(std::sqrt(slam.covariance()(1, 1)), 0.02);
}

/// Once around 112 m without a loop closure: the drift is that of many matches in a row, less than the odometry's.
/// Nothing is moved when the vehicle comes back.
TEST(ScanToMapSlam, DriftsLessThanTheOdometryAndMovesNoKeyScan) {
  const test::Ring ring;
  ScanToMapSlam slam{{}};
  double worst_m = 0.0, worst_odom_m = 0.0;
  std::vector<PlanarSlam::KeyPose> halfway;
  ring.fly(1.0, [&](const ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d& covariance,
                    const Pose2& truth) {
    const SlamUpdate update = slam.addScan(scan, T_odom_body, covariance);
    worst_m = std::max(worst_m, (update.T_map_body.position_m() - truth.position_m()).norm());
    worst_odom_m = std::max(worst_odom_m, (T_odom_body.position_m() - truth.position_m()).norm());
    if (halfway.empty() && truth.y_m > 25.0) halfway = slam.keyPoses();
  });
  std::printf("  worst %.3f m; the odometry alone %.3f m\n", worst_m, worst_odom_m);
  EXPECT_LT(worst_m, 0.3 * worst_odom_m);
  const auto keys = slam.keyPoses();
  ASSERT_GT(keys.size(), halfway.size());
  for (std::size_t i = 0; i < halfway.size(); ++i) EXPECT_EQ(keys[i].T_map_body.x_m, halfway[i].T_map_body.x_m);
}

}  // namespace
}  // namespace swiftlet::perception
