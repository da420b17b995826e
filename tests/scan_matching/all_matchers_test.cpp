// All matchers in the same scenes: their errors, and whether they report a failed match or an unobservable direction.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;
using test::errorOf;
using test::poseInFlat;
using test::scanAt;

/// The greatest errors that are accepted.
struct Tolerance {
  double median_m = 0.002, most_m = 0.005;  ///< `most`: of 95 %.
  double median_deg = 0.05, most_deg = 0.15;
  double loop_m = 0.006;  ///< Of the motion there and back.
};
/// An average over poses of a grid of 1 cm and 0.1 degrees is exact to half a cell; 95 % are within two.
constexpr Tolerance kOfTheGrid{0.005, 0.02, 0.05, 0.2, 0.02};

struct Kind {
  std::string name;
  std::function<std::unique_ptr<ScanMatcher>()> make;
  Tolerance tolerance;

  friend void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
};

Kind correlative(const std::string& name, PoseEstimate estimate, const Tolerance& tolerance = {}) {
  const auto make = [estimate]() -> std::unique_ptr<ScanMatcher> {
    CorrelativeMatcherConfig config;
    config.estimate = estimate;
    return std::make_unique<CorrelativeMatcher>(config);
  };
  return {name, make, tolerance};
}

template <typename Matcher>
Kind leastSquares(const std::string& name) {
  return {name, []() -> std::unique_ptr<ScanMatcher> { return std::make_unique<Matcher>(); }, {}};
}

class AllMatchers : public testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<ScanMatcher> matcherAt(const ProjectedScan& scan, const Pose2& pose) const {
    std::unique_ptr<ScanMatcher> matcher = GetParam().make();
    matcher->addReference(scan, pose);
    return matcher;
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, AllMatchers,
                         testing::Values(correlative("Correlative", PoseEstimate::kSurface),
                                         correlative("WeightedMean", PoseEstimate::kWeightedMean, kOfTheGrid),
                                         correlative("ScoreGrid", PoseEstimate::kScoreGrid),
                                         leastSquares<GaussNewtonMatcher>("GaussNewton"),
                                         leastSquares<PointToLineMatcher>("PointToLine")),
                         [](const auto& kind) { return kind.param.name; });

/// The pose of the reference, and the greatest error of the guess.
struct Scene {
  const char* name;
  test::PlanarWorld world;
  std::function<Pose2(common::RandomStream&)> somewhere;
  Pose2 farthest;  ///< Greatest distance of the truth from the reference; the guess is the reference.
  bool hides_x = false;
};

Pose2 poseInCorridor(common::RandomStream& random) {
  return {random.uniform(-2.0, 2.0), random.uniform(-0.4, 0.4), random.uniform(-3.1, 3.1)};
}

std::vector<Scene> scenes() {
  return {{"flat, 8 cm, 0.9 deg", test::flat(), poseInFlat, {0.08, 0.08, 0.9 * kRadPerDeg}},
          {"flat, 25 cm, 5 deg", test::flat(), poseInFlat, {0.25, 0.25, 5.0 * kRadPerDeg}},
          {"corridor, 8 cm, 0.9 deg", test::corridor(), poseInCorridor, {0.08, 0.08, 0.9 * kRadPerDeg}, true}};
}

/// The value that this share of them does not exceed.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

