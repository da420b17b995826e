// Survey, Inspect, FollowMe and ReturnToMe, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "behaviors/mission_check.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::HasSubstr;

template <typename Intent>
const Intent& intentOf(const Flight& flight) {
  return std::get<Intent>(flight.context.intent->kind);
}

TEST(Survey, PassesItsPortsOn) {
  Flight flight(R"(<Survey polygon="0;0 | 2;0 | 2;1" spacing_m="0.8" height_m="1.2" mode="careful"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 survey an area with 3 corners about (1.33, 0.33)");
  const auto& intent = intentOf<common::SurveyIntent>(flight);
  EXPECT_EQ(intent.area, (common::Polygon{{{0, 0}, {2, 0}, {2, 1}}}));
  EXPECT_EQ(intent.spacing_m, 0.8);
  EXPECT_EQ(intent.height_m, 1.2);
  EXPECT_EQ(intent.mode, common::FlightMode::kCareful);
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(Survey, IsInterruptedAndGoesOn) {
  Flight flight(R"(<Priority><Hold/><Survey polygon="0;0 | 2;0 | 2;1"/></Priority>)");
  flight.tick();
  flight.runs().holds(true).tick();
  EXPECT_THAT(flight.stops().tick(), HasSubstr("hold"));
  EXPECT_THAT(flight.stops().holds(false).tick(), HasSubstr("survey an area"));
}

TEST(Survey, RefusesWhatIsNoAreaOrTooHigh) {
  Flight crossed(R"(<Survey polygon="0;0 | 2;2 | 2;0 | 0;2"/>)");
  EXPECT_EQ(crossed.tick(), "FAILED");
  EXPECT_EQ(crossed.cause(), "Survey: edges of the polygon cross");
  Flight high(R"(<Survey polygon="0;0 | 2;0 | 2;1" height_m="5"/>)");
  high.context.goal_limits.greatest_height_m = 2.0;
  EXPECT_EQ(high.tick(), "FAILED");
  EXPECT_THAT(high.last.reason, HasSubstr("5 m is above the greatest height"));
}

TEST(Inspect, PassesItsPortsOnAndFailsWithTheReason) {
  Flight flight(R"(<Inspect point="1;2;0.4" radius_m="1.2" turns="2"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 inspect (1.00, 2.00)");
  const auto& intent = intentOf<common::InspectIntent>(flight);
  EXPECT_EQ(intent.point_height_m, 0.4);
  EXPECT_EQ(intent.radius_m, 1.2);
  EXPECT_EQ(intent.turns, 2.0);
  EXPECT_FALSE(intent.height_m);
  EXPECT_EQ(flight.fails("none of its places is free").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "Inspect: none of its places is free");
}

TEST(FollowMe, RunsUntilThePersonIsLost) {
  Flight flight(R"(<FollowMe distance_m="1.8" lost_s="9"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 follow a person");
  EXPECT_EQ(intentOf<common::FollowIntent>(flight).distance_m, 1.8);
  EXPECT_EQ(intentOf<common::FollowIntent>(flight).lost_s, 9.0);
  EXPECT_FALSE(intentOf<common::FollowIntent>(flight).until_near);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 follow a person");
  EXPECT_EQ(flight.fails("the person was not seen for 9 s").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "FollowMe: the person was not seen for 9 s");
}

TEST(FollowMe, ATimeoutLetsGoOnceTheVehicleHasStopped) {
  Flight flight(R"(<ForceSuccess><Timeout msec="150"><FollowMe/></Timeout></ForceSuccess>)");
  flight.tick();
  flight.runs().tick();
  EXPECT_THAT(flight.runs().tick(), HasSubstr("hold"));
  EXPECT_EQ(flight.stops().tick(), "DONE");
}

TEST(ReturnToMe, EndsNearThePerson) {
  Flight flight("<ReturnToMe/>");
  EXPECT_EQ(flight.tick(), "RUNNING 1 return to the person");
  EXPECT_TRUE(intentOf<common::FollowIntent>(flight).until_near);
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(ReturnToMe, FliesToThePlaceFromWhichItIsCalled) {
  Flight flight(R"(<ReturnToMe place="2.5;-1" distance_m="1.6" mode="careful"/>)");
  flight.at(-3.0, -1.0);
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (0.90, -1.00)") << "on the side of the vehicle";
  EXPECT_NEAR(*intentOf<common::GoToIntent>(flight).yaw_map_rad, 0.0, 1e-9) << "it looks at the person";
  EXPECT_EQ(intentOf<common::GoToIntent>(flight).mode, common::FlightMode::kCareful);
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
  Flight beyond(R"(<ReturnToMe place="9;9"/>)");
  EXPECT_EQ(beyond.tick(), "FAILED");
  EXPECT_EQ(beyond.cause(), "ReturnToMe: no place near (9.00, 9.00) is free");
}

/// The operator calls while the vehicle explores: "go on" ends the exploration.
TEST(ReturnToMe, ACallEndsTheExplorationOnceTheVehicleHasStopped) {
  Flight flight(R"(<Sequence><Parallel success_count="1" failure_count="2"><Explore/>)"
                R"(<WaitForOperator question="Come to me?"/></Parallel><ReturnToMe/></Sequence>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore");
  flight.runs().command({0, common::GoOnCommand{}}).tick();
  EXPECT_EQ(flight.results().back(), "1 accepted");
  EXPECT_THAT(flight.runs().tick(), HasSubstr("hold"));
  EXPECT_THAT(flight.stops().tick(), HasSubstr("return to the person"));
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
