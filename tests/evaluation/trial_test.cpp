// Trial files and the results of trials.
#include "evaluation/trial.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "evaluation/trial_results.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::evaluation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::HasProblem;
using test_support::problemsOf;
using testing::IsEmpty;

class Trials : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("swiftlet-trials-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "papers");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path put(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::vector<common::Problem> problemOf(const fs::path& path) {
    return problemsOf([&] { readTrials(path); });
  }
  fs::path folder_;
};

constexpr const char* kSmallest = "mission: missions/a.xml\nscenario: {world: worlds/w.sdf}\n";

TEST_F(Trials, AreReadFromAFile) {
  const auto trials =
      readTrials(put("house.yaml", std::string(kSmallest) + "repeat: 10\ncriteria: {coverage_min: 0.99}\n"
                                                            "paper: [{figure: mission_time_median_s, value: 320}]\n"));
  ASSERT_EQ(trials.size(), 1u);
  EXPECT_EQ(trials[0].name, "house") << "by the file's name";
  EXPECT_EQ(trials[0].repeat, 10);
  EXPECT_EQ(trials[0].criteria["coverage_min"], 0.99);
  EXPECT_EQ(trials[0].criteria.collisions_max, 0);
  EXPECT_EQ(trials[0].paper.at(0).value, 320);
  EXPECT_EQ(trials[0].system, "swiftlet");
}

TEST_F(Trials, AreReadFromAFolderInOrder) {
  put("b.yaml", kSmallest);
  put("a.yaml", kSmallest);
  put("papers/c.yml", kSmallest);
  put("notes.txt", "not a trial");
  const auto trials = readTrials(folder_);
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].name, "a");
  EXPECT_EQ(trials[2].name, "c");
}

TEST_F(Trials, OfTheSameNameAreRefused) {
  put("lab.yaml", kSmallest);
  put("papers/lab.yaml", kSmallest);
  EXPECT_THAT(problemOf(folder_), HasProblem("trial.name-twice", "name", "`lab`"));
}

TEST_F(Trials, NamesThatAreNotFolderNamesAreRefused) {
  put("a.yaml", std::string(kSmallest) + "name: \"a\\0b\"\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("trial.name-not-seen", "a.yaml:3:7: name"));
}

TEST_F(Trials, MistakesInAllFilesAreReportedTogether) {
  put("a.yaml", "mission: m.xml\nscenario: {wrold: w.sdf}\n");
  put("b.yaml", "scenario: {world: w.sdf}\ncriteria: {coverage_min: 99}\n");
  const auto problem = problemOf(folder_);
  EXPECT_THAT(problem, HasProblem("config.unknown-key", "a.yaml:2:12: scenario", "`world`"));
  EXPECT_THAT(problem, HasProblem("config.missing", "b.yaml:1:1: mission"));
  EXPECT_THAT(problem, HasProblem("config.not-within", "b.yaml:2:26: criteria.coverage_min", "99"));
}

TEST_F(Trials, EachOfSeveralVehiclesMayHaveItsOwnMission) {
  put("a.yaml", "mission: m.xml\nscenario: {world: w.sdf, vehicles: [{name: alpha}, {name: beta, mission: n.xml}]}\n");
  const TrialConfig trial = readTrials(folder_).at(0);
  ASSERT_EQ(trial.scenario.vehicles.size(), 2u);
  EXPECT_EQ(trial.scenario.vehicles[0].mission, "");
  EXPECT_EQ(trial.scenario.vehicles[1].mission, "n.xml");
}

TEST_F(Trials, WithSeveralNaturesAreOneTrialForEach) {
  put("house.yaml", std::string(kSmallest) + "natures: [calm, real, my/own.yaml]\n");
  const auto trials = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].name, "house-calm");
  EXPECT_EQ(trials[1].name, "house-real");
  EXPECT_EQ(trials[2].name, "house-own");
  EXPECT_THAT(trials[1].natures, testing::ElementsAre("real"));

  put("house.yaml", std::string(kSmallest) + "natures: [real]\n");
  const auto alone = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0].name, "house") << "of one nature alone the trial keeps its name";
  put("house.yaml", kSmallest);
  EXPECT_THAT(readTrials(folder_).at(0).natures, testing::ElementsAre("real"));
  put("house.yaml", std::string(kSmallest) + "natures: []\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("config.empty", "natures"));
}

