// The program flies two vehicles side by side: a run folder and a score for each.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/flight/run_files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

const std::string kTwo = "trials/two_vehicles.yaml", kExplore = "trials/missions/explore_and_come_home.xml";

class SeveralVehicles : public test_support::Scratch {
 protected:
  /// Flies the two vehicles of the shipped trial for some seconds.
  ProgramEnd fly(const std::string& out, const std::string& limit_s) const {
    return runSwiftlet({"fly", kExplore, "--scenario", kTwo, "--headless", "--seed", "7", "--time-limit", limit_s,
                        "--json", "--out", path(out)});
  }
  /// A scenario of two vehicles that start at these places, where the hall has floor.
  std::string twoFrom(const std::string& alpha, const std::string& beta, const std::string& mission = kHop) const {
    return write("two.yaml", "mission: " + write("hop.xml", mission) +
                                 "\ntime_limit_s: 60\nscenario:\n  world: worlds/unb_case1.sdf\n  vehicles:\n" +
                                 "    - " + alpha + "\n    - " + beta + "\n");
  }
  static constexpr const char* kHop =
      R"(<root BTCPP_format="4"><BehaviorTree ID="Hop"><Sequence><TakeOff height_m="0.6"/><Land/></Sequence></BehaviorTree></root>)";
};

TEST_F(SeveralVehicles, WriteARunEachAndRepeatIt) {
  const ProgramEnd end = fly("run", "12");
  EXPECT_EQ(end.exit_code, 1) << describe(end);  // The time is over before the world is explored.
  const json outcome = json::parse(end.out);
  ASSERT_EQ(outcome.at("vehicles").size(), 2u);
  EXPECT_EQ(outcome.at("vehicles")[1].at("vehicle"), "beta");
  EXPECT_EQ(outcome.at("run"), path("run"));
  (void)fly("again", "12");
  for (const std::string name : {"alpha", "beta"}) {
    SCOPED_TRACE(name);
    const fs::path run = fs::path(path("run")) / name, again = fs::path(path("again")) / name;
    expectSoundRun(run);
    EXPECT_EQ(json::parse(readText(run / "mission.json")).at("vehicle"), name);
    EXPECT_THAT(readText(run / "report.html"), HasSubstr("explore_and_come_home, " + name));
    EXPECT_THAT(readText(run / "events.jsonl"), HasSubstr("\"vehicle\":\"" + name + "\""));
    EXPECT_GT(readTum(run / "trajectory.tum").back().position_m[2], 0.8) << "it flies";
    EXPECT_EQ(json::parse(readText(run / "mission.json")).at("nature"), "real") << "without --nature";
    for (const char* file : {"trajectory.tum", "map.pgm", "events.jsonl", "nature.yaml"})
      EXPECT_EQ(readText(run / file), readText(again / file)) << file;
  }
  EXPECT_NE(readText(path("run/alpha/nature.yaml")), readText(path("run/beta/nature.yaml"))) << "each draws for itself";
  EXPECT_FALSE(fs::exists(fs::path(path("run")) / "mission.json"));
}

