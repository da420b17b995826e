// A vehicle whose sensors cannot carry the flight stays on the ground, and the user is told why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/commands/missions.hpp"
#include "tests/commands/refusals.hpp"
#include "tests/support/program.hpp"

namespace swiftlet::commands {
namespace {

using test_support::describe;
using test_support::ProgramEnd;
using test_support::readText;
using test_support::runSwiftlet;
using testing::HasSubstr;
using testing::Not;

class FlightSensors : public RefusalsBeforeWriting {
 protected:
  /// A profile with the laser of a vacuum cleaner, with a mirror unless `mirror_beams` is 0.
  std::string systemWith(int mirror_beams) const {
    write("lds.yaml",
          "name: lds\nbeams: 360\nfield_of_view_deg: 360\nrate_hz: 5\nsweep_s: 0.2\nrange_min_m: 0.12\n"
          "range_max_m: 3.5\nmirror_first_beam: 352\nmirror_beams: " +
              std::to_string(mirror_beams) +
              "\nmount: {z_m: 0.08}\nmirror_mount: {x_m: -0.05, y_m: 0.03, z_m: 0.06}\n");
    return write("mine.yaml", "based_on: swiftlet\nlaser: lds.yaml\n");
  }
  std::string hop() const { return write("hop.xml", missionWith(kHop)); }
  ProgramEnd fly(const std::string& world, const std::string& system) const {
    return runSwiftlet({"fly", hop(), "--headless", "--world", write("w.sdf", worldWith(world)), "--system", system,
                        "--time-limit", "60", "--json", "--out", path("run")});
  }
};

TEST_F(FlightSensors, AProfileWhoseHeightNothingMeasuresIsRefusedByEveryCommandThatFlies) {
  const std::string says = "mine\\.yaml:2:8: laser: nothing measures the height: no beam of lds looks down";
  const std::string system = systemWith(0);
  expectRefused(runSwiftlet({"check", hop(), "--system", system}), says);
  expectRefused(fly(room(), system), says);
  const std::string trial = write("t.yaml", "mission: " + hop() + "\nsystem: " + system +
                                                "\nscenario: {world: " + write("w.sdf", worldWith(room())) + "}\n");
  expectRefused(runSwiftlet({"trial", trial, "--out", path("run")}), says);
  EXPECT_EQ(runSwiftlet({"config", "--system", system}).exit_code, 0) << "for logs it may do";
}

TEST_F(FlightSensors, ATakeOffHigherThanTheBeamsDownReachIsRefused) {
  const std::string high = write("high.xml", missionWith("      <TakeOff height_m=\"3\" max_height_m=\"5\"/>\n"
                                                         "      <Land/>\n"));
  expectRefused(runSwiftlet({"check", high, "--system", systemWith(8)}),
                "high\\.xml:4:[0-9]+: TakeOff\\.max_height_m: 5 m is above 3\\.44 m, up to which the beams down");
}

TEST_F(FlightSensors, AFlightLowerThanTheBeamsDownMeasureIsRefused) {
  const std::string low = write("low.xml", missionWith("      <TakeOff height_m=\"0.8\"/>\n      <Land/>\n"));
  const std::string shipped = readText(SWIFTLET_SOURCE_DIR "/config/sensors/utm_30lx.yaml");
  std::string far = shipped;
  far.replace(far.find("range_min_m: 0.1"), 16, "range_min_m: 1.2");
  (void)write("far.yaml", far);
  const std::string system = write("far_sighted.yaml", "based_on: swiftlet\nlaser: far.yaml\n");
  expectRefused(runSwiftlet({"check", low, "--system", system}),
                "low\\.xml:4:[0-9]+: TakeOff\\.height_m: 0\\.8 m is below 1\\.24 m, from which on the beams down");
}

TEST_F(FlightSensors, WhereTheLaserReachesNothingTheTakeOffIsRefused) {
  const std::string hall = floorBox() + box("north", "0 8 1.5 0 0 0", "16 0.1 3") +
                           box("south", "0 -8 1.5 0 0 0", "16 0.1 3") + box("east", "8 0 1.5 0 0 0", "0.1 16 3") +
                           box("west", "-8 0 1.5 0 0 0", "0.1 16 3");
  const ProgramEnd end = fly(hall, systemWith(8));
  EXPECT_EQ(end.exit_code, 1) << describe(end);
  const auto outcome = nlohmann::json::parse(end.out);
  EXPECT_EQ(outcome.at("outcome"), "failed");
  EXPECT_THAT(std::string(outcome.at("reason")), HasSubstr("take-off refused: no beams of the laser"));
  const std::string events = readText(path("run/events.jsonl"));
  EXPECT_THAT(events, HasSubstr("take-off delayed"));
  EXPECT_THAT(events, Not(HasSubstr("taking off"))) << "its motors stay off";
  EXPECT_LT(double(outcome.at("distance_m")), 0.1);
}

TEST_F(FlightSensors, InARoomWithinItsReachTheSameLaserFlies) {
  const ProgramEnd end = fly(room(), systemWith(8));
  EXPECT_EQ(end.exit_code, 0) << describe(end);
}

}  // namespace
}  // namespace swiftlet::commands
