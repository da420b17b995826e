#include "perception/scan_matching/correlative_matcher.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::errorOf;
using test::poseInFlat;
using test::scanAt;

/// A small step and a guess that does not include it.
Pose2 randomStep(common::RandomStream& random) {
  return {random.uniform(-0.08, 0.08), random.uniform(-0.08, 0.08), random.uniform(-0.015, 0.015)};
}

void expectTheExhaustiveAnswer(const CorrelativeMatcherConfig& config, const SearchWindow& widest, int trials) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(3, "exhaustive");
  for (int trial = 0; trial < trials; ++trial) {
    CorrelativeMatcher matcher{config};
    const Pose2 reference = poseInFlat(random);
    const auto frame = 2 * static_cast<std::uint64_t>(trial);
    matcher.addReference(scanAt(world, reference, frame), reference);
    const ProjectedScan scan = scanAt(world, reference * randomStep(random), frame + 1);
    const SearchWindow window{random.uniform(0.0, widest.half_translation_m),
                              random.uniform(0.0, widest.half_rotation_rad)};
    const MatchResult fast = matcher.match(scan, reference, window);
    const MatchResult slow = matcher.matchExhaustively(scan, reference, window);
    ASSERT_EQ(fast.finest_score, slow.finest_score) << trial;
    ASSERT_GT(fast.finest_score, 0);
  }
}

TEST(CorrelativeMatcher, EqualsTheExhaustiveSearch) {
  expectTheExhaustiveAnswer({}, {0.15, 2.0 * common::kRadPerDeg}, 40);
}

TEST(CorrelativeMatcher, EqualsTheExhaustiveSearchInAWideWindow) {
  CorrelativeMatcherConfig config;
  config.resolution_m = 0.04;
  config.sigma_m = 0.08;
  config.angular_resolution_deg = 1.0;
  expectTheExhaustiveAnswer(config, {3.0, 20.0 * common::kRadPerDeg}, 6);
}

TEST(CorrelativeMatcher, EqualsTheExhaustiveSearchWithoutThePriorOfTheGuess) {
  CorrelativeMatcherConfig config;
  config.guess_weight = 0.0;
  expectTheExhaustiveAnswer(config, {0.15, 2.0 * common::kRadPerDeg}, 20);
}

/// One beam a degree meets the walls of a corridor, 10 m off, in dots 0.9 m apart. The same beams of the next scan meet
/// them in the same pattern: matched to dots they would outvote the pillar, and the vehicle would stand still.
TEST(CorrelativeMatcher, DotsOnADistantWallDoNotHoldTheVehicleInPlace) {
  test::PlanarWorld world = test::corridor();
  world.addPolyline({{4.0, -1.0}, {4.0, -0.6}}, false);
  common::LaserConfig laser;
  laser.beams = 181;
  laser.field_of_view_deg = 180.0;
  laser.range_noise_m = 0.002;
  CorrelativeMatcherConfig config;
  config.guess_weight = 0.0;
  config.min_normal_spread = 0.0;
  for (const double step_m : {0.08, 0.10, 0.12}) {
    CorrelativeMatcher matcher{config};
    const Pose2 reference{0.0, 0.1, 0.0}, truth{step_m, 0.1, 0.0};
    matcher.addReference(test::scanAt(world, reference, 0, 1.0, laser), reference);
    const MatchResult match = matcher.match(test::scanAt(world, truth, 1, 1.0, laser), reference, {0.25, 0.03});
    EXPECT_FALSE(match.failed);
    EXPECT_NEAR(match.T_reference_body.x_m, step_m, 0.02);
  }
}

TEST(CorrelativeMatcher, EveryInstructionSetGivesIdenticalResults) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(4, "instructions");
  const Pose2 reference = poseInFlat(random);
  for (int trial = 0; trial < 10; ++trial) {
    const Pose2 guess = reference * randomStep(random);
    const ProjectedScan scan = scanAt(world, reference * randomStep(random), static_cast<std::uint64_t>(trial) + 1);
    std::optional<MatchResult> first;
    for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
      if (!isAvailable(instructions)) continue;
      CorrelativeMatcher matcher({}, instructions);
      matcher.addReference(scanAt(world, reference, 0), reference);
      const MatchResult result = matcher.match(scan, guess, {0.1, 0.03});
      if (!first) first = result;
      EXPECT_EQ(result.T_reference_body.x_m, first->T_reference_body.x_m) << toString(instructions);
      EXPECT_EQ(result.T_reference_body.y_m, first->T_reference_body.y_m);
      EXPECT_EQ(result.T_reference_body.yaw_rad, first->T_reference_body.yaw_rad);
      EXPECT_EQ(result.finest_score, first->finest_score);
      EXPECT_EQ((result.covariance - first->covariance).norm(), 0.0);
    }
  }
}