TEST_F(SeveralVehicles, AreScoredSeparately) {
  const std::string trial = twoFrom("{name: low, start: {from_world: false, x_m: 2, y_m: 6.5}}",
                                    "{name: lower, start: {from_world: false, x_m: 2, y_m: 4.5}}");
  const ProgramEnd end = runSwiftlet({"trial", trial, "--json", "--out", path("out")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  const json result = json::parse(end.out).at("trials").at(0);
  EXPECT_EQ(result.at("runs"), 1);
  EXPECT_EQ(result.at("passed"), 1);
  ASSERT_EQ(result.at("flights").size(), 2u);
  EXPECT_EQ(result.at("flights")[0].at("folder"), "two-001/low");
  EXPECT_EQ(result.at("flights")[1].at("folder"), "two-001/lower");
  EXPECT_TRUE(fs::exists(fs::path(path("out")) / "two-001" / "lower" / "report.html"));
}

TEST_F(SeveralVehicles, FlyTheirOwnMissionsAndContinueAfterOneEnds) {
  const std::string longer = write(
      "longer.xml",
      R"(<root BTCPP_format="4"><BehaviorTree ID="There"><Sequence><TakeOff height_m="0.8"/><MoveToGoal goal="0.8;0" tolerance_m="0.1"/><Land/></Sequence></BehaviorTree></root>)");
  const std::string trial =
      twoFrom("{name: short, start: {from_world: false, x_m: 2, y_m: 6.5}}",
              "{name: long, mission: " + longer + ", start: {from_world: false, x_m: 2, y_m: 4.5}}");
  const ProgramEnd end =
      runSwiftlet({"fly", path("hop.xml"), "--scenario", trial, "--headless", "--json", "--out", path("run")});
  EXPECT_EQ(end.exit_code, 0) << describe(end);
  const json vehicles = json::parse(end.out).at("vehicles");
  EXPECT_GT(vehicles[1].at("mission_time_s").get<double>(), vehicles[0].at("mission_time_s").get<double>() + 1.0);
  EXPECT_GT(vehicles[1].at("distance_m"), 0.6);
  EXPECT_EQ(json::parse(readText(fs::path(path("run")) / "long" / "mission.json")).at("mission"), "longer");
}

TEST_F(SeveralVehicles, UnusableInputIsRefusedBeforeAnythingIsWritten) {
  const auto refusal = [&](const std::string& alpha, const std::string& beta) {
    const ProgramEnd end =
        runSwiftlet({"fly", kExplore, "--scenario", twoFrom(alpha, beta), "--headless", "--out", path("run")});
    EXPECT_EQ(end.exit_code, 2) << describe(end);
    EXPECT_FALSE(fs::exists(path("run")));
    return end.err;
  };
  const std::string here = "start: {from_world: false, x_m: 2, y_m: 6.5}";
  EXPECT_THAT(refusal("{name: a, " + here + "}", "{name: a}"), HasSubstr("two are called `a`"));
  EXPECT_THAT(refusal("{name: a/b, " + here + "}", "{name: c}"), HasSubstr("letters, digits"));
  EXPECT_THAT(refusal("{name: a, " + here + "}", "{name: b, start: {from_world: false, x_m: 2.3, y_m: 6.5}}"),
              HasSubstr("touches the vehicle `a`"));
  EXPECT_THAT(refusal("{name: a, mission: none.xml, " + here + "}", "{name: b}"), HasSubstr("none.xml"));
}

TEST_F(SeveralVehicles, FlyInTheNatureOfTheirScenarioUnlessAnotherIsNamed) {
  const std::string trial = twoFrom("{name: low, start: {from_world: false, x_m: 2, y_m: 6.5}}",
                                    "{name: lower, start: {from_world: false, x_m: 2, y_m: 4.5}}");
  write("two.yaml", readText(trial) + "natures: [calm, harsh]\n");
  const auto flown = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"fly",          kExplore, "--scenario", trial,      "--headless",
                                          "--time-limit", "1",      "--out",      path("run")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    (void)runSwiftlet(arguments);
    return json::parse(readText(path("run/low/mission.json"))).at("nature").get<std::string>();
  };
  EXPECT_EQ(flown({}), "calm");
  EXPECT_EQ(flown({"--nature", "real"}), "real");
}

TEST_F(SeveralVehicles, RunsOfOneAndOfSeveralAreNotMixed) {
  (void)runSwiftlet({"fly", kExplore, "--headless", "--time-limit", "1", "--out", path("run")});
  ASSERT_TRUE(fs::exists(fs::path(path("run")) / "mission.json"));
  const ProgramEnd end = fly("run", "1");
  EXPECT_EQ(end.exit_code, 2) << describe(end);
  EXPECT_THAT(end.err, HasSubstr("holds the run of one vehicle"));
}

}  // namespace
}  // namespace swiftlet::flight
