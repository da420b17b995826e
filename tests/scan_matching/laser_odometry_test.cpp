#include "perception/laser_odometry/laser_odometry.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::errorOf;

/// A scan taken at `truth` with the predicted pose `predicted`.
ProjectedScan scanWith(const test::PlanarWorld& world, const Pose2& truth, const Pose2& predicted,
                       std::uint64_t frame) {
  ProjectedScan scan = test::scanAt(world, truth, frame);
  scan.T_odom_body = common::lifted(predicted, 1.0);
  return scan;
}

TEST(LaserOdometry, TheFirstScanIsTheReference) {
  LaserOdometry odometry{{}};
  EXPECT_FALSE(odometry.lastMatch());
  const auto first = odometry.add(test::scanAt(test::flat(), {}, 1));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->from, first->to);
  EXPECT_TRUE(first->reference_changed);
  EXPECT_EQ(odometry.counts().references, 1U);
  EXPECT_EQ(odometry.lastMatch(), first->to);
}

TEST(LaserOdometry, HoveringDoesNotDrift) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  const auto first = odometry.add(test::scanAt(world, {}, 0));
  double worst_m = 0.0;
  for (std::uint64_t frame = 1; frame < 400; ++frame) {
    const double phase = 0.03 * static_cast<double>(frame);
    const Pose2 truth{0.05 * std::sin(phase), 0.05 * std::sin(2.0 * phase), 0.03 * std::sin(phase)};
    // The prediction drifts away steadily; the measurements must not follow.
    const Pose2 drifting{truth.x_m + 0.001 * static_cast<double>(frame), truth.y_m, truth.yaw_rad};
    const auto relative = odometry.add(scanWith(world, truth, drifting, frame));
    ASSERT_TRUE(relative);
    EXPECT_EQ(relative->from, first->to);
    EXPECT_FALSE(relative->reference_changed);
    worst_m = std::max(worst_m, errorOf(relative->T_from_to, truth).head<2>().norm());
  }
  EXPECT_LT(worst_m, 0.006);
}

TEST(LaserOdometry, DriftsLittleOverSeveralReferences) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  Pose2 T_start_reference;
  common::Time reference;
  int changes = 0;
  for (std::uint64_t frame = 0; frame < 300; ++frame) {
    const double t = static_cast<double>(frame) / 40.0;
    const Pose2 truth{0.9 * t, 0.9 * std::sin(0.3 * t), 0.4 * std::sin(0.4 * t)};
    const auto relative = odometry.add(scanWith(world, truth, truth, frame));
    ASSERT_TRUE(relative) << frame;
    if (frame > 0) {
      EXPECT_EQ(relative->from, reference);
      const Pose2 estimate = T_start_reference * relative->T_from_to;
      EXPECT_LT((estimate.position_m() - truth.position_m()).norm(), 0.02) << frame;
    }
    if (!relative->reference_changed) continue;
    T_start_reference = frame == 0 ? truth : T_start_reference * relative->T_from_to;
    reference = relative->to;
    ++changes;
  }
  EXPECT_GE(changes, 4);
  EXPECT_LE(changes, 40);
  EXPECT_EQ(odometry.counts().failures, 0U);
}

TEST(LaserOdometry, NewlyVisibleSurfacesDoNotBiasTheHeading) {
  const test::PlanarWorld world = test::corridorWithDoors();
  double turned_deg = 0.0, ahead_m = 0.0;
  constexpr int kWays = 4;
  for (std::uint64_t way = 0; way < kWays; ++way) {
    LaserOdometry odometry{{}};
    Pose2 T_start_reference, estimate, truth;
    for (std::uint64_t frame = 0; frame < 300; ++frame) {
      const double x_m = 0.08 * static_cast<double>(frame);
      truth = {x_m, 0.15 * std::sin(0.5 * x_m), 0.1 * std::sin(0.7 * x_m)};
      const auto relative = odometry.add(scanWith(world, truth, truth, 1000 * way + frame));
      ASSERT_TRUE(relative) << frame;
      estimate = (frame == 0 ? truth : T_start_reference) * relative->T_from_to;
      if (relative->reference_changed) T_start_reference = estimate;
    }
    turned_deg += common::wrapAngle(estimate.yaw_rad - truth.yaw_rad) / common::kRadPerDeg / kWays;
    ahead_m += (estimate.x_m - truth.x_m) / kWays;
  }
  printf("  after 24 m: %.3f deg, %.1f mm ahead, in the mean\n", turned_deg, 1e3 * ahead_m);
  EXPECT_LT(std::abs(turned_deg), 0.06);
  EXPECT_LT(std::abs(ahead_m), 0.015);
}

