// Scenarios as YAML.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "simulation/scenario.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::HasProblem;
using test_support::problemsOf;
using testing::IsEmpty;

TEST(Scenario, PrintsAsYamlAndReadsBack) {
  Scenario scenario;
  scenario.seed = 5;
  scenario.world = "worlds/a.sdf";
  scenario.walkers.push_back({WalkerMode::kPath, {1, 2, 3, 4}, WalkerEnd::kReturn});
  scenario.faults.push_back({Sensor::kLaser, FaultKind::kNan, 1, 2, 0.5});
  scenario.pilot.push_back({1.0, 0.1, 0.2, 0.3, 0.4, true});
  scenario.pushes.push_back({1.0, 2.0, 3.0, 4.0});
  scenario.hands.push_back({1.0, 2.0, 3.0, 4.0, 5.0});
  const std::string text = common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(scenario);
  Scenario back;
  common::config::YamlReader::fromText(text, "scenario.yaml").read(back);
  EXPECT_EQ(common::config::YamlPrinter(common::config::YamlPrinter::Comments::kNo).print(back), text);
  EXPECT_EQ(back.walkers[0].at_end, WalkerEnd::kReturn);
  EXPECT_EQ(back.faults[0].kind, FaultKind::kNan);
}

Scenario scenarioFrom(const std::string& text) {
  Scenario scenario;
  common::config::YamlReader::fromText(text, "scenario.yaml").read(scenario);
  return scenario;
}

TEST(Scenario, ListsSeveralVehicles) {
  const Scenario scenario = scenarioFrom(
      "wind: {mean_x_m_s: 0.5}\n"
      "vehicles:\n"
      "  - {name: alpha}\n"
      "  - name: beta\n"
      "    start: {from_world: false, x_m: 2.0}\n"
      "    battery_remaining: 0.5\n"
      "    faults:\n"
      "      - {sensor: laser, kind: silent, from_s: 1, to_s: 2}\n"
      "walkers:\n"
      "  - {mode: follow, vehicle: beta}\n");
  EXPECT_EQ(scenario.vehicleCount(), 2U);
  EXPECT_EQ(scenario.vehicleNumber(""), 0U);
  EXPECT_EQ(scenario.vehicleNumber("beta"), 1U);
  const Scenario alpha = scenario.withVehicleAlone(0), beta = scenario.withVehicleAlone(1);
  EXPECT_TRUE(alpha.start.from_world);
  EXPECT_TRUE(alpha.faults.empty());
  EXPECT_EQ(beta.start.x_m, 2.0);
  EXPECT_EQ(beta.battery_remaining, 0.5);
  EXPECT_EQ(beta.faults.size(), 1U);
  EXPECT_EQ(beta.wind.mean_x_m_s, 0.5);
  EXPECT_EQ(beta.vehicleCount(), 1U);
}

std::vector<common::Problem> problemsIn(const std::string& text) {
  return problemsOf([&] { scenarioFrom(text); });
}

TEST(Scenario, AStartThatTheWorldWouldReplaceIsRefused) {
  for (const std::string field : {"x_m", "y_m", "z_m", "yaw_deg"}) {
    const std::string ignored = "scenario.start-ignored";
    EXPECT_THAT(problemsIn("vehicles: [{name: a, start: {" + field + ": 9}}]\n"),
                HasProblem(ignored, "vehicles[0].start." + field));
    EXPECT_THAT(problemsIn("start: {" + field + ": 9}\n"), HasProblem(ignored, "start." + field));
    EXPECT_THAT(problemsIn("start: {from_world: false, " + field + ": 9}\n"), IsEmpty());
    EXPECT_THAT(problemsIn("start: {" + field + ": 0}\n"), IsEmpty());
  }
}

TEST(Scenario, ReportsMistakesInItsVehicles) {
  EXPECT_THAT(problemsIn("vehicles: [{name: alpha}]\n"), IsEmpty());
  EXPECT_THAT(problemsIn("vehicles: [{name: alpha}, {name: alpha}]\n"), HasProblem("config.name-twice", "vehicles"));
  EXPECT_THAT(problemsIn("vehicles: [{start: {x_m: 1.0}}]\n"), HasProblem("scenario.no-name", "vehicles[0].name"));
  EXPECT_THAT(problemsIn("vehicles: [{name: a/b}]\n"), HasProblem("scenario.no-name", "vehicles[0].name"));
  EXPECT_THAT(problemsIn("start: {from_world: false}\nvehicles: [{name: alpha}]\n"),
              HasProblem("scenario.single-vehicle", "start"));
  EXPECT_THAT(problemsIn("battery_remaining: 0.5\nvehicles: [{name: alpha}]\n"),
              HasProblem("scenario.single-vehicle", "battery_remaining"));
  EXPECT_THAT(problemsIn("vehicles: [{name: alpha}]\nwalkers: [{mode: follow, vehicle: alpa}]\n"),
              HasProblem("scenario.no-vehicle", "walkers", "`alpha`"));
}

TEST(Scenario, TheShippedSensorsAndVehicleLoad) {
  for (const char* name : {"utm_30lx", "urg_04lx"}) {
    const auto laser = common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/" +
                                                                     std::string(name) + ".yaml");
    EXPECT_EQ(laser.name, name);
    EXPECT_GE(laser.mirror_beams, 10);
  }
  EXPECT_EQ(common::config::readFile<common::VehicleConfig>(SWIFTLET_SOURCE_DIR "/config/vehicles/cobra.yaml").name,
            "cobra");
}

}  // namespace
}  // namespace swiftlet::simulation
