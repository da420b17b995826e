// SetFlightMode, WaitForOperator, SaveMap, Photograph and EmergencyLand, tick by tick; the test plays the autonomy.
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/registry.hpp"
#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

common::FlightMode flightModeOf(const Flight& flight) {
  return std::get<common::GoToIntent>(flight.context.intent->kind).mode;
}

TEST(SetFlightMode, HoldsForWhatFollowsUnlessThatNamesItsOwn) {
  Flight flight(R"(<Sequence><MoveToGoal goal="1;0"/><SetFlightMode mode="careful"/><MoveToGoal goal="2;0"/>)"
                R"(<MoveToGoal goal="3;0" mode="accurate"/><GoHome/><Explore/></Sequence>)");
  flight.tick();
  EXPECT_EQ(flightModeOf(flight), common::FlightMode::kFast);
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 2 go to (2.00, 0.00)") << "in the same tick";
  EXPECT_EQ(flightModeOf(flight), common::FlightMode::kCareful);
  flight.succeeds().tick();
  EXPECT_EQ(flightModeOf(flight), common::FlightMode::kAccurate);
  flight.succeeds().tick();
  EXPECT_EQ(flightModeOf(flight), common::FlightMode::kCareful);
  flight.succeeds().tick();
  EXPECT_EQ(std::get<common::ExploreIntent>(flight.context.intent->kind).mode, common::FlightMode::kCareful);
}

TEST(FollowPath, FliesEachLegInItsMode) {
  Flight flight(R"(<FollowPath points="1;0 | 2;0 | 3;0" modes="careful | accurate"/>)");
  for (const auto mode : {common::FlightMode::kCareful, common::FlightMode::kAccurate, common::FlightMode::kAccurate}) {
    flight.tick();
    EXPECT_EQ(flightModeOf(flight), mode);
    flight.succeeds();
  }
  EXPECT_THAT(problemsInside(R"(<TakeOff/><FollowPath points="1;0" modes="careful | slow"/>)"),
              ElementsAre(At("3:46 FollowPath.modes", "mission.unknown-mode", "`slow`")));
}

TEST(WaitForOperator, GoesOnWhenTheOperatorSaysSo) {
  Flight flight(R"(<Sequence><WaitForOperator question="Door open?"/><Land/></Sequence>)");
  EXPECT_EQ(flight.mission.question(), "");
  flight.command({0, common::GoOnCommand{}});
  flight.tick();
  EXPECT_THAT(flight.results(), ElementsAre("1 refused: the mission does not wait for the operator"));
  EXPECT_EQ(flight.mission.question(), "Door open?");
  EXPECT_EQ(flight.tick(), "RUNNING");
  EXPECT_THAT(flight.command({0, common::GoOnCommand{}}).tick(), HasSubstr("land"));
  EXPECT_THAT(flight.results(), ElementsAre("2 accepted"));
  EXPECT_EQ(flight.mission.question(), "");
}

TEST(WaitForOperator, FailsAfterItsTimeoutWithoutThatOfASuspension) {
  Flight flight(R"(<Priority><Hold/><WaitForOperator timeout_s="0.5"/></Priority>)");
  flight.tick();
  flight.tick();
  flight.holds(true).tick();
  for (int i = 0; i < 20; ++i) flight.stops().tick();
  flight.holds(false);
  EXPECT_EQ(flight.tick(), "RUNNING");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(flight.tick(), "RUNNING") << i;
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_THAT(flight.last.reason, HasSubstr("the operator did not answer for 0 s"));
}

TEST(SaveMap, AsksForAFileOfThatName) {
  Flight flight(R"(<SaveMap file="hall_2"/>)");
  flight.tick();
  ASSERT_EQ(flight.context.requests.size(), 1u);
  EXPECT_EQ(std::get<common::SaveMapRequest>(flight.context.requests[0].kind).name, "hall_2");
  flight.context.answers = {{flight.context.requests[0].id, true, ""}};
  EXPECT_EQ(flight.tick(), "DONE");
  EXPECT_THAT(problemsInside(R"(<TakeOff/><SaveMap file="../x"/>)"),
              ElementsAre(At("3:30 SaveMap.file", "mission.file-name", "`../x`")));
}