TEST(LaserOdometry, WidensTheSearchForAGuessThatIsFarOff) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  const Pose2 truth{0.30, -0.25, 0.12};
  const auto relative = odometry.add(scanWith(world, truth, {}, 1));
  ASSERT_TRUE(relative);
  EXPECT_LT(errorOf(relative->T_from_to, truth).head<2>().norm(), 0.01);
}

/// Something that seems to move away, as a ramp during a climb, drags the match along. The estimate refuses it, and
/// once the scene fits where the estimate has the vehicle, that is the match.
TEST(LaserOdometry, ReturnsToWhereTheEstimateHasTheVehicleIfThatFitsBetter) {
  const test::PlanarWorld world = test::flat();
  LaserOdometryConfig config;
  config.widens = false;
  for (const bool refuses : {true, false}) {
    LaserOdometry odometry(config);
    static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
    for (std::uint64_t frame = 1; frame <= 30; ++frame) {
      const Pose2 dragged{0.01 * static_cast<double>(frame), 0.0, 0.0};
      const auto relative = odometry.add(scanWith(world, dragged, {}, frame));
      ASSERT_TRUE(relative) << frame;
      ASSERT_LT(errorOf(relative->T_from_to, dragged).head<2>().norm(), 0.02) << "what fits is still the match";
      odometry.refused(refuses);
    }
    const auto there = odometry.add(scanWith(world, {}, {}, 31));
    const bool returned = there && errorOf(there->T_from_to, {}).head<2>().norm() < 0.01;
    EXPECT_EQ(returned, refuses);
  }
}

/// Where the guess is an inertial one, what fits elsewhere is another surface.
TEST(LaserOdometry, WithoutWideningAMatchStaysWithinWhatTheMotionAllows) {
  const test::PlanarWorld world = test::flat();
  LaserOdometryConfig config;
  config.widens = false;
  LaserOdometry odometry(config);
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  const auto off = odometry.add(scanWith(world, {0.30, -0.25, 0.12}, {}, 1));
  const double farthest_m = off ? off->T_from_to.position_m().lpNorm<Eigen::Infinity>() : 0.0;
  EXPECT_LT(farthest_m, 1.2 * config.guess_error_m);
}

TEST(LaserOdometry, DoesNotApplyACorrectionTwice) {
  const test::PlanarWorld world = test::flat();
  LaserOdometryConfig narrow;
  narrow.guess_error_m = narrow.max_window_m = 0.05;
  LaserOdometry odometry(narrow);
  // The prediction lags by 4 cm a scan; the filter takes in each match and predicts from there.
  Pose2 corrected;
  std::optional<Pose2> last;
  for (std::uint64_t frame = 0; frame < 40; ++frame) {
    const Pose2 truth{0.04 * static_cast<double>(frame), 0.0, 0.0};
    const auto relative = odometry.add(scanWith(world, truth, corrected, frame), last);
    ASSERT_TRUE(relative) << frame;
    corrected = truth;
    last = corrected;
  }
  EXPECT_EQ(odometry.counts().failures, 0U);
}

/// A covered laser does not restart the odometry, and an odometry with a certain guess still widens its search.
TEST(LaserOdometry, ScansWithoutPointsDoNotRestartIt) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  for (std::uint64_t frame = 1; frame < 100; ++frame) {
    ProjectedScan covered = scanWith(world, {}, {}, frame);
    covered.points_level_m.clear();
    covered.heights_level_m.clear();
    EXPECT_FALSE(odometry.add(covered));
  }
  EXPECT_EQ(odometry.counts().restarts, 0U);
}

TEST(LaserOdometry, WidensAnEmptyWindow) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  const Pose2 truth{0.2, 0.1, 0.05};
  const auto relative = odometry.add(scanWith(world, truth, {}, 1), std::nullopt, SearchWindow{0.0, 0.0});
  ASSERT_TRUE(relative);
  EXPECT_LT(errorOf(relative->T_from_to, truth).head<2>().norm(), 0.01);
}

/// Whether a scan taken `offset_m` from its expected place is matched, with people in front of a third of the beams.
bool findsAmongPeople(double offset_m, const LaserOdometryConfig& config) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry(config);
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  ProjectedScan scan = scanWith(world, {offset_m, 0.0, 0.0}, {}, 1);
  for (std::size_t i = 0; i < scan.points_level_m.size(); i += 3) scan.points_level_m[i] *= 0.8F;
  const auto relative = odometry.add(scan);
  return relative && std::abs(relative->T_from_to.x_m - offset_m) < 0.02;
}

TEST(LaserOdometry, APoseFarFromTheGuessMustFitBetter) {
  LaserOdometryConfig config;
  config.min_fit = 0.6;
  EXPECT_TRUE(findsAmongPeople(0.45, config));
  config.min_widened_quality = 0.95;
  EXPECT_FALSE(findsAmongPeople(0.45, config));
  EXPECT_TRUE(findsAmongPeople(0.05, config));
}