struct Accuracy {
  double translation_rms_m = 0.0;
  double rotation_rms_rad = 0.0;
  double nees = 0.0;  ///< Mean of the normalized squared error; 3 when the covariance is exact.
};

Accuracy measureAccuracy(const CorrelativeMatcherConfig& config, int trials) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(5, "accuracy");
  Accuracy accuracy;
  for (int trial = 0; trial < trials; ++trial) {
    CorrelativeMatcher matcher{config};
    const Pose2 reference = poseInFlat(random);
    const auto frame = 2 * static_cast<std::uint64_t>(trial);
    matcher.addReference(scanAt(world, reference, frame), reference);
    const Pose2 truth = reference * randomStep(random);
    const MatchResult match = matcher.match(scanAt(world, truth, frame + 1), reference, {0.1, 0.03});
    EXPECT_FALSE(match.failed);
    const Eigen::Vector3d e = errorOf(match.T_reference_body, truth);
    accuracy.translation_rms_m += e.head<2>().squaredNorm() / trials;
    accuracy.rotation_rms_rad += e.z() * e.z() / trials;
    accuracy.nees += e.dot(match.covariance.ldlt().solve(e)) / trials;
  }
  accuracy.translation_rms_m = std::sqrt(accuracy.translation_rms_m);
  accuracy.rotation_rms_rad = std::sqrt(accuracy.rotation_rms_rad);
  return accuracy;
}

TEST(CorrelativeMatcher, IsAccurateToTwoMillimetresWithAMatchingCovariance) {
  const Accuracy surface = measureAccuracy({}, 200);
  EXPECT_LT(surface.translation_rms_m, 0.002);
  EXPECT_LT(surface.rotation_rms_rad, 0.05 * common::kRadPerDeg);
  EXPECT_GT(surface.nees, 1.0);
  EXPECT_LT(surface.nees, 4.5);
  CorrelativeMatcherConfig config;
  config.estimate = PoseEstimate::kFinest;
  EXPECT_LT(surface.translation_rms_m, 0.6 * measureAccuracy(config, 100).translation_rms_m);
}

TEST(CorrelativeMatcher, BothAveragesReduceTheJitterOfTheGrid) {
  const test::PlanarWorld world = test::flat();
  const Pose2 reference{0.3, 0.2, 0.5};
  const auto jitter = [&](PoseEstimate estimate) {
    CorrelativeMatcherConfig config;
    config.estimate = estimate;
    CorrelativeMatcher matcher{config};
    matcher.addReference(scanAt(world, reference, 0), reference);
    common::RandomStream random(8, "hover");
    double sum2 = 0.0;
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (std::uint64_t frame = 1; frame <= 150; ++frame) {
      // A slow circle of two centimetres; the prediction is some millimetres off.
      const double phase = 0.05 * static_cast<double>(frame);
      const Pose2 truth = reference * Pose2{0.02 * std::cos(phase), 0.02 * std::sin(phase), 0.003 * std::sin(phase)};
      const Pose2 guess = truth * Pose2{random.gaussian(0.006), random.gaussian(0.006), random.gaussian(0.003)};
      const MatchResult match = matcher.match(scanAt(world, truth, frame), guess, {0.04, 0.01});
      const Eigen::Vector3d e = errorOf(match.T_reference_body, truth);
      if (frame > 1) sum2 += (e - last).head<2>().squaredNorm();
      last = e;
    }
    return std::sqrt(sum2 / 149.0);
  };
  const double finest = jitter(PoseEstimate::kFinest);
  RecordProperty("finest_mm", std::to_string(1e3 * finest));
  EXPECT_LT(jitter(PoseEstimate::kWeightedMean), finest);
  EXPECT_LT(jitter(PoseEstimate::kSurface), 0.5 * finest);
}

/// A cupboard that the reference never showed faces the vehicle; it has no effect.
TEST(CorrelativeMatcher, NewSurfacesDoNotConstrainThePose) {
  test::PlanarWorld furnished = test::corridor();
  furnished.addPolyline({{4.0, 1.0}, {4.0, 0.5}, {5.0, 0.5}, {5.0, 1.0}}, false);
  CorrelativeMatcher matcher{{}};
  matcher.addReference(scanAt(test::corridor(), {0.0, 0.1, 0.0}, 0), {0.0, 0.1, 0.0});
  const Pose2 truth{0.06, 0.13, 0.01}, guess{0.03, 0.10, 0.0};
  const MatchResult match = matcher.match(scanAt(furnished, truth, 1), guess, {0.1, 0.03});
  ASSERT_FALSE(match.failed);
  ASSERT_TRUE(match.unobservable_motion);
  EXPECT_GT(std::abs(match.unobservable_motion->change.x()), 0.99);
  EXPECT_NEAR(match.T_reference_body.x_m, guess.x_m, 0.005);
}

