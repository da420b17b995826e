// Between two flights of a mission the motors rest, and a laser that returns nothing sees nothing.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "tests/autonomy/autonomy_story.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr const char* kTwoFlights = R"(<TakeOff/><Land/><WaitForOperator question="charged?"/><TakeOff/><Land/>)";

bool stands(const AutonomyStory& story) { return story.world().vehicle->flight_state == FlightState::kPoweredOff; }
bool waits(const AutonomyStory& story) { return story.world().vehicle->flight_state == FlightState::kLanded; }

TEST(OnTheGround, MotorsRestWhileTheMissionWaits) {
  AutonomyStory story(kTwoFlights);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return waits(story); }, 30.0));
  ASSERT_TRUE(story.until([&] { return stands(story); }, 2.0));
  ASSERT_TRUE(story.fly(3.0));
  EXPECT_TRUE(stands(story));
  EXPECT_TRUE(story.order(common::GoOnCommand{}).accepted);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return story.autonomy().finished(); }, 30.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone);
}

TEST(OnTheGround, AStoppedMissionLeavesTheVehicleStanding) {
  AutonomyStory story(kTwoFlights);
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.until([&] { return waits(story); }, 30.0));
  const common::CommandResult stop = story.order(common::StopMissionCommand{});
  EXPECT_TRUE(stop.accepted);
  EXPECT_EQ(stop.reason, "the vehicle stays on the ground until a mission is started");
  EXPECT_TRUE(story.until([&] { return stands(story); }, 2.0));
}

TEST(OnTheGround, ASensorThatNeverSendsIsNamedOnce) {
  const auto isScan = [](const common::SensorEvent& event) {
    return std::holds_alternative<std::shared_ptr<const common::LaserScan>>(event);
  };
  const auto isImu = [](const common::SensorEvent& event) { return std::holds_alternative<common::ImuSample>(event); };
  const auto toldWithout = [](auto isOfSensor) {
    AutonomyStory story("<TakeOff/>");
    story.hand = [isOfSensor](common::SensorEvent& event) { return !isOfSensor(event); };
    EXPECT_TRUE(story.fly(8.0));
    std::string told;
    for (const common::Event& event : story.events)
      if (event.text == "the vehicle is not ready to fly") told += event.reason + ";";
    return told;
  };
  EXPECT_EQ(toldWithout(isScan), "the laser has sent no scan;");
  EXPECT_EQ(toldWithout(isImu), "the IMU has sent no sample;");
  EXPECT_EQ(toldWithout([](const common::SensorEvent&) { return false; }), "");
}

/// A laser that has gone blind sends whole scans in which nothing returns.
TEST(Autonomy, BetweenWallsALaserThatReturnsNothingIsNoSight) {
  AutonomyStory story(R"(<TakeOff/><OperatorCommand/>)");
  ASSERT_TRUE(story.isFlying());
  ASSERT_TRUE(story.fly(3.0));
  const common::Time blind = story.now();
  story.hand = [](common::SensorEvent& event) {
    if (auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event)) {
      auto nothing = std::make_shared<common::LaserScan>(**scan);
      std::fill(nothing->ranges_m.begin(), nothing->ranges_m.end(), std::numeric_limits<float>::infinity());
      *scan = std::move(nothing);
    }
    return true;
  };
  ASSERT_TRUE(story.until([&] { return story.event("supervisor", "hold") != story.events.end(); }, 2.0));
  EXPECT_NEAR((story.event("supervisor", "hold")->stamp - blind).seconds(), kUnseenHold_s, 0.15);
}

}  // namespace
}  // namespace swiftlet::autonomy