TEST(SaveMap, TakesItsAnswerThoughItComesWhileSuspended) {
  Flight flight(R"(<Priority><Hold/><Sequence><SaveMap file="hall"/><Land/></Sequence></Priority>)");
  flight.tick();
  ASSERT_EQ(flight.context.requests.size(), 1u);
  flight.context.answers = {{flight.context.requests[0].id, true, ""}};
  flight.holds(true).tick();
  flight.context.answers.clear();  // The autonomy gives each answer once.
  EXPECT_TRUE(flight.holds(false).stops().tick().ends_with("land")) << flight.view();
}

TEST(Photograph, StopsThenAsksAndWaits) {
  Flight flight(R"(<Photograph file="door"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 hold");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 hold") << "it still moves";
  EXPECT_TRUE(flight.context.requests.empty());
  flight.stops().tick();
  ASSERT_EQ(flight.context.requests.size(), 1u);
  const std::uint64_t id = flight.context.requests[0].id;
  flight.context.requests.clear();
  flight.stops().tick();
  EXPECT_TRUE(flight.context.requests.empty()) << "once";
  flight.context.answers = {{id, false, "no usable frame of the camera for 2 s"}};
  EXPECT_EQ(flight.stops().tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "Photograph: no usable frame of the camera for 2 s");
}

TEST(Photograph, TheCheckRefusesItWithoutACamera) {
  EXPECT_TRUE(problemsInside("<TakeOff/><Photograph/><Land/>").empty());
  MissionLimits limits;
  limits.has_camera = false;
  EXPECT_THAT(problemsInside("<TakeOff/><Photograph/><Land/>", limits),
              ElementsAre(At("3:21 Photograph", "mission.no-camera")));
  EXPECT_THAT(problemsInside("<TakeOff/><Inspect point='1;0'/><Land/>", limits),
              ElementsAre(At("3:21 Inspect", "mission.no-camera")));
}

TEST(EmergencyLand, EndsOnTheFloor) {
  Flight flight("<EmergencyLand/>");
  EXPECT_EQ(flight.tick(), "RUNNING 1 emergency landing");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 emergency landing");
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
  EXPECT_THAT(problemsInside("<TakeOff/><EmergencyLand/><Explore/>"),
              ElementsAre(At("3:37 Explore", "mission.on-the-floor")));
}

TEST(Constants, AreTheChoicesOfPortsInCapitals) {
  const tree::Registry registry = missionRegistry();
  for (const auto& [id, type] : registry.types())
    for (const tree::PortManifest& port : type.manifest.ports)
      for (const std::string& choice : port.choices) {
        std::string name = choice;
        for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        const auto known = registry.constants().find(name);
        ASSERT_NE(known, registry.constants().end()) << name;
        const auto value = tree::readValue(port, std::to_string(known->second)).value;
        EXPECT_EQ(value, tree::Value(choice)) << id << "." << port.name << ": one name, two numbers";
      }
  Flight flight(
      "<Sequence><TakeOff/><Script code=\"m := 1 &lt; 2 ? CAREFUL : FAST\"/><MoveToGoal goal=\"1;1\" mode=\"{m}\"/>"
      "</Sequence>");
  flight.tick();
  flight.succeeds().tick();
  ASSERT_EQ(flight.last.state, common::MissionState::kRunning) << flight.last.reason;
  EXPECT_EQ(flightModeOf(flight), common::FlightMode::kCareful);
  Flight wrong(
      "<Sequence><TakeOff/><Script code=\"m := 'care' .. 'less'\"/><MoveToGoal goal=\"1;1\" mode=\"{m}\"/></Sequence>");
  wrong.tick();
  EXPECT_EQ(wrong.succeeds().tick(), "FAILED") << "a text that is no choice is not flown as one";
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