/// The reference covers a third of the present view: the rest does not count against the pose.
TEST(CorrelativeMatcher, MatchesWhenTheReferenceCoversAThirdOfTheView) {
  const test::PlanarWorld world = test::flat();
  ProjectedScan narrow = scanAt(world, {}, 0);
  std::erase_if(narrow.points_level_m,
                [](const Eigen::Vector2f& p) { return std::abs(std::atan2(p.y(), p.x())) > 0.9F; });
  CorrelativeMatcher matcher{{}};
  matcher.addReference(narrow, {});
  const Pose2 truth{0.06, -0.04, 0.03};
  const MatchResult match = matcher.match(scanAt(world, truth, 1), {}, {0.1, 0.06});
  EXPECT_FALSE(match.failed);
  EXPECT_GT(match.quality, 0.8);
  EXPECT_LT(errorOf(match.T_reference_body, truth).head<2>().norm(), 0.02);
}

TEST(CorrelativeMatcher, ReportsNoUnobservableDirectionInARoom) {
  common::RandomStream random(10, "room");
  const test::PlanarWorld world = test::flat();
  for (int trial = 0; trial < 30; ++trial) {
    CorrelativeMatcher matcher{{}};
    const Pose2 reference = poseInFlat(random);
    matcher.addReference(scanAt(world, reference, 0), reference);
    EXPECT_FALSE(matcher.match(scanAt(world, reference, 1), reference, {0.05, 0.02}).unobservable_motion);
  }
}

TEST(CorrelativeMatcher, ReportsAFailedMatch) {
  CorrelativeMatcher matcher{{}};
  const test::PlanarWorld world = test::flat();
  matcher.addReference(scanAt(world, {0.0, 0.0, 0.0}, 0), {});
  // Another room, turned.
  EXPECT_TRUE(matcher.match(scanAt(world, {6.5, 2.0, 0.8}, 1), {}, {0.1, 0.03}).failed);
  EXPECT_FALSE(matcher.match(scanAt(world, {0.0, 0.0, 0.0}, 2), {}, {0.1, 0.03}).failed);
  // Too few points, no points, no reference, no pose.
  ProjectedScan few = scanAt(world, {0.0, 0.0, 0.0}, 3);
  few.points_level_m.resize(10);
  EXPECT_TRUE(matcher.match(few, {}, {0.1, 0.03}).failed);
  EXPECT_TRUE(matcher.match({}, {}, {0.1, 0.03}).failed);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(matcher.match(scanAt(world, {}, 4), {nan, 0.0, 0.0}, {0.1, 0.03}).failed);
  matcher.addReference(scanAt(world, {}, 5), {0.0, nan, 0.0});
  matcher.clearReference();
  EXPECT_TRUE(matcher.match(scanAt(world, {}, 6), {}, {0.1, 0.03}).failed);
}

TEST(CorrelativeMatcher, IgnoresPointsThatAreNotFinite) {
  const test::PlanarWorld world = test::flat();
  CorrelativeMatcher clean{{}}, dirty{{}};
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
  EXPECT_EQ(dirty.match(scan, {}, {0.05, 0.02}).T_reference_body.x_m, expected.T_reference_body.x_m);
}

TEST(CorrelativeMatcher, ClearsItsReference) {
  const test::PlanarWorld world = test::flat();
  CorrelativeMatcher used{{}}, fresh{{}};
  used.addReference(scanAt(world, {6.5, 2.0, 0.8}, 0), {6.5, 2.0, 0.8});
  static_cast<void>(used.match(scanAt(world, {6.5, 2.0, 0.8}, 1), {6.5, 2.0, 0.8}, {0.5, 0.1}));
  used.clearReference();
  for (CorrelativeMatcher* matcher : {&used, &fresh}) matcher->addReference(scanAt(world, {}, 2), {});
  const ProjectedScan scan = scanAt(world, {0.03, -0.02, 0.01}, 3);
  EXPECT_EQ(used.match(scan, {}, {0.5, 0.1}).finest_score, fresh.match(scan, {}, {0.5, 0.1}).finest_score);
}

}  // namespace
}  // namespace swiftlet::perception
