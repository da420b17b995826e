// The matchers by least squares, held to the same laws as the exhaustive one.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::errorOf;
using test::poseInFlat;
using test::scanAt;

template <typename Type>
class LeastSquaresMatchers : public testing::Test {};

using Kinds = testing::Types<GaussNewtonMatcher, PointToLineMatcher>;
TYPED_TEST_SUITE(LeastSquaresMatchers, Kinds);

Pose2 stepWithin(common::RandomStream& random, double distance_m, double turn_rad) {
  return {random.uniform(-distance_m, distance_m), random.uniform(-distance_m, distance_m),
          random.uniform(-turn_rad, turn_rad)};
}

struct MatchErrors {
  double translation_rms_m = 0.0, rotation_rms_rad = 0.0;
  double nees = 0.0;  ///< Mean of the normalized squared error; 3 when the covariance is exact.
  int failed = 0;
};

/// Each trial is a room seen from one place, then from a step away; the guess does not include the step.
template <typename Kind>
MatchErrors measureAccuracy(int trials, double distance_m, double turn_rad) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(5, "accuracy");
  MatchErrors accuracy;
  for (int trial = 0; trial < trials; ++trial) {
    Kind matcher;
    const Pose2 reference = poseInFlat(random);
    const auto frame = 2 * static_cast<std::uint64_t>(trial);
    matcher.addReference(scanAt(world, reference, frame), reference);
    const Pose2 truth = reference * stepWithin(random, distance_m, turn_rad);
    const MatchResult match =
        matcher.match(scanAt(world, truth, frame + 1), reference, {1.5 * distance_m, 1.2 * turn_rad});
    if (match.failed) {
      ++accuracy.failed;
      continue;
    }
    const Eigen::Vector3d e = errorOf(match.T_reference_body, truth);
    accuracy.translation_rms_m += e.head<2>().squaredNorm();
    accuracy.rotation_rms_rad += e.z() * e.z();
    accuracy.nees += e.dot(match.covariance.ldlt().solve(e));
  }
  const double matched = trials - accuracy.failed;
  accuracy.translation_rms_m = std::sqrt(accuracy.translation_rms_m / matched);
  accuracy.rotation_rms_rad = std::sqrt(accuracy.rotation_rms_rad / matched);
  accuracy.nees /= matched;
  return accuracy;
}

TYPED_TEST(LeastSquaresMatchers, AreAccurateToTwoMillimetresWithAMatchingCovariance) {
  const MatchErrors accuracy = measureAccuracy<TypeParam>(300, 0.08, 0.015);
  EXPECT_EQ(accuracy.failed, 0);
  EXPECT_LT(accuracy.translation_rms_m, 0.002);
  EXPECT_LT(accuracy.rotation_rms_rad, 0.05 * common::kRadPerDeg);
  EXPECT_GT(accuracy.nees, 1.0);
  EXPECT_LT(accuracy.nees, 4.5);
}

TYPED_TEST(LeastSquaresMatchers, ConvergeFromFarGuesses) {
  const MatchErrors accuracy = measureAccuracy<TypeParam>(100, 0.3, 0.15);
  EXPECT_EQ(accuracy.failed, 0);
  EXPECT_LT(accuracy.translation_rms_m, 0.003);
  EXPECT_LT(accuracy.nees, 4.5);
}

TYPED_TEST(LeastSquaresMatchers, ReportWhenTheyDidNotConverge) {
  // So far that the walls that face one way may fit while the others are out of reach.
  const MatchErrors accuracy = measureAccuracy<TypeParam>(150, 0.8, 0.4);
  EXPECT_LT(accuracy.failed, 15);
  EXPECT_LT(accuracy.translation_rms_m, 0.003);
  EXPECT_LT(accuracy.nees, 4.5);
}

TYPED_TEST(LeastSquaresMatchers, ReportNoUnobservableDirectionInARoom) {
  common::RandomStream random(10, "room");
  const test::PlanarWorld world = test::flat();
  for (int trial = 0; trial < 30; ++trial) {
    TypeParam matcher;
    const Pose2 reference = poseInFlat(random);
    matcher.addReference(scanAt(world, reference, 0), reference);
    EXPECT_FALSE(matcher.match(scanAt(world, reference, 1), reference, {0.05, 0.02}).unobservable_motion);
  }
}

