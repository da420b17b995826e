// Which reported targets are true ones, and how far they are off.
#include <gtest/gtest.h>

#include "evaluation/flight_score.hpp"
#include "evaluation/target_score.hpp"

namespace swiftlet::evaluation {
namespace {

common::Target reported(const std::string& name, double x_m, double y_m, bool found = true) {
  common::Target target;
  target.name = name;
  target.position_map_m = {x_m, y_m, 0.1};
  target.state = found ? common::TargetState::kFound : common::TargetState::kCandidate;
  return target;
}

const std::vector<TrueTarget> kTruth = {{"red", {2.0, 1.0, 0.1}}, {"red", {2.0, 1.5, 0.1}}, {"blue", {5.0, 0.0, 0.1}}};
/// The flight began at (1, 0) in the world.
const common::Pose3 kStart = common::lifted({1.0, 0.0, 0.0}, 0.0);

TEST(TargetScore, NearestPairsOfOneNameBelongTogether) {
  const auto score = scoreTargets({reported("red", 1.05, 1.4), reported("red", 1.0, 1.02), reported("blue", 4.03, 0.0)},
                                  kTruth, kStart);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->found, 1.0);
  EXPECT_EQ(score->false_targets, 0.0);
  EXPECT_NEAR(*score->error_max_m, std::hypot(0.05, 0.1), 1e-9);
  EXPECT_NEAR(*score->error_median_m, 0.03, 1e-9);
}

TEST(TargetScore, TheSameAgainAndWhatIsNoneCountAsFalse) {
  const auto score = scoreTargets({reported("red", 1.0, 1.0), reported("red", 1.0, 0.9), reported("red", 4.0, 0.0),
                                   reported("blue", 4.6, 0.0), reported("blue", 4.0, 0.0, false)},
                                  kTruth, kStart);
  EXPECT_NEAR(score->found, 1.0 / 3.0, 1e-9)
      << "the second one is too far for the other red one, the candidate is none";
  EXPECT_EQ(score->false_targets, 3.0);
}

TEST(TargetScore, WithoutTargetsInTheTrialThereIsNone) {
  EXPECT_FALSE(scoreTargets({reported("red", 1.0, 1.0)}, {}, kStart));
  const auto none = scoreTargets({}, kTruth, kStart);
  EXPECT_EQ(none->found, 0.0);
  EXPECT_FALSE(none->error_max_m);
}

TEST(TargetScore, CriteriaJudgeThem) {
  FlightScore score;
  score.mission_done = true;
  score.behaviors.targets_found = 2.0 / 3.0;
  score.behaviors.target_error_max_m = 0.12;
  score.behaviors.false_targets = 1.0;
  Criteria criteria;
  EXPECT_TRUE(missed(score, criteria).empty());
  criteria.targets_found_min = 1.0;
  criteria.target_error_max_m = 0.1;
  criteria.false_targets_max = 0.0;
  EXPECT_EQ(missed(score, criteria).size(), 3u);
}

}  // namespace
}  // namespace swiftlet::evaluation
