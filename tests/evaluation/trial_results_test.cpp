// The results of trials: verdicts over all flights, JSON and tables.
#include "evaluation/trial_results.hpp"
#include "evaluation/criteria.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "evaluation/trial.hpp"

namespace swiftlet::evaluation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

FlightScore flight(std::int64_t seed, double goal_error_m, double time_s) {
  FlightScore score;
  score.seed = seed;
  score.folder = "unb-" + std::to_string(seed);
  score.outcome = "done";
  score.mission_done = true;
  score["coverage"] = 0.99 + 0.001 * static_cast<double>(seed);
  score["goal_error_m"] = goal_error_m;
  score["home_error_m"] = 2 * goal_error_m;
  score["estimate_rms_m"] = 0.03;
  score["mission_time_s"] = time_s;
  score["realtime_factor"] = 20;
  return score;
}

TrialResults results() {
  TrialResult trial{"unb", "swiftlet", {{"goal_error_max_m", 0.16}}, {}};
  trial.flights = {flight(1, 0.02, 80), flight(2, 0.05, 90), flight(3, 0.04, 70), flight(4, 0.03, 60)};
  FlightScore crashed;
  crashed.seed = 5;
  crashed.collisions = 1;
  crashed.outcome = "touched `box`";
  crashed["mission_time_s"] = 4;
  crashed.failures = {"collision: touched `box`"};
  trial.flights.push_back(crashed);
  return {{trial}};
}

TEST(TrialResultsJson, NamesTheProgramThatFlewThem) {
  TrialResults flown = results();
  flown.version = {"0.2.0", "5e2b3b0f1c4d", true};
  const json parsed = json::parse(toJson(flown));
  EXPECT_EQ(parsed["version"], "0.2.0");
  EXPECT_EQ(parsed["commit"], "5e2b3b0f1c4d");
  EXPECT_EQ(parsed["dirty"], true);
}

