// Which reported targets are true ones, and how far they are off.
#include <gtest/gtest.h>

#include "evaluation/criteria.hpp"
#include "evaluation/figure_measures.hpp"

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
const common::Pose3 kTargetStart = common::lifted({1.0, 0.0, 0.0}, 0.0);

FlightScore measured(const std::vector<common::Target>& targets, const std::vector<TrueTarget>& truth = kTruth) {
  FlightScore score;
  measureTargets(targets, truth, kTargetStart, score);
  return score;
}

TEST(TargetScore, NearestPairsOfOneNameBelongTogether) {
  FlightScore score = measured({reported("red", 1.05, 1.4), reported("red", 1.0, 1.02), reported("blue", 4.03, 0.0)});
  EXPECT_EQ(score["targets_found"], 1.0);
  EXPECT_EQ(score["false_targets"], 0.0);
  EXPECT_NEAR(*score["target_error_max_m"], std::hypot(0.05, 0.1), 1e-9);
  EXPECT_NEAR(*score["target_error_median_m"], 0.03, 1e-9);
}

TEST(TargetScore, TheSameAgainAndWhatIsNoneCountAsFalse) {
  FlightScore score = measured({reported("red", 1.0, 1.0), reported("red", 1.0, 0.9), reported("red", 4.0, 0.0),
                                reported("blue", 4.6, 0.0), reported("blue", 4.0, 0.0, false)});
  EXPECT_NEAR(*score["targets_found"], 1.0 / 3.0, 1e-9)
      << "the second one is too far for the other red one, the candidate is none";
  EXPECT_EQ(score["false_targets"], 3.0);
}

TEST(TargetScore, WithoutTargetsInTheTrialThereIsNone) {
  EXPECT_FALSE(measured({reported("red", 1.0, 1.0)}, {}).figure("targets_found"));
  FlightScore none = measured({});
  EXPECT_EQ(none["targets_found"], 0.0);
  EXPECT_FALSE(none["target_error_max_m"]);
}

TEST(TargetScore, CriteriaJudgeThem) {
  FlightScore score;
  score.mission_done = true;
  score["targets_found"] = 2.0 / 3.0;
  score["target_error_max_m"] = 0.12;
  score["false_targets"] = 1.0;
  Criteria criteria;
  EXPECT_TRUE(missed(score, criteria).empty());
  criteria["targets_found_min"] = 1.0;
  criteria["target_error_max_m"] = 0.1;
  criteria["false_targets_max"] = 0.0;
  EXPECT_EQ(missed(score, criteria).size(), 3u);
}

}  // namespace
}  // namespace swiftlet::evaluation
