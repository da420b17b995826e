// All poses of a window scored at once, against single lookups of each point at each pose; and the matcher that uses
// it.
#include <cmath>

#include <gtest/gtest.h>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/score_grid.hpp"
#include "tests/scan_matching/scenes.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using test::errorOf;
using test::poseInFlat;
using test::scanAt;

/// The grid of Bachrach 2009.
CorrelativeMatcherConfig everyPose() {
  CorrelativeMatcherConfig config;
  config.estimate = PoseEstimate::kScoreGrid;
  config.resolution_m = 0.0075;
  config.sigma_m = 0.0175;
  config.angular_resolution_deg = 0.15;
  config.surface_points = 350;
  return config;
}

Pose2 smallStep(common::RandomStream& random) {
  return {random.uniform(-0.06, 0.06), random.uniform(-0.06, 0.06), random.uniform(-0.01, 0.01)};
}

TEST(ScoreGrid, EachScoreEqualsTheSumOfItsLookUps) {
  common::RandomStream random(6, "grid");
  LikelihoodField field(0.01, 0.02);
  const ProjectedScan reference = scanAt(test::flat(), {0.2, 0.1, 0.3}, 0);
  field.draw(contourOf(reference.points_level_m, 0.3, 20.0));
  // More points than one sum of windows takes, a window wider than one strip.
  std::vector<float> x_m, y_m;
  for (const Eigen::Vector2f& p : spreadPoints(reference.points_level_m, 300, 20.0)) {
    x_m.push_back(p.x());
    y_m.push_back(p.y());
  }
  const PoseGrid window{-0.1, -0.08, -0.004, 0.002, 5, 21};
  for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
    if (!isAvailable(instructions)) continue;
    ScoreGrid grid(instructions);
    grid.score(field, x_m, y_m, window);
    std::vector<std::int32_t> x_cells(x_m.size()), y_cells(x_m.size());
    for (int k = -ScoreGrid::kMargin; k < window.rotations + ScoreGrid::kMargin; ++k) {
      const double yaw_rad = window.first_yaw_rad + k * window.step_yaw_rad, margin_m = ScoreGrid::kMargin * 0.01;
      transformToCells(x_m, y_m, static_cast<float>(std::cos(yaw_rad) * 100.0),
                       static_cast<float>(std::sin(yaw_rad) * 100.0),
                       static_cast<float>((window.first_x_m - margin_m) * 100.0 - field.beginX()),
                       static_cast<float>((window.first_y_m - margin_m) * 100.0 - field.beginY()), x_cells, y_cells);
      for (int trial = 0; trial < 100; ++trial) {
        const int side = window.translations + 2 * ScoreGrid::kMargin;
        const int x = static_cast<int>(random.uniform() * side), y = static_cast<int>(random.uniform() * side);
        std::uint32_t expected = 0;
        for (std::size_t i = 0; i < x_cells.size(); ++i) expected += field.at(x_cells[i] + x, y_cells[i] + y);
        ASSERT_EQ(grid.at(x - ScoreGrid::kMargin, y - ScoreGrid::kMargin, k), expected);
      }
    }
  }
}

TEST(ScoreGrid, TheMatchEqualsTheExhaustiveSearchWithEveryInstructionSet) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(3, "every_pose");
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const Pose2 reference = poseInFlat(random);
    const ProjectedScan first = scanAt(world, reference, 2 * trial);
    const ProjectedScan scan = scanAt(world, reference * smallStep(random), 2 * trial + 1);
    const SearchWindow window{random.uniform(0.0, 0.09), random.uniform(0.0, 0.02)};
    std::optional<MatchResult> expected;
    for (const Instructions instructions : {Instructions::kScalar, Instructions::kSse41, Instructions::kAvx2}) {
      if (!isAvailable(instructions)) continue;
      CorrelativeMatcher matcher(everyPose(), instructions);
      matcher.addReference(first, reference);
      const MatchResult match = matcher.match(scan, reference, window);
      if (!expected) {
        expected = match;
        const MatchResult slow = matcher.matchExhaustively(scan, reference, window);
        ASSERT_EQ(match.finest_score, slow.finest_score) << trial;
        ASSERT_EQ(match.finest_T_reference_body.x_m, slow.finest_T_reference_body.x_m);
        ASSERT_EQ(match.finest_T_reference_body.yaw_rad, slow.finest_T_reference_body.yaw_rad);
      }
      EXPECT_EQ(match.T_reference_body.x_m, expected->T_reference_body.x_m) << toString(instructions);
      EXPECT_EQ(match.T_reference_body.yaw_rad, expected->T_reference_body.yaw_rad);
      EXPECT_EQ(match.covariance, expected->covariance);
    }
  }
}

