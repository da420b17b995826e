// Trials that judge flights by their verdict: what counts over all of them.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "evaluation/criteria.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

FlightScore flight(Verdict verdict) {
  FlightScore score;
  score.verdict = verdict;
  score.mission_done = verdict == Verdict::kDone;
  const bool avoidable = verdict == Verdict::kCrashed || verdict == Verdict::kStruck;
  score.collisions = avoidable || verdict == Verdict::kForced ? 1 : 0;
  score.avoidable_collisions = avoidable ? 1 : 0;
  if (score.mission_done) score["goal_error_m"] = 0.02;
  return score;
}

Criteria byVerdict() {
  Criteria criteria;
  criteria.mission_done = false;
  criteria.verdicts = true;
  criteria["goal_error_max_m"] = 0.1;
  criteria["touch_down_speed_max_m_s"] = 0.5;
  return criteria;
}

/// `done` flights that did their mission, and the others.
TrialResult trial(int done, std::vector<Verdict> others, const Criteria& criteria = byVerdict()) {
  TrialResult result{"lab", "swiftlet", {}, {}, criteria};
  others.insert(others.end(), static_cast<std::size_t>(done), Verdict::kDone);
  for (const Verdict verdict : others) {
    FlightScore score = flight(verdict);
    score["touch_down_speed_m_s"] = 0.3;
    score.seed = static_cast<std::int64_t>(result.flights.size());
    score.failures = missed(score, criteria);
    result.flights.push_back(score);
  }
  return result;
}

TEST(VerdictCriteria, AFlightThatEndedWithAReasonPassesWithoutTheFiguresOfItsMission) {
  for (const Verdict good : {Verdict::kHome, Verdict::kLanded, Verdict::kRefused, Verdict::kForced})
    EXPECT_THAT(missed(flight(good), byVerdict()), IsEmpty()) << toString(good);
  FlightScore hard = flight(Verdict::kLanded);
  hard["touch_down_speed_m_s"] = 0.8;
  EXPECT_THAT(missed(hard, byVerdict()), ElementsAre(HasSubstr("touch-down"))) << "what it did is judged";
  FlightScore inaccurate = flight(Verdict::kDone);
  inaccurate["goal_error_m"].reset();
  inaccurate["touch_down_speed_m_s"] = 0.3;
  EXPECT_THAT(missed(inaccurate, byVerdict()), ElementsAre(HasSubstr("goal error"))) << "of a done one all is asked";
}

TEST(VerdictCriteria, AFaultThatNeverBeganHasTriedNothing) {
  Criteria criteria = byVerdict();
  criteria["safe_action_max_s"] = 3.0;
  for (const Verdict ended : {Verdict::kHome, Verdict::kLanded, Verdict::kRefused})
    EXPECT_THAT(missed(flight(ended), criteria),
                ElementsAre("time from fault to safe action, s: not measured, at most 3 was asked for"))
        << toString(ended);
  FlightScore tried = flight(Verdict::kLanded);
  tried["safe_action_s"] = 1.2;
  EXPECT_THAT(missed(tried, criteria), IsEmpty());
}

TEST(VerdictCriteria, OneNeedlessLandingOfTwentyIsAllowed) {
  EXPECT_TRUE(trial(19, {Verdict::kNeedless}).met());
  EXPECT_THAT(trial(18, {Verdict::kNeedless, Verdict::kNeedless}).missed(),
              ElementsAre(HasSubstr("needlessly: 0.100")));
  EXPECT_FALSE(trial(9, {Verdict::kNeedless}).met());
}

TEST(VerdictCriteria, AContactThatWasNotForcedFailsItsTrial) {
  for (const Verdict verdict : {Verdict::kCrashed, Verdict::kStruck}) {
    EXPECT_FALSE(trial(19, {verdict}).met()) << toString(verdict);
    EXPECT_FALSE(trial(19, {verdict}, {}).met()) << "whether verdicts are asked for or not";
  }
  EXPECT_TRUE(trial(18, {Verdict::kForced, Verdict::kForced}).met());
}

TEST(VerdictCriteria, NoFlightThatCrashedHasPassed) {
  for (const Verdict crash : {Verdict::kCrashed, Verdict::kForced, Verdict::kStruck}) {
    const TrialResult result = trial(9, {crash});
    EXPECT_EQ(result.passed(), 9) << toString(crash);
    const auto written = nlohmann::json::parse(toJson({{result}})).at("trials").at(0);
    EXPECT_EQ(written.at("passed"), 9) << toString(crash);
    EXPECT_EQ(written.at("flights").at(0).at("passed"), false) << toString(crash);
    EXPECT_THAT(toText(failureTable({{result}})), HasSubstr(std::string("collision (") + toString(crash)));
  }
}

TEST(VerdictCriteria, WhoLeavesTheBuildingOrIsStillUpFails) {
  EXPECT_THAT(missed(flight(Verdict::kOutside), byVerdict()), ElementsAre(HasSubstr("verdict outside")));
  EXPECT_THAT(missed(flight(Verdict::kUnfinished), byVerdict()), ElementsAre(HasSubstr("verdict unfinished")));
}

TEST(VerdictCriteria, PhasesAndTheOperatorAreJudgedHoweverTheFlightEnded) {
  FlightScore score = flight(Verdict::kLanded);
  PhaseBound bound;
  bound.figure = "position_std_m";
  bound.max = 0.05;
  score.phases = {{"hover", {{"time_s", 0.0}}, {bound}}};
  score.operator_answers = {{"hold", ExpectedAnswer::kAccepted, common::Time::fromSeconds(3), false, "it lands"}};
  EXPECT_THAT(missed(score, byVerdict()),
              ElementsAre("phase hover: position_std_m: not measured, at most 0.05 was asked for",
                          "operator: hold at 3.0 s: refused, it lands"));
}

TEST(VerdictCriteria, TheShareThatMustBeDoneCounts) {
  Criteria criteria = byVerdict();
  criteria["done_share_min"] = 0.9;
  EXPECT_TRUE(trial(18, {Verdict::kHome, Verdict::kLanded}, criteria).met());
  EXPECT_THAT(trial(17, {Verdict::kHome, Verdict::kHome, Verdict::kLanded}, criteria).missed(),
              ElementsAre(HasSubstr("share of flights done: 0.8500")));
}

TEST(VerdictCriteria, ResultsAndTablesCountTheVerdicts) {
  const TrialResults results{{trial(2, {Verdict::kHome, Verdict::kForced})}};
  const auto results_json = nlohmann::json::parse(toJson(results)).at("trials").at(0);
  EXPECT_EQ(results_json.at("verdicts"), (nlohmann::json{{"done", 2}, {"home", 1}, {"forced", 1}}));
  EXPECT_EQ(results_json.at("done_share"), 0.5);
  EXPECT_EQ(results_json.at("flights").at(0).at("verdict"), "home");
  EXPECT_THAT(toText(summaryTable(results)), HasSubstr("needless"));
  EXPECT_THAT(toText(flightTable(results.trials[0])), HasSubstr("verdict"));
}

}  // namespace
}  // namespace swiftlet::evaluation