TEST_F(Trials, WithSeveralSystemsAreOneTrialForEachInEachNature) {
  put("hover.yaml", std::string(kSmallest) + "systems: [mit, swiftlet]\nnatures: [mit, mit_delayed]\n");
  const auto trials = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_EQ(trials[0].name, "hover-mit-mit");
  EXPECT_EQ(trials[1].name, "hover-mit-mit_delayed");
  EXPECT_EQ(trials[3].name, "hover-swiftlet-mit_delayed");
  EXPECT_EQ(trials[2].system, "swiftlet");
  put("hover.yaml", std::string(kSmallest) + "systems: [dlr]\n");
  EXPECT_EQ(readTrials(folder_).at(0).byCondition().at(0).name, "hover");
  EXPECT_EQ(readTrials(folder_).at(0).byCondition().at(0).system, "dlr");
  put("hover.yaml", std::string(kSmallest) + "systems: [dlr, '']\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("config.empty-name", "systems"));
  put("hover.yaml", std::string(kSmallest) + "natures: ['']\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("config.empty-name", "natures"));
}

TEST_F(Trials, FaultsWithTheSameNameAreNumbered) {
  put("bad.yaml",
      "mission: m.xml\neach_fault: true\nscenario:\n  world: w.sdf\n  faults:\n"
      "    - {sensor: imu, kind: silent, place_world_m: [1, 1], lasts_s: 9}\n"
      "    - {sensor: imu, kind: silent, place_world_m: [2, 2], lasts_s: 9}\n");
  const auto trials = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].name, "bad-imu-silent-place");
  EXPECT_EQ(trials[1].name, "bad-imu-silent-place-2");
}

TEST_F(Trials, StepsOfVehiclesThatDoNotFlyAreRefused) {
  const std::string two = "mission: m.xml\nscenario: {world: w.sdf, vehicles: [{name: alpha}, {name: beta}]}\n";
  EXPECT_THAT(problemOf(put("two.yaml", two + "operator: [{command: hold, vehicle: beta}]\n")), IsEmpty());
  EXPECT_THAT(problemOf(put("two.yaml", two + "operator: [{command: hold, vehicle: betta}]\n")),
              HasProblem("scenario.no-vehicle", "operator", "`beta`"));
  EXPECT_THAT(problemOf(put("two.yaml", std::string(kSmallest) + "operator: [{command: hold, vehicle: alpha}]\n")),
              HasProblem("scenario.no-vehicle", "operator", "the one that flies has no name"));
}

TEST_F(Trials, FiguresThatThereAreNotAreRefused) {
  const auto problem = [&](const std::string& more) { return problemOf(put("t.yaml", kSmallest + more)); };
  EXPECT_THAT(problem("paper: [{figure: goal_eror_max_m, value: 1}]\n"),
              HasProblem("trial.no-figure", "t.yaml:3:18: paper[0].figure", "`goal_error_max_m`"));
  EXPECT_THAT(problem("phases: [{name: a, criteria: [{figure: position_sdt_m, max: 1}]}]\n"),
              HasProblem("phase.no-figure", "t.yaml:3:30: phases[0].criteria", "`position_std_m`"));
  EXPECT_THAT(problem("phases: [{name: a, criteria: [{figure: position_rms_m, max: 1}]}]\n"),
              HasProblem("phase.no-place", "phases[0].criteria", "`position_rms_m`"));
  EXPECT_THAT(problem("phases: [{name: a, criteria: [{figure: level_x_height_m, max: 1}]}]\n"),
              HasProblem("phase.no-figure", "phases[0].criteria", "`level_x_height_m`"));
  EXPECT_THAT(
      problem("phases: [{name: a, criteria: [{figure: level_12_height_m, max: 1}, {figure: levels, min: 1}]}]\n"),
      IsEmpty());
  EXPECT_THAT(problem("phases: [{name: a}, {name: a}]\n"), HasProblem("trial.phase-twice", "phases"));
}