TYPED_TEST(LeastSquaresMatchers, ReportAFailedMatch) {
  TypeParam matcher;
  const test::PlanarWorld world = test::flat();
  const ProjectedScan here = scanAt(world, {}, 0);
  EXPECT_TRUE(matcher.match(here, {}, {0.1, 0.03}).failed);  // No reference.
  matcher.addReference(here, {});
  // Another room, turned.
  EXPECT_TRUE(matcher.match(scanAt(world, {6.5, 2.0, 0.8}, 1), {}, {0.1, 0.03}).failed);
  EXPECT_FALSE(matcher.match(scanAt(world, {}, 2), {}, {0.1, 0.03}).failed);
  // The right place, but outside the window that was asked for.
  const MatchResult outside = matcher.match(scanAt(world, {0.08, 0.0, 0.0}, 3), {}, {0.03, 0.03});
  EXPECT_TRUE(outside.failed);
  EXPECT_TRUE(outside.at_window_edge);
  // Too few points, no points, no pose, a pose far off the map.
  ProjectedScan few = here;
  few.points_level_m.resize(10);
  EXPECT_TRUE(matcher.match(few, {}, {0.1, 0.03}).failed);
  few.points_level_m.resize(1);
  EXPECT_TRUE(matcher.match(few, {}, {0.1, 0.03}).failed);
  EXPECT_TRUE(matcher.match({}, {}, {0.1, 0.03}).failed);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(matcher.match(here, {nan, 0.0, 0.0}, {0.1, 0.03}).failed);
  for (const double far_m : {40.0, 1e6, 1e300}) {
    const MatchResult away = matcher.match(here, {far_m, 0.0, 0.0}, {0.1, 0.03});
    EXPECT_TRUE(away.failed);
    EXPECT_TRUE(isFinite(away.T_reference_body));
    EXPECT_TRUE(away.covariance.allFinite());
  }
  matcher.addReference(here, {0.0, nan, 0.0});
  matcher.clearReference();
  EXPECT_TRUE(matcher.match(here, {}, {0.1, 0.03}).failed);
}

TYPED_TEST(LeastSquaresMatchers, IgnorePointsThatAreNotFinite) {
  const test::PlanarWorld world = test::flat();
  TypeParam clean, dirty;
  ProjectedScan reference = scanAt(world, {}, 0), scan = scanAt(world, {0.02, 0.01, 0.0}, 1);
  clean.addReference(reference, {});
  const auto garbage = [](ProjectedScan& s) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    s.points_level_m.push_back({nan, 1.0F});
    s.points_level_m.push_back({std::numeric_limits<float>::infinity(), nan});
    s.heights_level_m.resize(s.points_level_m.size(), 0.0F);
  };
  const MatchResult expected = clean.match(scan, {}, {0.05, 0.02});
  garbage(reference);
  garbage(scan);
  dirty.addReference(reference, {});
  const MatchResult match = dirty.match(scan, {}, {0.05, 0.02});
  EXPECT_EQ(match.T_reference_body.x_m, expected.T_reference_body.x_m);
  EXPECT_EQ(match.covariance, expected.covariance);
}

TYPED_TEST(LeastSquaresMatchers, ClearTheirReference) {
  const test::PlanarWorld world = test::flat();
  TypeParam used, fresh;
  used.addReference(scanAt(world, {6.5, 2.0, 0.8}, 0), {6.5, 2.0, 0.8});
  static_cast<void>(used.match(scanAt(world, {6.5, 2.0, 0.8}, 1), {6.5, 2.0, 0.8}, {0.5, 0.1}));
  used.clearReference();
  for (auto* matcher : {&used, &fresh}) matcher->addReference(scanAt(world, {}, 2), {});
  const ProjectedScan scan = scanAt(world, {0.03, -0.02, 0.01}, 3);
  const MatchResult a = used.match(scan, {}, {0.2, 0.1}), b = fresh.match(scan, {}, {0.2, 0.1});
  EXPECT_FALSE(a.failed);
  EXPECT_LT((errorOf(a.T_reference_body, b.T_reference_body)).norm(), 1e-9);
}

TYPED_TEST(LeastSquaresMatchers, CombineSeveralScansIntoOneReference) {
  const test::PlanarWorld world = test::flat();
  // Neither scan sees everything that the one between them sees.
  const Pose2 west{0.5, 0.9, 3.1}, east{6.0, 0.9, 0.0}, truth{3.4, 0.95, 0.02};
  TypeParam matcher;
  matcher.addReference(scanAt(world, west, 0), west);
  const ProjectedScan scan = scanAt(world, truth, 2);
  const double overlap = matcher.match(scan, {3.38, 0.92, 0.0}, {0.1, 0.05}).overlap;
  matcher.addReference(scanAt(world, east, 1), east);
  const MatchResult match = matcher.match(scan, {3.38, 0.92, 0.0}, {0.1, 0.05});
  ASSERT_FALSE(match.failed);
  EXPECT_GT(match.overlap, overlap + 0.1);
  EXPECT_LT(errorOf(match.T_reference_body, truth).norm(), 0.006);
}

TYPED_TEST(LeastSquaresMatchers, AgreeWithTheExhaustiveMatcher) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(11, "agree");
  for (int trial = 0; trial < 40; ++trial) {
    const Pose2 reference = poseInFlat(random), truth = reference * stepWithin(random, 0.08, 0.015);
    const auto frame = 2 * static_cast<std::uint64_t>(trial);
    const ProjectedScan first = scanAt(world, reference, frame), second = scanAt(world, truth, frame + 1);
    TypeParam matcher;
    CorrelativeMatcher correlative{{}};
    matcher.addReference(first, reference);
    correlative.addReference(first, reference);
    const MatchResult a = matcher.match(second, reference, {0.12, 0.03});
    const MatchResult b = correlative.match(second, reference, {0.12, 0.03});
    EXPECT_LT(errorOf(a.T_reference_body, b.T_reference_body).head<2>().norm(), 0.005) << trial;
    EXPECT_NEAR(a.quality, b.quality, 0.1);
  }
}

}  // namespace
}  // namespace swiftlet::perception