/// Half of the walls also fit at the expected pose.
TEST(LaserOdometry, SearchesFartherAfterAPoorFitAtTheGuess) {
  LaserOdometryConfig config;
  config.min_fit = 0.35;
  EXPECT_FALSE(findsAmongPeople(0.45, config));
  config.min_fit = 0.6;
  EXPECT_TRUE(findsAmongPeople(0.45, config));
}

TEST(LaserOdometry, UsesTheOtherGuessWhenItFitsBetter) {
  const test::PlanarWorld world = test::flat();
  const Pose2 jump{0.4, 0.1, 1.5}, truth{0.1, 0.05, 0.1};
  const OtherGuess other{truth * Pose2{0.02, 0.0, 0.01}, SearchWindow{0.05, 0.05}};
  LaserOdometry odometry{{}};
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  EXPECT_FALSE(odometry.add(scanWith(world, truth, jump, 1)));
  const auto relative = odometry.add(scanWith(world, truth, jump, 2), std::nullopt, std::nullopt, other);
  ASSERT_TRUE(relative);
  EXPECT_TRUE(relative->otherwise);
  EXPECT_LT(errorOf(relative->T_from_to, truth).head<2>().norm(), 0.01);
  // The guess continues from the place of the match, by the prediction's motion.
  const auto next = odometry.add(scanWith(world, truth, other.T_odom_body, 3));
  ASSERT_TRUE(next);
  EXPECT_FALSE(next->otherwise);
}

/// Slightly more of the scan fits at the other guess, but that place is six windows away.
TEST(LaserOdometry, AFarOtherGuessMustFitMuchBetter) {
  const test::PlanarWorld world = test::flat();
  const Pose2 here{0.01, 0.0, 0.0}, there{0.4, 0.1, 0.1};
  LaserOdometryConfig config;
  config.min_fit = 0.95;
  const auto isFoundThere = [&](double least_quality) {
    config.min_widened_quality = least_quality;
    LaserOdometry odometry{config};
    static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
    ProjectedScan scan = scanWith(world, here, {}, 1);
    const ProjectedScan elsewhere = test::scanAt(world, there, 1);
    for (std::size_t i = 0; i < std::min(scan.points_level_m.size(), elsewhere.points_level_m.size()); ++i)
      if (i % 20 < 11) scan.points_level_m[i] = elsewhere.points_level_m[i];
    const OtherGuess other{there, SearchWindow{0.05, 0.05}};
    const auto relative = odometry.add(scan, std::nullopt, SearchWindow{0.05, 0.05}, other);
    return relative && relative->otherwise;
  };
  EXPECT_TRUE(isFoundThere(0.35));
  EXPECT_FALSE(isFoundThere(0.75));
}

TEST(LaserOdometry, RestartsAfterRepeatedFailures) {
  const test::PlanarWorld world = test::flat();
  LaserOdometryConfig config;
  config.max_failures = 5;
  LaserOdometry odometry(config);
  static_cast<void>(odometry.add(test::scanAt(world, {}, 0)));
  // Carried to the other room and turned, without scans.
  const Pose2 elsewhere{6.5, 2.0, 0.8};
  for (std::uint64_t frame = 1; frame <= 4; ++frame) EXPECT_FALSE(odometry.add(scanWith(world, elsewhere, {}, frame)));
  const auto anew = odometry.add(scanWith(world, elsewhere, {}, 5));
  ASSERT_TRUE(anew);
  EXPECT_EQ(anew->from, anew->to);
  EXPECT_TRUE(anew->reference_changed);
  EXPECT_EQ(odometry.counts().restarts, 1U);
  EXPECT_TRUE(odometry.add(scanWith(world, elsewhere, {}, 6)));
}

TEST(LaserOdometry, IgnoresLateEmptyAndInvalidScans) {
  const test::PlanarWorld world = test::flat();
  LaserOdometry odometry{{}};
  EXPECT_FALSE(odometry.add({}));
  static_cast<void>(odometry.add(test::scanAt(world, {}, 10)));
  EXPECT_FALSE(odometry.add(test::scanAt(world, {}, 10)));
  EXPECT_FALSE(odometry.add(test::scanAt(world, {}, 9)));
  EXPECT_EQ(odometry.counts().out_of_order, 2U);
  ProjectedScan lost = test::scanAt(world, {}, 11);
  lost.T_odom_body.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(odometry.add(lost));
  ProjectedScan empty;
  empty.stamp = test::scanAt(world, {}, 12).stamp;
  EXPECT_FALSE(odometry.add(empty));
  EXPECT_TRUE(odometry.add(test::scanAt(world, {}, 13)));
}

}  // namespace
}  // namespace swiftlet::perception