TEST_F(Trials, WithEachFaultAreOneTrialForEach) {
  const std::string faults =
      "mission: m.xml\nscenario:\n  world: w.sdf\n  faults:\n"
      "    - {sensor: imu, kind: silent, phase: taking off, lasts_s: 9}\n"
      "    - {sensor: laser, kind: nan, from_s: 1.5, to_s: 9}\n";
  put("bad.yaml", faults + "each_fault: true\n");
  const auto trials = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].name, "bad-imu-silent-taking_off");
  EXPECT_EQ(trials[1].name, "bad-laser-nan-1.5s");
  for (const TrialConfig& trial : trials) EXPECT_EQ(trial.scenario.faults.size(), 1u);
  EXPECT_EQ(trials[1].scenario.faults[0].sensor, simulation::Sensor::kLaser);

  put("bad.yaml", faults);
  const auto together = readTrials(folder_).at(0).byCondition();
  ASSERT_EQ(together.size(), 1u);
  EXPECT_EQ(together[0].scenario.faults.size(), 2u);
  put("bad.yaml", std::string(kSmallest) + "each_fault: true\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("trial.no-faults", "each_fault"));
}

TEST_F(Trials, TheKeysOfTheScenarioThatAreWrittenOutAreKnown) {
  put("a.yaml", "mission: m.xml\nscenario: {world: w.sdf, quadrotor: {motor_lag_s: 0.05}, battery_remaining: 1.0}\n");
  EXPECT_THAT(readTrials(folder_).at(0).scenario.written,
              testing::UnorderedElementsAre("world", "quadrotor.motor_lag_s", "battery_remaining"));
}