TEST_P(AllMatchers, AreAccurateInEveryScene) {
  constexpr int kTrials = 200;
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    common::RandomStream random(17, "same_scenes");
    std::vector<double> off_m, off_deg;
    int failed = 0, hidden = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      const Pose2 reference = scene.somewhere(random), &far = scene.farthest;
      const Pose2 step{random.uniform(-far.x_m, far.x_m), random.uniform(-far.y_m, far.y_m),
                       random.uniform(-far.yaw_rad, far.yaw_rad)};
      const Pose2 truth = reference * step;
      const auto matcher = matcherAt(scanAt(scene.world, reference, 2 * trial), reference);
      const MatchResult match =
          matcher->match(scanAt(scene.world, truth, 2 * trial + 1), reference, {1.5 * far.x_m, 1.2 * far.yaw_rad});
      failed += match.failed ? 1 : 0;
      hidden += match.unobservable_motion ? 1 : 0;
      const Eigen::Vector3d error = errorOf(match.T_reference_body, truth);
      off_m.push_back(scene.hides_x ? std::abs(error.y()) : error.head<2>().norm());
      off_deg.push_back(std::abs(error.z()) / kRadPerDeg);
      if (!scene.hides_x || !match.unobservable_motion) continue;
      EXPECT_GT(std::abs(match.unobservable_motion->change.x()), 0.98);
      EXPECT_GT(match.covariance(0, 0), 0.09);
      EXPECT_NEAR(match.T_reference_body.x_m, reference.x_m, 0.01);  // The guess is returned.
    }
    std::printf("  %-13s %-24s median %.2f mm %.3f deg, 95 %% %.2f mm %.3f deg, failed %d, hidden %d of %d\n",
                GetParam().name.c_str(), scene.name, 1e3 * quantile(off_m, 0.5), quantile(off_deg, 0.5),
                1e3 * quantile(off_m, 0.95), quantile(off_deg, 0.95), failed, hidden, kTrials);
    EXPECT_EQ(failed, 0);
    EXPECT_EQ(hidden, scene.hides_x ? kTrials : 0);
    const Tolerance& tolerance = GetParam().tolerance;
    EXPECT_LT(quantile(off_m, 0.5), tolerance.median_m);
    EXPECT_LT(quantile(off_m, 0.95), tolerance.most_m);
    EXPECT_LT(quantile(off_deg, 0.5), tolerance.median_deg);
    EXPECT_LT(quantile(off_deg, 0.95), tolerance.most_deg);
  }
}

TEST_P(AllMatchers, ForwardIsTheInverseOfBackward) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(9, "inverse");
  for (int trial = 0; trial < 20; ++trial) {
    const Pose2 a = poseInFlat(random);
    const Pose2 b = a * Pose2{random.uniform(-0.08, 0.08), random.uniform(-0.08, 0.08), random.uniform(-0.015, 0.015)};
    const ProjectedScan scan_a = scanAt(world, a, 10), scan_b = scanAt(world, b, 11);
    const Pose2 forth = matcherAt(scan_a, {})->match(scan_b, {}, {0.12, 0.03}).T_reference_body;
    const Pose2 back = matcherAt(scan_b, {})->match(scan_a, {}, {0.12, 0.03}).T_reference_body;
    const Pose2 loop = forth * back;
    EXPECT_LT(loop.position_m().norm(), GetParam().tolerance.loop_m);
    EXPECT_LT(std::abs(loop.yaw_rad), 0.15 * kRadPerDeg);
  }
}

/// What turns about the middle of a round room looks the same; how far from the middle the vehicle is, is measured.
TEST_P(AllMatchers, ReportTheUnobservableTurnInARoundRoom) {
  const test::PlanarWorld world = test::roundRoom(4.0);
  for (const double yaw : {0.0, 0.7, -2.0}) {
    const Pose2 reference{1.5, 0.5, yaw}, guess{1.5, 0.5, yaw + 0.01};
    const Pose2 truth{1.53, 0.54, yaw + 0.03};
    const MatchResult match =
        matcherAt(scanAt(world, reference, 0), reference)->match(scanAt(world, truth, 1), guess, {0.1, 0.05});
    ASSERT_FALSE(match.failed);
    ASSERT_TRUE(match.unobservable_motion);
    const Eigen::Vector3d& change = match.unobservable_motion->change;
    const Eigen::Vector2d to_middle_m = Eigen::Vector2d(-change.y(), change.x()) / change.z();
    EXPECT_LT((truth.position_m() + to_middle_m).norm(), 0.2) << "it is a turn about the middle";
    EXPECT_NEAR(match.T_reference_body.yaw_rad, guess.yaw_rad, 0.01) << "the guess is returned";
    EXPECT_NEAR(match.T_reference_body.position_m().norm(), truth.position_m().norm(), 0.01);
    EXPECT_GT(match.covariance(2, 2), 0.01);
  }
}

