// The laser odometry with each matcher that a profile may choose: which one did the work, and its error.
#include "perception/scan_matching/matcher_choice.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "perception/laser_odometry/laser_odometry.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

const char* nameOf(MatcherKind kind) {
  return kind == MatcherKind::kCorrelative   ? "Correlative"
         : kind == MatcherKind::kGaussNewton ? "GaussNewton"
                                             : "PointToLine";
}

class EachMatcher : public testing::TestWithParam<MatcherKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, EachMatcher,
                         testing::Values(MatcherKind::kCorrelative, MatcherKind::kGaussNewton,
                                         MatcherKind::kPointToLine),
                         [](const auto& kind) { return std::string(nameOf(kind.param)); });

TEST_P(EachMatcher, IsCreatedAsChosen) {
  MatcherChoiceConfig config;
  config.kind = GetParam();
  EXPECT_EQ(makeMatcher(config)->kind(), GetParam());
}

/// Seven metres through two rooms; the prediction is the truth with a drift of 4 cm/s.
TEST_P(EachMatcher, TracksAFlightThroughTheFlat) {
  const test::PlanarWorld world = test::flat();
  LaserOdometryConfig config;
  config.matcher.kind = GetParam();
  LaserOdometry odometry(config);
  Pose2 T_start_reference;
  double worst_m = 0.0, worst_deg = 0.0;
  for (std::uint64_t frame = 0; frame < 300; ++frame) {
    const double t = static_cast<double>(frame) / 40.0;
    const Pose2 truth{0.9 * t, 0.9 * std::sin(0.3 * t), 0.4 * std::sin(0.4 * t)};
    ProjectedScan scan = test::scanAt(world, truth, frame);
    scan.T_odom_body = common::lifted(Pose2{truth.x_m + 0.04 * t, truth.y_m, truth.yaw_rad}, 1.0);
    const auto relative = odometry.add(scan);
    ASSERT_TRUE(relative) << frame;
    const Pose2 estimate = T_start_reference * relative->T_from_to;
    const Eigen::Vector3d error = test::errorOf(estimate, truth);
    worst_m = std::max(worst_m, error.head<2>().norm());
    worst_deg = std::max(worst_deg, std::abs(error.z()) / common::kRadPerDeg);
    if (relative->reference_changed) T_start_reference = estimate;
  }
  const LaserOdometryCounts& counts = odometry.counts();
  std::printf("  %-12s worst %.1f mm, %.2f deg, %d references\n", nameOf(GetParam()), 1e3 * worst_m, worst_deg,
              static_cast<int>(counts.references));
  EXPECT_LT(worst_m, 0.03);
  EXPECT_LT(worst_deg, 0.4);
  EXPECT_EQ(counts.failures, 0U);
  EXPECT_EQ(counts.correlative_searches > 0, GetParam() == MatcherKind::kCorrelative);
  EXPECT_EQ(counts.gauss_newton_searches > 0, GetParam() == MatcherKind::kGaussNewton);
  EXPECT_EQ(counts.point_to_line_searches > 0, GetParam() == MatcherKind::kPointToLine);
}

}  // namespace
}  // namespace swiftlet::perception