TEST(TrialResultsJson, ContainsTheFiguresOfAllFlights) {
  const json parsed = json::parse(toJson(results()));
  ASSERT_EQ(parsed["trials"].size(), 1u);
  const json& trial = parsed["trials"][0];
  EXPECT_EQ(trial["name"], "unb");
  EXPECT_EQ(trial["runs"], 5);
  EXPECT_EQ(trial["passed"], 4);
  EXPECT_EQ(trial["collisions"], 1);
  EXPECT_NEAR(trial["coverage_min"].get<double>(), 0.991, 1e-12);
  EXPECT_NEAR(trial["goal_error_max_m"].get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(trial["goal_error_median_m"].get<double>(), 0.035, 1e-12);
  EXPECT_NEAR(trial["home_error_max_m"].get<double>(), 0.10, 1e-12);
  EXPECT_NEAR(trial["mission_time_median_s"].get<double>(), 75, 1e-12) << "a crash is no fast mission";
  EXPECT_NEAR(trial["estimate_rms_median_m"].get<double>(), 0.03, 1e-12);
  EXPECT_NEAR(trial["realtime_factor_median"].get<double>(), 20, 1e-12);
  ASSERT_EQ(trial["flights"].size(), 5u);
  EXPECT_TRUE(trial["flights"][4]["goal_error_m"].is_null());
  EXPECT_EQ(trial["flights"][4]["failures"][0], "collision: touched `box`");
}

TEST(TrialResultsJson, TellsWhatTheComputerNeeded) {
  TrialResults all = results();
  all.trials[0].flights[0].machine = {400.0, 20.0, 22.0};
  all.trials[0].flights[1].machine = {700.0, std::nullopt, std::nullopt};
  const json trial = json::parse(toJson(all))["trials"][0];
  EXPECT_EQ(trial["memory_peak_MB"], 700.0);
  EXPECT_EQ(trial["frame_growth_max"], 1.1) << "of the only flight that has it";
  EXPECT_EQ(trial["flights"][0]["machine"]["frame_first_ms"], 20.0);
  EXPECT_TRUE(trial["flights"][1]["machine"]["frame_first_ms"].is_null());
  EXPECT_FALSE(trial["flights"][2].contains("machine"));
}

TEST(TrialResultsJson, RoundsFiguresAndWritesNullForUnexplored) {
  TrialResults all = results();
  FlightScore& first = all.trials[0].flights[0];
  first["goal_error_m"] = 0.1 + 0.2;
  first["speed_max_m_s"] = 2.0 / 3.0;
  first["explored_area_m2"] = 89.230000000000004;
  const std::string text = toJson(all);
  for (const char* part : {"\"goal_error_m\": 0.3,", "\"speed_max_m_s\": 0.6667,", "\"explored_area_m2\": 89.23,",
                           "\"explored_area_m2\": null,"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST(TrialResultsJson, ContainsEachVisitOfAMarker) {
  TrialResults all = results();
  FlightScore& first = all.trials[0].flights[0];
  first.visits = {{common::Time::fromSeconds(61.5), {3.0, -1.5}, {0.004, -0.003}, {}},
                  {common::Time::fromSeconds(90.0), {0.0, 0.0}, {0.0, 0.001}, Eigen::Vector2d(0.2, -0.1)}};
  const json visits = json::parse(toJson(all))["trials"][0]["flights"][0]["visits"];
  ASSERT_EQ(visits.size(), 2u);
  EXPECT_EQ(visits[0]["time_s"], 61.5);
  EXPECT_EQ(visits[0]["marker_map_m"], json({3.0, -1.5}));
  EXPECT_EQ(visits[0]["estimate_error_m"], json({0.004, -0.003}));
  EXPECT_TRUE(visits[0]["open_loop_error_m"].is_null());
  EXPECT_EQ(visits[1]["open_loop_error_m"], json({0.2, -0.1}));
}

TEST(TrialResults, ShowMarkersWhenACriterionNeedsThem) {
  TrialResults all = results();
  EXPECT_THAT(toText(summaryTable(all)), testing::Not(HasSubstr("marker")));
  all.trials[0].criteria["marker_error_max_m"] = 0.01;
  all.trials[0].flights[0]["marker_error_m"] = 0.008;
  all.trials[0].flights[1]["marker_error_m"] = 0.012;
  EXPECT_THAT(toText(summaryTable(all)), testing::ContainsRegex("marker err max \\(m\\)"));
  EXPECT_THAT(toText(summaryTable(all)), HasSubstr("0.012"));
  EXPECT_EQ(json::parse(toJson(all))["trials"][0]["marker_error_median_m"], 0.01);
}

TEST(TrialResults, CountFlightsLocalizedInTimeAndCorrectly) {
  TrialResults all = results();
  EXPECT_THAT(toText(summaryTable(all)), testing::Not(HasSubstr("localized")));
  TrialResult& trial = all.trials[0];
  trial.criteria["localized_flights_min"] = 0.96;
  for (std::size_t i = 0; i < 4; ++i) {
    FlightScore& score = trial.flights[i];
    score["localization_path_length_m"] = 2.0 + static_cast<double>(i);
    score["localized_in_time"] = i < 3 ? 1.0 : 0.0;
    score["wrong_time_share"] = 0.0;
  }
  trial.flights[4]["localized_in_time"] = 0.0;
  trial.flights[4]["wrong_time_share"] = 0.25;
  EXPECT_THAT(toText(summaryTable(all)), HasSubstr("60.0 %"));
  EXPECT_THAT(trial.missed(), testing::ElementsAre("flights localized: 0.6000, at least 0.96 was asked for"));
  const json written = json::parse(toJson(all))["trials"][0];
  EXPECT_EQ(written["localized_flights"], 0.6);
  EXPECT_EQ(written["localization_path_length_median_m"], 3.5);
  EXPECT_EQ(written["wrong_time_share_max"], 0.25);
  EXPECT_EQ(written["flights"][0]["localization"]["in_time"], true);
  EXPECT_TRUE(written["flights"][4]["localization"]["path_length_m"].is_null());
}

TEST(TrialResultsJson, NamesTheSeedsThatAFigureIsWithout) {
  TrialResults all = results();
  all.trials[0].flights[1]["goal_error_m"].reset();
  all.trials[0].flights[1].seed = 77;
  const json trial = json::parse(toJson(all))["trials"][0];
  EXPECT_THAT(trial["seeds_without"]["goal_error_max_m"].get<std::vector<int>>(), testing::Contains(77));
  EXPECT_FALSE(trial["seeds_without"].contains("done_share")) << "each flight has it";
}

TEST(TrialResultsJson, HasNullFiguresWithoutFlights) {
  const json trial = json::parse(toJson(TrialResults{{{"empty", "swiftlet", {}, {}}}}))["trials"][0];
  EXPECT_EQ(trial["runs"], 0);
  EXPECT_TRUE(trial["coverage_min"].is_null());
  EXPECT_TRUE(trial["flights"].is_array());
}

TEST(TrialResults, PassWhenEveryFlightPasses) {
  TrialResults all = results();
  EXPECT_FALSE(all.passed());
  all.trials[0].flights.pop_back();
  EXPECT_TRUE(all.passed());
  EXPECT_FALSE(TrialResults{}.passed()) << "no flight proves nothing";
}

/// The four flights that passed: goal errors 0.02 to 0.05, home errors twice that, 60 to 90 s.
TrialResults fourWith(const Criteria& criteria) {
  TrialResults all = results();
  all.trials[0].flights.pop_back();
  all.trials[0].criteria = criteria;
  return all;
}

TEST(CriteriaOverAllFlights, AreEnforced) {
  Criteria criteria;
  criteria["goal_error_median_max_m"] = 0.035;
  criteria["mission_time_median_max_s"] = 75;
  EXPECT_TRUE(fourWith(criteria).passed()) << "bounds are inclusive";
  criteria["home_error_median_max_m"] = 0.06;
  criteria["mission_time_median_max_s"] = 70;
  const TrialResults all = fourWith(criteria);
  EXPECT_FALSE(all.passed());
  EXPECT_EQ(all.trials[0].passed(), 4) << "each flight alone is well";
  EXPECT_THAT(all.trials[0].missed(), testing::ElementsAre("home error median, m: 0.070, at most 0.06 was asked for",
                                                           "mission time median, s: 75.000, at most 70 was asked for"));
}

TEST(CriteriaOverAllFlights, FailForFiguresThatWereNotMeasured) {
  Criteria criteria;
  criteria["map_wall_error_median_max_m"] = 0.05;
  EXPECT_EQ(fourWith(criteria).trials[0].missed().size(), 1u);
}

TEST(CriteriaOverAllFlights, AreInTheTablesAndTheJson) {
  Criteria criteria;
  criteria["coverage_min"] = 0.98;
  criteria["mission_time_median_max_s"] = 70;
  const TrialResults all = fourWith(criteria);
  const common::Table summary = summaryTable(all);
  ASSERT_EQ(summary.rows.size(), 3u);
  EXPECT_THAT(toText(summary), testing::ContainsRegex("asked for +98.0 % +70.0"));
  const auto time =
      std::find(summary.columns.begin(), summary.columns.end(), "time median (s)") - summary.columns.begin();
  EXPECT_EQ(summary.rows[0][static_cast<std::size_t>(time)].mark, common::Mark::kBad);
  EXPECT_EQ(summary.rows[0][3].mark, common::Mark::kGood);
  const common::Table failures = failureTable(all);
  ASSERT_EQ(failures.rows.size(), 1u);
  EXPECT_EQ(failures.rows[0][1].text, "all");
  const json trial = json::parse(toJson(all))["trials"][0];
  EXPECT_EQ(trial["met"], false);
  EXPECT_EQ(trial["failures"][0], "mission time median, s: 75.000, at most 70 was asked for");
}

TEST(CriteriaOverAllFlights, AreReadFromTheShippedTrial) {
  TrialConfig trial = readTrial(fs::path(SWIFTLET_SOURCE_DIR) / "trials/papers/unb_case1.yaml");
  const Criteria& criteria = trial.criteria;
  EXPECT_EQ(criteria["mission_time_max_s"], 320);
  trial.system = "swiftlet";
  ASSERT_EQ(trial.figureBounds().size(), 1u);
  EXPECT_EQ(trial.figureBounds()[0].max, 70) << "asked of ours";
  EXPECT_EQ(criteria["goal_error_median_max_m"], 0.05);
  EXPECT_EQ(criteria["home_error_median_max_m"], 0.08);
  EXPECT_EQ(criteria["estimate_rms_median_max_m"], 0.05);
}

TEST(TrialResults, ArePrintedAsTables) {
  const std::string summary = toText(summaryTable(results()));
  EXPECT_THAT(summary, HasSubstr("unb"));
  EXPECT_THAT(summary, HasSubstr("4/5"));
  EXPECT_THAT(summary, HasSubstr("99.1 %"));
  EXPECT_THAT(summary, testing::ContainsRegex("the paper .*0.160")) << "the paper's figure stands below ours";
  const common::Table flights = flightTable(results().trials[0]);
  EXPECT_EQ(flights.rows.size(), 5u);
  EXPECT_EQ(flights.rows[0][0].link, "unb-1/report.html");
  EXPECT_EQ(failureTable(results()).rows.size(), 1u);
}

}  // namespace
}  // namespace swiftlet::evaluation