TEST_P(AllMatchers, ReportTheUnobservableDirectionOfACorridor) {
  const test::PlanarWorld world = test::corridor();
  for (const double yaw : {0.0, 0.7, -2.0}) {
    const Pose2 reference{0.0, 0.1, yaw};
    const Pose2 truth{0.06, 0.13, yaw + 0.01}, guess{0.03, 0.10, yaw};
    const MatchResult match =
        matcherAt(scanAt(world, reference, 0), reference)->match(scanAt(world, truth, 1), guess, {0.1, 0.03});
    ASSERT_FALSE(match.failed);
    ASSERT_TRUE(match.unobservable_motion);
    EXPECT_GT(std::abs(match.unobservable_motion->change.x()), 0.99);
    EXPECT_NEAR(match.T_reference_body.x_m, guess.x_m, 0.005);  // The guess is returned.
    EXPECT_NEAR(match.T_reference_body.y_m, truth.y_m, GetParam().tolerance.most_m);
    EXPECT_NEAR(match.T_reference_body.yaw_rad, truth.yaw_rad, 0.1 * kRadPerDeg);
    EXPECT_GT(match.covariance(0, 0), 0.09);
    EXPECT_LT(match.covariance(1, 1), 1e-4);
  }
}

void expectRefused(const MatchResult& match) {
  EXPECT_TRUE(match.failed);
  EXPECT_TRUE(isFinite(match.T_reference_body));
  EXPECT_TRUE(match.covariance.allFinite());
}

TEST_P(AllMatchers, RefuseUnusableInput) {
  const ProjectedScan scan = scanAt(test::flat(), {}, 0);
  const SearchWindow window{0.1, 0.03};
  const auto empty = GetParam().make();
  expectRefused(empty->match(scan, {}, window));
  empty->addReference({}, {});  // A scan without returns is not a reference.
  expectRefused(empty->match(scan, {}, window));

  const auto matcher = matcherAt(scan, {});
  expectRefused(matcher->match({}, {}, window));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double no_number : {nan, inf, -inf}) {
    expectRefused(matcher->match(scan, {no_number, 0.0, 0.0}, window));
    expectRefused(matcher->match(scan, {0.0, no_number, 0.0}, window));
    expectRefused(matcher->match(scan, {0.0, 0.0, no_number}, window));
  }
  for (const double far_m : {-40.0, 40.0, 1e6}) expectRefused(matcher->match(scan, {far_m, 0.0, 0.0}, window));
  // With an empty window they may match or not; their results are finite.
  for (const double no_width : {nan, -1.0}) {
    const MatchResult match = matcher->match(scan, {}, {no_width, no_width});
    EXPECT_TRUE(isFinite(match.T_reference_body));
    EXPECT_TRUE(match.covariance.allFinite());
  }
  EXPECT_FALSE(matcher->match(scan, {}, window).failed);  // None of this has left a trace.
}

TEST_P(AllMatchers, RarelyAcceptAWrongGuess) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(23, "wrong_guess");
  constexpr int kTrials = 200;
  int believed = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    const Pose2 reference = poseInFlat(random);
    const auto matcher = matcherAt(scanAt(world, reference, 2 * trial), reference);
    // Farther off than the window is wide, in all directions, and turned.
    const double distance_m = random.uniform(0.4, 1.5), bearing_rad = random.uniform(-3.1, 3.1);
    const double turn_rad = std::copysign(random.uniform(0.2, 0.6), random.uniform(-1.0, 1.0));
    const Pose2 guess =
        reference * Pose2{distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad), turn_rad};
    const MatchResult match = matcher->match(scanAt(world, reference, 2 * trial + 1), guess, {0.1, 0.05});
    // A pose at the edge is not accepted either: it asks for a wider window.
    if (!match.failed && !match.at_window_edge) ++believed;
  }
  std::printf("  %-13s believed %d of %d wrong guesses\n", GetParam().name.c_str(), believed, kTrials);
  EXPECT_LE(believed, kTrials / 100);
}

}  // namespace
}  // namespace swiftlet::perception