TEST_F(Trials, VehiclesWithTheSameNameOrASlashInItAreRefused) {
  put("a.yaml", "mission: m.xml\nscenario: {world: w.sdf, vehicles: [{name: alpha}, {name: alpha}]}\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("config.name-twice", "a.yaml:2:36: scenario.vehicles", "`alpha`"));
  put("a.yaml", "mission: m.xml\nscenario: {world: w.sdf, vehicles: [{name: up/down}]}\n");
  EXPECT_THAT(problemOf(folder_), HasProblem("scenario.no-name", "a.yaml:2:44: scenario.vehicles[0].name"));
}

TEST(TrialOfTwo, PassesWhenBothVehiclesPass) {
  const auto score = [](int seed, const std::string& vehicle, bool passes) {
    FlightScore made;
    made.seed = seed;
    made.vehicle = vehicle;
    if (!passes) made.failures.push_back("coverage: 0.5, asked for at least 0.9");
    return made;
  };
  TrialResult trial{"two", "swiftlet", {}, {}};
  trial.flights = {score(7, "alpha", true), score(7, "beta", false), score(8, "alpha", true), score(8, "beta", true)};
  EXPECT_EQ(trial.flown(), 2);
  EXPECT_EQ(trial.passed(), 1);
  EXPECT_FALSE(trial.met());
  const json results = json::parse(toJson({{trial}})).at("trials").at(0);
  EXPECT_EQ(results.at("runs"), 2);
  ASSERT_EQ(results.at("flights").size(), 4u);
  EXPECT_EQ(results.at("flights")[1].at("vehicle"), "beta");
  EXPECT_EQ(flightTable(trial).rows[1][0].text, "7 beta");
  trial.flights[1].failures.clear();
  EXPECT_TRUE(trial.met());
}

TEST_F(Trials, MissingTrialsAreReported) {
  EXPECT_THAT(problemOf(folder_ / "papers"), HasProblem("trial.none", "papers"));
  EXPECT_THAT(problemOf(folder_ / "none.yaml"), HasProblem("file.not-opened", "none.yaml"));
}

TEST_F(Trials, PathsAreFoundInTheArchiveOrInTheSoftware) {
  put("papers/in_archive.world", "");
  TrialConfig trial;
  trial.scenario.world = "in_archive.world";
  trial.scenario.model_paths = {"models", "."};
  trial.resolvePaths(folder_ / "papers", "/software");
  EXPECT_EQ(trial.scenario.world, (folder_ / "papers/in_archive.world").string());
  EXPECT_EQ(trial.scenario.model_paths[0], "/software/models");
  trial.scenario.world = "trials/worlds/with_software.sdf";
  trial.resolvePaths(folder_ / "papers", "/software");
  EXPECT_EQ(trial.scenario.world, "/software/trials/worlds/with_software.sdf");
}

TEST_F(Trials, KnowWhereTheirFileGivesAValue) {
  put("t.yaml", "mission: m.xml\nsystems: [a, b]\nscenario:\n  world: w.sdf\n");
  TrialConfig trial = readTrial(folder_ / "t.yaml");
  EXPECT_EQ(trial.placeOf("mission").line, 1);
  EXPECT_EQ(trial.placeOf("scenario.world").line, 4);
  EXPECT_EQ(trial.placeOf("map.file").file, "");
  EXPECT_EQ(trial.byCondition().back().placeOf("systems").line, 2);
  trial.setSystem("c");
  EXPECT_EQ(trial.systems, std::vector<std::string>{"c"});
  EXPECT_EQ(trial.placeOf("systems").file, "") << "that is another one";
}

TEST_F(Trials, ArchivesAreFoundOrReportedMissing) {
  put("papers/w.tar.xz", "");
  ::unsetenv("SWIFTLET_DATASETS");
  EXPECT_EQ(dataSetsFolder("/software"), "/software/../shared/datasets");
  EXPECT_EQ(findArchive("papers/w.tar.xz", folder_), folder_ / "papers/w.tar.xz");
  EXPECT_THAT(problemsOf([&] { findArchive("none.tar.xz", folder_); }),
              HasProblem("trial.no-archive", "none.tar.xz: archive", "SWIFTLET_DATASETS"));
  ::setenv("SWIFTLET_DATASETS", (folder_ / "papers").c_str(), 1);
  EXPECT_EQ(findArchive("w.tar.xz", dataSetsFolder("/nowhere")), folder_ / "papers/w.tar.xz");
  ::unsetenv("SWIFTLET_DATASETS");
}

TEST(ShippedTrials, LoadWithoutProblems) {
  const auto trials = readTrials(fs::path(SWIFTLET_SOURCE_DIR) / "trials");
  EXPECT_GE(trials.size(), 7u);
  for (const TrialConfig& trial : trials) {
    EXPECT_FALSE(trial.description.empty()) << trial.name;
    EXPECT_TRUE(trial.criteria.mission_done || trial.criteria.verdicts ||
                std::isfinite(trial.criteria["memory_max_MB"]))
        << trial.name;
    EXPECT_EQ(trial.criteria.collisions_max, 0) << trial.name;
  }
}

TEST_F(Trials, AMapIsEitherAFileOrASurvey) {
  const std::string survey = "map: {survey: {path_world_m: [0, 0, 1, 0]}}\n";
  EXPECT_TRUE(readTrial(put("a.yaml", kSmallest + survey)).map.surveyed());
  EXPECT_FALSE(readTrial(put("b.yaml", kSmallest)).map.given());
  EXPECT_THAT(
      problemOf(put("c.yaml", std::string(kSmallest) + "map: {file: m.yaml, survey: {path_world_m: [0, 0, 1, 0]}}\n")),
      HasProblem("trial.two-maps", "c.yaml:3:13: map.file"));
}

}  // namespace
}  // namespace swiftlet::evaluation
