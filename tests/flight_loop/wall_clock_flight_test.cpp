// A whole flight on the wall clock, as a program of one's own flies it: page, Groot2, run folder, and landing when
// asked.
#include "flight/wall_clock_flight.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "interfaces/links/groot/groot_server.hpp"
#include "tests/flight_loop/short_flight.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::flight {
namespace {

using interfaces::Outcome;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::string hover(const std::string& msec) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Hover\"><Sequence><TakeOff height_m=\"1.0\"/><Sleep msec=\"" +
         msec + "\"/><Land/></Sequence></BehaviorTree></root>";
}

class WallClockFlights : public test_support::Scratch {
 protected:
  WallClockSetup setupOf(const std::string& mission) const {
    WallClockSetup setup;
    setup.system = loadSystem("swiftlet");
    setup.mission_file = write("hover.xml", mission);
    setup.out = path("run");
    setup.speed = 4.0;
    return setup;
  }

  std::unique_ptr<simulation::SimulatedVehicle> vehicle_ = autonomy::makeVehicle(12);
  std::vector<std::string> story_;
  FlightHooks hooks_{
      .event = [this](const common::Event& event) { story_.push_back(event.source + ": " + event.text); }};
};

TEST_F(WallClockFlights, FliesTheMissionWithPageGrootAndRunFolder) {
  WallClockSetup setup = setupOf(hover("500"));
  setup.page.emplace().port = 0;
  if (interfaces::hasGrootServer()) setup.groot_port = 0;
  setup.control_log = true;
  WallClockFlight flight(*vehicle_, setup, hooks_);
  EXPECT_THAT(flight.pages(), ElementsAre(HasSubstr("?token=")));
  EXPECT_EQ(flight.grootPort().has_value(), interfaces::hasGrootServer());
  const VehicleResult result = flight.fly();
  EXPECT_TRUE(result.done()) << result.summary.reason;
  EXPECT_FALSE(result.write_failure) << *result.write_failure;
  EXPECT_FALSE(vehicle_->truth().airborne);
  EXPECT_THAT(story_, Contains("mission: Land is done"));
  EXPECT_THAT(test_support::readText(result.folder / "mission.json"), HasSubstr("\"outcome\": \"done\""));
  EXPECT_THAT(test_support::readText(result.folder / "events.jsonl"), HasSubstr("Land is done"));
  EXPECT_TRUE(std::filesystem::exists(result.folder / "report.html"));
  EXPECT_GT(test_support::readText(result.folder / "control.tsv").size(), 10'000u);
  EXPECT_FALSE(std::filesystem::exists(result.folder / "ground_truth.tum")) << "nobody told it the truth";
}

TEST_F(WallClockFlights, LandsWhenAskedAndStopsAtOnceWhenTold) {
  std::atomic<bool> land{false}, stop{false};
  hooks_.land = &land;
  hooks_.stop = &stop;
  hooks_.event = [&](const common::Event& event) {
    story_.push_back(event.source + ": " + event.text);
    if (story_.back() == "flight: flying") land = true;
  };
  const VehicleResult landed = WallClockFlight(*vehicle_, setupOf(hover("60000")), hooks_).fly();
  EXPECT_EQ(landed.summary.outcome, Outcome::kStopped) << landed.summary.reason;
  EXPECT_FALSE(vehicle_->truth().airborne);
  EXPECT_THAT(story_, Contains("program: asked to end: landing"));

  stop = true;
  EXPECT_EQ(WallClockFlight(*vehicle_, setupOf(hover("500")), hooks_).fly().summary.reason, "stopped from outside");
}

/// The vehicle's link is closed after two seconds.
class Lost final : public common::Vehicle {
 public:
  explicit Lost(common::Vehicle& vehicle) : vehicle_(vehicle) {}
  common::Time now() const override { return vehicle_.now(); }
  bool advanceTo(common::Time time, std::vector<common::SensorEvent>& events) override {
    return vehicle_.advanceTo(time, events) && !isClosed();
  }
  void apply(const common::Setpoint& setpoint) override { vehicle_.apply(setpoint); }
  std::string stopReason() const override { return isClosed() ? "the link is closed" : ""; }

 private:
  bool isClosed() const { return vehicle_.now().seconds() > 2.0; }
  common::Vehicle& vehicle_;
};

TEST_F(WallClockFlights, EndsWithTheReasonWhenTheVehicleSendsNothingMore) {
  Lost vehicle(*vehicle_);
  const VehicleResult result = WallClockFlight(vehicle, setupOf(hover("500")), hooks_).fly();
  EXPECT_EQ(result.summary.outcome, Outcome::kFailed);
  EXPECT_EQ(result.summary.reason, "the link is closed");
  EXPECT_THAT(story_, Contains("vehicle: the flight has ended"));
}

TEST_F(WallClockFlights, WarnsOnceWhereTheComputerIsTooSlow) {
  WallClockSetup setup = setupOf(hover("500"));
  setup.speed = 1000.0;
  EXPECT_TRUE(WallClockFlight(*vehicle_, setup, hooks_).fly().done());
  EXPECT_EQ(std::count(story_.begin(), story_.end(), "program: the computer is too slow for the flight"), 1);
}

TEST_F(WallClockFlights, AMissionThatIsNotSoundIsRefusedBeforeAnythingIsMade) {
  EXPECT_THROW(WallClockFlight(*vehicle_, setupOf("<root/>"), hooks_), common::InputError);
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

}  // namespace
}  // namespace swiftlet::flight
