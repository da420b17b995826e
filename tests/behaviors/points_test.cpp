// FollowPath, Patrol, TurnTo, LogEvent and MoveToGoal's ports, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const common::GoToIntent& goTo(const Flight& flight) {
  return std::get<common::GoToIntent>(flight.context.intent->kind);
}

TEST(FollowPath, PassesPointsAndEndsAtTheLast) {
  Flight flight(R"(<FollowPath points="1;0 | 2;0;1.4 | 2;2" corner_m="0.3" mode="careful"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (1.00, 0.00)");
  EXPECT_EQ(goTo(flight).mode, common::FlightMode::kCareful);
  EXPECT_EQ(flight.runs().at(0.6, 0.0).tick(), "RUNNING 1 go to (1.00, 0.00)");
  EXPECT_EQ(flight.at(0.8, 0.0).tick(), "RUNNING 2 go to (2.00, 0.00)") << "passed without a stop";
  EXPECT_EQ(goTo(flight).height_m, 1.4);
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 3 go to (2.00, 2.00)");
  EXPECT_EQ(flight.runs().at(2.0, 1.9).tick(), "RUNNING 3 go to (2.00, 2.00)") << "the last point is not just passed";
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(FollowPath, APlaceBesideAPointWillDoAtOnceWhereItIsOnlyPassed) {
  Flight flight(R"(<FollowPath points="1;0 | 2;0" corner_m="0.3" shift_m="0.2"/>)");
  flight.tick();
  EXPECT_EQ(goTo(flight).shift_m, 0.3);
  EXPECT_EQ(goTo(flight).shift_after_s, 0.0);
  flight.succeeds().tick();
  EXPECT_EQ(goTo(flight).shift_m, 0.2);
  EXPECT_GT(goTo(flight).shift_after_s, 1.0) << "somebody may stand there";
}

TEST(FollowPath, APointThatIsOnlyPassedIsShiftedAsFarAsTheLastOne) {
  Flight flight(R"(<FollowPath points="1;0 | 2;0" corner_m="0.3" shift_m="1"/>)");
  flight.tick();
  EXPECT_EQ(goTo(flight).shift_m, 1.0);
}

TEST(FollowPath, FliesTheLegAgainThatWasInterrupted) {
  Flight flight(R"(<Priority><Hold/><FollowPath points="1;0 | 2;0"/></Priority>)");
  flight.tick();
  flight.succeeds().tick();
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 go to (2.00, 0.00)");
  flight.holds(true).tick();
  EXPECT_THAT(flight.stops().tick(), HasSubstr("hold"));
  EXPECT_THAT(flight.stops().holds(false).tick(), HasSubstr("go to (2.00, 0.00)"));
}

TEST(FollowPath, SaysWhichPointFailed) {
  Flight flight(R"(<FollowPath points="1;0 | 2;0"/>)");
  flight.tick();
  flight.succeeds().tick();
  EXPECT_EQ(flight.fails("no path").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "FollowPath: point 2: no path");
}

TEST(Patrol, VisitsPausesAndCountsItsRounds) {
  Flight flight(R"(<Patrol points="1;0 | 2;0" rounds="2" pause_s="0.2"/>)");
  std::string now = flight.tick();
  for (const char* leg : {"go to (1.00, 0.00)", "go to (2.00, 0.00)", "go to (1.00, 0.00)", "go to (2.00, 0.00)"}) {
    EXPECT_THAT(now, HasSubstr(leg));
    EXPECT_THAT(flight.succeeds().tick(), HasSubstr("hold")) << "the pause";
    flight.stops().tick();
    now = flight.stops().tick();
    if (now != "DONE") now = flight.tick();
  }
  EXPECT_EQ(now, "DONE");
}

TEST(Patrol, NeverEndsWithoutRounds) {
  Flight flight(R"(<Patrol points="1;0" pause_s="0"/>)");
  flight.tick();
  for (int visit = 0; visit < 20; ++visit) {
    EXPECT_THAT(flight.succeeds().tick(), HasSubstr("hold"));
    EXPECT_THAT(flight.stops().tick(), HasSubstr("go to (1.00, 0.00)"));
  }
}

TEST(Patrol, LeavesOutAPointThatCannotBeReached) {
  Flight flight(R"(<Patrol points="1;0 | 2;0" pause_s="0"/>)");
  flight.tick();
  EXPECT_THAT(flight.fails("no path").tick(), HasSubstr("hold"));
  EXPECT_THAT(flight.events(), ::testing::Contains("Patrol skips a point (point 1: no path)"));
  EXPECT_THAT(flight.stops().tick(), HasSubstr("go to (2.00, 0.00)"));
  flight.succeeds().tick();
  EXPECT_THAT(flight.stops().tick(), HasSubstr("go to (1.00, 0.00)"));
  flight.fails("no path").tick();
  flight.stops().tick();
  EXPECT_EQ(flight.fails("no path").tick(), "FAILED") << "none of all points in turn";
  EXPECT_EQ(flight.cause(), "Patrol: point 2: no path");
}

TEST(TurnTo, StaysWhereItIs) {
  Flight flight(R"(<TurnTo yaw_deg="90"/>)");
  EXPECT_EQ(flight.at(1.5, -0.5).tick(), "RUNNING 1 go to (1.50, -0.50)");
  EXPECT_NEAR(goTo(flight).yaw_map_rad.value(), M_PI / 2, 1e-12);
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(MoveToGoal, PassesOnHeightYawAndMode) {
  Flight flight(R"(<MoveToGoal goal="1;2" height_m="1.3" yaw_deg="-90" mode="accurate"/>)");
  flight.tick();
  EXPECT_EQ(goTo(flight).height_m, 1.3);
  EXPECT_NEAR(goTo(flight).yaw_map_rad.value(), -M_PI / 2, 1e-12);
  EXPECT_EQ(goTo(flight).mode, common::FlightMode::kAccurate);
}

TEST(LogEvent, WritesItsText) {
  Flight flight(R"(<LogEvent text="halfway" severity="warning"/>)");
  EXPECT_EQ(flight.tick(), "DONE");
  EXPECT_EQ(flight.context.events.front().severity, common::Severity::kWarning);
  EXPECT_THAT(flight.events(), ::testing::Contains("halfway"));
}

TEST(Check, LooksIntoEveryChildOfEveryNode) {
  for (const std::string node :
       {"Sequence", "AsyncSequence", "SequenceWithMemory", "IfThenElse", "WhileDoElse", "TryCatch", "ParallelAll"})
    EXPECT_THAT(
        problemsInside("<" + node + "><AlwaysSuccess/>\n<MoveToGoal goal=\"1;0\"/></" + node + "><TakeOff/><Land/>"),
        ElementsAre(At("4:1 MoveToGoal", "mission.on-the-floor")))
        << node;
}

TEST(Check, ChoicesAndPointsAreCheckedBeforeTheFlight) {
  const auto problems = [](const std::string& leaf) { return problemsInside("<TakeOff/>\n" + leaf + "<Land/>"); };
  EXPECT_THAT(problems(R"(<FollowPath points="1;0 | 2;0"/>)"), ElementsAre());
  EXPECT_THAT(problems(R"(<FollowPath points="1;0 | 2"/>)"),
              ElementsAre(At("4:13 FollowPath.points", "tree.value-type", "`1;0 | 2`")));
  EXPECT_THAT(problems(R"(<MoveToGoal goal="1;0" mode="fsat"/>)"),
              ElementsAre(At("4:24 MoveToGoal.mode", "tree.value-type", "`fast`?")));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