TEST(ScoreGrid, TheMatchIsAccurateWithAMatchingCovariance) {
  const test::PlanarWorld world = test::flat();
  common::RandomStream random(5, "accuracy");
  constexpr int kTrials = 150;
  double squares_m2 = 0.0, nees = 0.0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    CorrelativeMatcher matcher(everyPose());
    const Pose2 reference = poseInFlat(random), truth = reference * smallStep(random);
    matcher.addReference(scanAt(world, reference, 2 * trial), reference);
    const MatchResult match = matcher.match(scanAt(world, truth, 2 * trial + 1), reference, {0.09, 0.02});
    ASSERT_FALSE(match.failed);
    const Eigen::Vector3d e = errorOf(match.T_reference_body, truth);
    squares_m2 += e.head<2>().squaredNorm() / kTrials;
    nees += e.dot(match.covariance.ldlt().solve(e)) / kTrials;
  }
  EXPECT_LT(std::sqrt(squares_m2), 0.002);
  EXPECT_GT(nees, 1.0);
  EXPECT_LT(nees, 4.5);
}

TEST(ScoreGrid, TheScoresShowTheUnobservableDirectionOfACorridor) {
  CorrelativeMatcherConfig config = everyPose();
  config.min_normal_spread = 0.0;
  CorrelativeMatcher matcher(config);
  const test::PlanarWorld world = test::corridor();
  const Pose2 reference{0.0, 0.1, 0.7}, truth{0.06, 0.13, 0.71}, guess{0.03, 0.10, 0.7};
  matcher.addReference(scanAt(world, reference, 0), reference);
  const MatchResult match = matcher.match(scanAt(world, truth, 1), guess, {0.2, 0.02});
  ASSERT_FALSE(match.failed);
  // The direction does not extend over the whole window, because dots on distant walls match by chance, but it is far
  // longer than in a room.
  EXPECT_GT(match.covariance(0, 0), 20.0 * match.covariance(1, 1));
  EXPECT_NEAR(match.T_reference_body.y_m, truth.y_m, 0.004);
}

TEST(ScoreGrid, TwoSimilarPosesWidenTheCovariance) {
  // Likelihood on the surface of the best and on a pose far away along x.
  LikelihoodField field(0.01, 0.02);
  std::vector<ContourSegment> posts;
  for (int i = 0; i < 8; ++i)
    for (const double shift_m : {0.0, 0.16})
      posts.push_back({Eigen::Vector2d(i + shift_m, 2.0 * (i % 2)), Eigen::Vector2d(i + shift_m, 2.0 * (i % 2))});
  field.draw(posts);
  std::vector<float> x_m, y_m;
  for (int i = 0; i < 8; ++i) {
    x_m.push_back(static_cast<float>(i));
    y_m.push_back(static_cast<float>(2 * (i % 2)));
  }
  ScoreGrid grid(bestInstructions());
  grid.score(field, x_m, y_m, {-0.2, -0.2, 0.0, 0.01, 1, 41});
  const BestPose best = grid.best({});
  const Eigen::Matrix3d spread = grid.spreadElsewhere(best, 1.0);
  EXPECT_NEAR(spread(0, 0), 0.5 * 16.0 * 16.0, 40.0);
  EXPECT_LT(spread(1, 1), 10.0);
}

}  // namespace
}  // namespace swiftlet::perception
