// Bad values and missing scans of the laser in flight: the vehicle continues, or lands safely and says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/flight/run_files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;

class SensorFault : public test_support::Scratch {
 protected:
  /// Flies the shipped mission with these lines in its scenario; the only flight of the results.
  nlohmann::json flyIn(const std::string& scenario, const std::string& nature = "real") {
    std::ofstream(path("fault.yaml")) << "name: fault\n"
                                         "natures: ["
                                      << nature
                                      << "]\n"
                                         "mission: missions/explore_and_return.xml\n"
                                         "time_limit_s: 200\n"
                                         "criteria:\n"  // Those of trials/papers/unb_case1.yaml for one flight.
                                         "  goal_error_max_m: 0.16\n"
                                         "  home_error_max_m: 0.16\n"
                                         "  estimate_rms_max_m: 0.05\n"
                                         "scenario:\n"
                                         "  world: worlds/unb_case1.sdf\n"
                                      << scenario;
    const ProgramEnd end = runSwiftlet({"trial", path("fault.yaml"), "--repeat", "1", "--out", path("out"), "--json"});
    EXPECT_LE(end.exit_code, 1) << describe(end);
    return nlohmann::json::parse(readText(path("out/results.json"))).at("trials").at(0).at("flights").at(0);
  }
  nlohmann::json flyWith(const std::string& fault) { return flyIn("  faults:\n    - " + fault + "\n"); }
  std::string events() const { return readText(path("out/fault-001/events.jsonl")); }
};

TEST_F(SensorFault, NanInScansDoesNotStopTheFlight) {
  const auto flight = flyWith("{sensor: laser, kind: nan, from_s: 10.0, to_s: 10.2}");
  EXPECT_TRUE(flight.at("passed").get<bool>()) << flight.dump(2);

  // The scorer's figures are in the flight's own files too.
  const auto mission = nlohmann::json::parse(readText(path("out/fault-001/mission.json")));
  EXPECT_EQ(mission.at("coverage"), flight.at("coverage"));
  for (const std::string figure :
       {"goal_error_m", "home_error_m", "estimate_rms_m", "map_wall_error_median_m", "collisions"})
    EXPECT_EQ(mission.at("figures").at(figure), flight.at(figure)) << figure;
  const std::string report = readText(path("out/fault-001/report.html"));
  for (const std::string words : {"Coverage", "goal error", "home error", "estimate rms", "map wall error median"})
    EXPECT_THAT(report, HasSubstr(words));
}

TEST_F(SensorFault, NanFromTheBatteryDoesNotStopTheFlight) {
  const auto flight = flyWith("{sensor: battery, kind: nan, from_s: 5.0, to_s: 20.0}");
  EXPECT_TRUE(flight.at("passed").get<bool>()) << flight.dump(2);
  EXPECT_THAT(events(), HasSubstr("battery samples rejected, the last good values are kept"));
  EXPECT_THAT(events(), HasSubstr("battery samples accepted again"));
}

TEST_F(SensorFault, ThePilotTakesOverAndReturnsControl) {
  const auto flight = flyIn(
      "  pilot:\n"
      "    - {time_s: 0.0}\n"
      "    - {time_s: 12.0, thrust: 0.55, takes_over: true}\n"
      "    - {time_s: 13.0}\n",
      "calm");  // The stick hovers a vehicle that weighs and pulls as its data sheet says.
  EXPECT_TRUE(flight.at("passed").get<bool>()) << flight.dump(2);
  EXPECT_THAT(events(), HasSubstr("the pilot took over"));
  EXPECT_THAT(events(), HasSubstr("the pilot gave control back"));
}

TEST_F(SensorFault, ShortSilenceHoldsAndThenContinues) {
  const auto flight = flyWith("{sensor: laser, kind: silent, from_s: 12.0, to_s: 12.6}");
  EXPECT_TRUE(flight.at("passed").get<bool>()) << flight.dump(2);
  EXPECT_THAT(events(), HasSubstr("no scan for 0.3"));
  EXPECT_THAT(events(), HasSubstr("scans are back"));
}

TEST_F(SensorFault, LongSilenceHoldsThenLandsAndIsReported) {
  const auto flight = flyWith("{sensor: laser, kind: silent, from_s: 12.0, to_s: 1000}");
  EXPECT_FALSE(flight.at("mission_done").get<bool>());
  EXPECT_EQ(flight.at("collisions"), 0) << flight.dump(2);
  EXPECT_LE(flight.at("estimate_rms_m").get<double>(), 0.25) << "it comes down without a scan, but not far off";
  EXPECT_THAT(events(), HasSubstr("no scan for 0.3"));
  EXPECT_THAT(events(), HasSubstr("\"land\""));
  const auto mission = nlohmann::json::parse(readText(path("out/fault-001/mission.json")));
  EXPECT_EQ(mission.at("outcome"), "failed");
  EXPECT_THAT(mission.at("reason").get<std::string>(), HasSubstr("landed: no scan for 3.3 s"));
}

/// More thrust than the vehicle believes carries it off the floor, and its motors stop before it lies there again.
TEST_F(SensorFault, AVehicleWhoseMotorsStopAboveTheGroundIsWatchedUntilItLies) {
  const auto flight = flyIn(
      "  quadrotor: {thrust_share: 1.05, mass_share: 0.92}\n"
      "  faults:\n    - {sensor: imu, kind: silent, from_s: 1.6, to_s: 1000}\n",
      "nominal");
  EXPECT_FALSE(flight.at("mission_done").get<bool>());
  EXPECT_NE(flight.at("verdict"), "unfinished") << flight.dump(2);
  EXPECT_GT(flight.at("touch_down_speed_m_s").get<double>(), 0.0) << "it has left the floor";
}

}  // namespace
}  // namespace swiftlet::flight
