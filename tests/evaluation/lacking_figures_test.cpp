// A figure that a criterion names and a flight lacks fails; and the conditions that a trial is flown in.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "evaluation/criteria.hpp"
#include "evaluation/trial.hpp"
#include "evaluation/trial_results.hpp"

namespace swiftlet::evaluation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(LackingFigures, OfAFlightFailIt) {
  Criteria criteria;
  criteria.mission_done = false;
  criteria["wrong_time_share_max"] = 0.1;
  EXPECT_THAT(missed({}, criteria),
              ElementsAre("share of the time localized wrongly: not measured, at most 0.1 was asked for"));
}

TEST(LackingFigures, AMissionThatNeverBeganHasNoTime) {
  Criteria criteria;
  criteria.mission_done = false;
  criteria["mission_time_max_s"] = 100;
  FlightScore score;
  EXPECT_THAT(missed(score, criteria), ElementsAre("mission time, s: not measured, at most 100 was asked for"));
  score["mission_time_s"] = 0.0;
  EXPECT_THAT(missed(score, criteria), IsEmpty());
}

TEST(LackingFigures, CountAsTheWorstInAMedian) {
  TrialResult trial{"unb", "swiftlet", {}, {}};
  trial.criteria["goal_error_median_max_m"] = 0.05;
  trial.flights.resize(5);
  trial.flights[0]["goal_error_m"] = 0.01;
  trial.flights[1]["goal_error_m"] = 0.02;
  EXPECT_THAT(trial.missed(),
              ElementsAre("goal error median, m: 3 of 5 flights lack the figure, at most 0.05 was asked for"));
  trial.flights[2]["goal_error_m"] = 0.06;
  EXPECT_THAT(trial.missed(), ElementsAre("goal error median, m: 0.060, at most 0.05 was asked for"))
      << "0.01, 0.02, 0.06, lacking, lacking";
  trial.flights[2]["goal_error_m"] = 0.04;
  EXPECT_THAT(trial.missed(), IsEmpty());
  trial.flights.pop_back();
  EXPECT_THAT(trial.missed(), IsEmpty()) << "0.01, 0.02, 0.04, lacking";
}

TrialResult turnedTrial() {
  TrialResult trial{"unb", "swiftlet", {}, {}};
  trial.flights.resize(2);
  for (FlightScore& flight : trial.flights) {
    flight["goal_error_m"] = 0.02;
    flight["goal_error_raw_m"] = 0.073;
    flight["estimate_rms_m"] = 0.011;
    flight["estimate_rms_raw_m"] = 0.094;
    flight["tilted_share"] = 0.035;
  }
  return trial;
}

TEST(RawFrame, HasItsRowAndFiguresWhereItDiffers) {
  TrialResults results{{turnedTrial()}};
  const std::string text = toText(summaryTable(results));
  EXPECT_THAT(text, testing::ContainsRegex("  in the raw frame +0.073 +0.073 +0.094"));
  const auto trial = nlohmann::json::parse(toJson(results))["trials"][0];
  EXPECT_EQ(trial["goal_error_max_m"], 0.02);
  EXPECT_EQ(trial["goal_error_max_raw_m"], 0.073);
  EXPECT_EQ(trial["flights"][0]["estimate_rms_raw_m"], 0.094);
  EXPECT_EQ(trial["tilted_share_max"], 0.035);
  EXPECT_EQ(trial["flights"][0]["tilted_share"], 0.035);
  EXPECT_TRUE(trial["flights"][0]["safe_action_s"].is_null());
  EXPECT_THAT(toText(conductTable(results.trials[0])), HasSubstr("3.5 %"));
  for (FlightScore& flight : results.trials[0].flights) {
    flight["goal_error_raw_m"] = flight["goal_error_m"];
    flight["estimate_rms_raw_m"] = flight["estimate_rms_m"];
  }
  EXPECT_THAT(toText(summaryTable(results)), testing::Not(HasSubstr("raw frame")));
}

TEST(Conditions, EachBatteryIsFlownInEachNature) {
  TrialConfig trial;
  trial.name = "house";
  trial.natures = {"real", "harsh"};
  trial.batteries = {0.25, 0.8};
  trial.scenario.variation.battery_remaining = 0.1;
  std::vector<std::string> names;
  for (const TrialConfig& one : trial.byCondition()) {
    names.push_back(one.name);
    EXPECT_EQ(one.scenario.battery_remaining, one.batteries.at(0));
    EXPECT_EQ(one.scenario.variation.battery_remaining, 0.0);
    EXPECT_THAT(one.scenario.written, ElementsAre("battery_remaining"));
  }
  EXPECT_THAT(
      names, ElementsAre("house-real-charge25", "house-real-charge80", "house-harsh-charge25", "house-harsh-charge80"));
  trial.natures = {"real"};
  trial.batteries = {0.25};
  EXPECT_EQ(trial.byCondition().at(0).name, "house");
  trial.batteries.clear();
  EXPECT_THAT(trial.byCondition().at(0).scenario.written, IsEmpty());
}

TEST(Conditions, AChargeIsThatOfEachVehicle) {
  simulation::Scenario scenario;
  scenario.vehicles.resize(2);
  scenario.vehicles[0].name = "alpha";
  scenario.setCharge(0.4);
  EXPECT_EQ(scenario.withVehicleAlone(0).battery_remaining, 0.4);
  EXPECT_EQ(scenario.withVehicleAlone(1).battery_remaining, 0.4);
}

}  // namespace
}  // namespace swiftlet::evaluation
