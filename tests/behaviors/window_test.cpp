// FindWindow, FlyThroughWindow, FindPositionIndoor, LeaveByDoor, and the task that is made of them, tick by tick; the
// test plays the autonomy. The wall is at x = 4 m.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/behaviors/objects_flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// In the wall, seen from inside: its normal is along -x.
common::RecognizedObject openingAt(int id, const std::string& what, double y_m, common::Passage passage) {
  common::RecognizedObject object;
  object.id = id;
  object.what = what;
  object.T_map_object = {common::quaternionFrom({0.0, 0.0, std::numbers::pi}), {4.0, y_m, 1.15}};
  object.covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
  object.size_m = {1.0, 1.2};
  object.passage = passage;
  object.confirmed = passage != common::Passage::kNone;
  object.looks = 4;
  return object;
}

/// A flight in a world with recognized objects.
class HouseFlight : public ObjectsFlight {
 public:
  explicit HouseFlight(const std::string& inside) : ObjectsFlight(inside) { flight.at(2.0, 0.0); }
  explicit HouseFlight(Mission mission) : ObjectsFlight(std::move(mission)) { flight.at(0.0, 0.0); }
  std::vector<common::Pose2> flyViews(int most_ticks = 400) {
    std::vector<common::Pose2> views;
    for (const common::GoToIntent& view : ObjectsFlight::flyViews(most_ticks))
      views.push_back({view.goal_map_m.x(), view.goal_map_m.y(), view.yaw_map_rad.value_or(0.0)});
    return views;
  }
};

constexpr auto kIsOpen = common::Passage::kOpen;
constexpr auto kIsClosed = common::Passage::kClosed;
constexpr auto kIsUnknown = common::Passage::kNone;

TEST(FindWindow, NeedsARecognizer) {
  Flight flight(R"(<FindWindow near="4;0"/>)");
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_THAT(flight.cause(), HasSubstr("the profile has no recognizer of openings"));
}

TEST(FindWindow, EndsWithTheOneThatIsOpenNearTheStoredPlace) {
  HouseFlight house(R"(<Sequence><FindWindow near="4;0.4" window="{w}"/><FlyThroughWindow window="{w}"/></Sequence>)");
  house.sees({openingAt(1, "window", 3.5, kIsOpen), openingAt(2, "mirror", 0.3, kIsUnknown),
              openingAt(3, "window", 0.0, kIsOpen), openingAt(4, "door", 0.5, kIsOpen)});
  EXPECT_EQ(house.tick(), "RUNNING 1 hold");
  EXPECT_EQ(house.tick(), "RUNNING 1 hold") << "it still moves";
  house.flight.stops();
  EXPECT_EQ(house.tick(), "RUNNING 2 fly through window 3");
  EXPECT_THAT(house.flight.events(), Contains(StartsWith("window 3 found (open, 1.00 m wide, at (4.00, 0.00)")));
  const auto& intent = std::get<common::FlyThroughIntent>(house.flight.context.intent->kind);
  EXPECT_NEAR(intent.heading_rad, 0.0, 1e-9);
  house.flight.succeeds();
  EXPECT_EQ(house.tick(), "DONE");
}

TEST(FindWindow, LooksTowardsTheStoredPlaceToBothSidesAndFromBeside) {
  HouseFlight house(R"(<FindWindow near="4;0"/>)");
  house.sees({openingAt(2, "mirror", 0.3, kIsUnknown)});
  const auto views = house.flyViews();
  EXPECT_EQ(house.flight.cause(), "FindWindow: no open window was detected from here: 1 mirror");
  ASSERT_EQ(views.size(), 8U);
  EXPECT_NEAR(views[0].yaw_rad, 0.0, 1e-9);
  EXPECT_NEAR(views[1].yaw_rad, -views[2].yaw_rad, 1e-9);
  EXPECT_GT(views[1].yaw_rad, 0.4);
  for (std::size_t i = 3; i < views.size(); ++i) {
    const Eigen::Vector2d off = views[i].position_m() - Eigen::Vector2d(2.0, 0.0);
    EXPECT_GT(off.norm(), 0.3) << "a look from another place";
    const Eigen::Vector2d to = Eigen::Vector2d(4.0, 0.0) - views[i].position_m();
    EXPECT_NEAR(views[i].yaw_rad, std::atan2(to.y(), to.x()), 1e-9);
  }
}

TEST(FindWindow, LooksAtACandidateFromOtherPlacesUntilItIsConfirmed) {
  HouseFlight house(R"(<FindWindow near="4;0"/>)");
  house.sees({openingAt(5, "window", 0.6, kIsUnknown)});
  house.tick();
  house.flight.succeeds();
  for (int i = 0; i < 30 && (house.goTo() == nullptr || house.goTo()->goal_map_m.y() == 0.0); ++i) {
    house.tick();
    house.goTo() != nullptr ? house.flight.succeeds() : house.flight.stops();
  }
  ASSERT_NE(house.goTo(), nullptr);
  EXPECT_GT((house.goTo()->goal_map_m - Eigen::Vector2d(2.0, 0.0)).norm(), 0.3) << "no turn on the spot";
  const Eigen::Vector2d to = Eigen::Vector2d(4.0, 0.6) - house.goTo()->goal_map_m;
  EXPECT_NEAR(*house.goTo()->yaw_map_rad, std::atan2(to.y(), to.x()), 1e-9);
  house.sees({openingAt(5, "window", 0.6, kIsOpen)}).tick();
  house.flight.stops();
  EXPECT_EQ(house.tick(), "DONE");
}

TEST(FindWindow, AClosedOneIsNoWindowToLookForAndANarrowOneIsNone) {
  HouseFlight house(R"(<FindWindow near="4;0"/>)");
  house.sees({openingAt(2, "window", 0.2, kIsClosed)});
  EXPECT_EQ(house.tick(), "FAILED");
  EXPECT_EQ(house.flight.cause(), "FindWindow: window 2 is closed");
  HouseFlight narrow(R"(<FindWindow near="4;0"/>)");
  auto slit = openingAt(3, "window", 0.0, kIsOpen);
  slit.size_m.x() = 0.6;
  narrow.sees({slit});
  narrow.flyViews();
  EXPECT_EQ(narrow.flight.cause(), "FindWindow: no open window was detected from here: 1 too narrow");
}

TEST(FindWindow, LooksAllAroundWithoutAStoredPlace) {
  HouseFlight house("<FindWindow/>");
  house.sees({});
  const auto views = house.flyViews(600);
  ASSERT_GE(views.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR((views[i].position_m() - Eigen::Vector2d(2.0, 0.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(std::cos(views[i].yaw_rad - 0.25 * std::numbers::pi * static_cast<double>(i)), 1.0, 1e-9);
  }
}

TEST(FlyThroughWindow, SaysWhyItTurnedBackAndNeedsAKnownOne) {
  HouseFlight house(R"(<FlyThroughWindow window="3"/>)");
  house.sees({openingAt(3, "window", 0.0, kIsOpen)});
  EXPECT_EQ(house.tick(), "RUNNING 1 fly through window 3");
  house.flight.fails("it is no longer seen");
  EXPECT_EQ(house.tick(), "FAILED");
  EXPECT_EQ(house.flight.cause(), "FlyThroughWindow: it is no longer seen");
  HouseFlight unknown(R"(<FlyThroughWindow window="4"/>)");
  unknown.sees({openingAt(3, "window", 0.0, kIsOpen)});
  EXPECT_EQ(unknown.tick(), "FAILED");
  EXPECT_EQ(unknown.flight.cause(), "FlyThroughWindow: no object 4 is known");
}

/// What interrupts it behind the middle of the window must not turn it round.
TEST(FlyThroughWindow, KeepsItsDirectionWhenItIsInterrupted) {
  HouseFlight house(R"(<Priority><AvoidObstacle/><FlyThroughWindow window="3"/></Priority>)");
  house.sees({openingAt(3, "window", 0.0, kIsOpen)});
  house.tick();
  const auto heading_rad = [&] {
    const auto* intent = std::get_if<common::FlyThroughIntent>(&house.flight.context.intent->kind);
    return intent == nullptr ? 9.0 : intent->heading_rad;
  };
  EXPECT_NEAR(heading_rad(), 0.0, 1e-9);
  house.flight.at(4.3, 0.0).retreats(true, "a person").runs();
  for (int i = 0; i < 5; ++i) house.tick();
  house.flight.retreats(false).stops();
  for (int i = 0; i < 20 && heading_rad() == 9.0; ++i) {
    house.tick();
    house.flight.stops();
  }
  EXPECT_NEAR(heading_rad(), 0.0, 1e-9);
}

TEST(FindPositionIndoor, IsOnThisSideInSightAndFarFromThePlacesBefore) {
  HouseFlight house(R"(<KeepRunningUntilFailure><FindPositionIndoor near="4;0"/></KeepRunningUntilFailure>)");
  const auto places = house.flyViews();
  EXPECT_EQ(house.flight.cause(), "FindPositionIndoor: no other place is known from which it can be seen");
  ASSERT_GE(places.size(), 3U);
  std::vector<Eigen::Vector2d> before = {{2.0, 0.0}};
  for (const common::Pose2& place : places) {
    const Eigen::Vector2d to = Eigen::Vector2d(4.0, 0.0) - place.position_m();
    EXPECT_GT(to.x(), 0.4) << "inside";
    EXPECT_LT(to.norm(), 3.5);
    EXPECT_NEAR(std::cos(place.yaw_rad - std::atan2(to.y(), to.x())), 1.0, 1e-9);
    for (const Eigen::Vector2d& other : before) EXPECT_GT((place.position_m() - other).norm(), 0.6);
    before.push_back(place.position_m());
  }
  EXPECT_GT((places[0].position_m() - before[0]).norm(), 1.5) << "the farthest first";
}

TEST(FindPositionIndoor, TriesAnotherPlaceWhereOneIsNotReached) {
  HouseFlight house(R"(<FindPositionIndoor near="4;0"/>)");
  house.tick();
  const Eigen::Vector2d first = house.goTo()->goal_map_m;
  house.flight.fails("no path");
  house.tick();
  house.tick();
  ASSERT_NE(house.goTo(), nullptr);
  EXPECT_GT((house.goTo()->goal_map_m - first).norm(), 0.6);
}

TEST(LeaveByDoor, GoesByTheStoredPlaceWithoutARecognizedOne) {
  HouseFlight house(R"(<LeaveByDoor door="4;1" outside="4.6;1"/>)");
  house.sees({openingAt(1, "door", 1.0, kIsClosed), openingAt(2, "door", -3.0, kIsOpen)});
  EXPECT_EQ(house.tick(), "RUNNING 1 go to (4.00, 1.00)");
  EXPECT_THAT(house.flight.events(), Contains(StartsWith("leaves by the door (no open door is recognized")));
  house.flight.succeeds();
  house.tick();
  EXPECT_EQ(house.tick(), "RUNNING 2 go to (4.60, 1.00)");
  house.flight.succeeds();
  EXPECT_EQ(house.tick(), "DONE");
}

TEST(LeaveByDoor, GoesThroughTheOneThatIsRecognizedOnTheWay) {
  HouseFlight house(R"(<LeaveByDoor door="4;1.5" outside="4.6;1"/>)");
  EXPECT_EQ(house.tick(), "RUNNING 1 go to (4.00, 1.50)");
  house.sees({openingAt(7, "door", 1.0, kIsOpen)});
  EXPECT_EQ(house.tick(), "RUNNING 2 go to (5.00, 1.00)");
  EXPECT_THAT(house.flight.events().back(), HasSubstr("door 7 is open"));
  house.flight.succeeds();
  house.tick();
  EXPECT_EQ(house.tick(), "RUNNING 3 go to (4.60, 1.00)");
  house.flight.fails("no path");
  EXPECT_EQ(house.tick(), "FAILED");
  EXPECT_EQ(house.flight.cause(), "LeaveByDoor: no path");
}

TEST(LeaveByDoor, StillTriesThePlaceOutsideWhenTheDoorIsNotReached) {
  HouseFlight house(R"(<LeaveByDoor door="4;1" outside="4.6;1"/>)");
  house.tick();
  house.flight.fails("a chair is in the way");
  house.tick();
  EXPECT_EQ(house.tick(), "RUNNING 2 go to (4.60, 1.00)");
  house.flight.fails("no path");
  EXPECT_EQ(house.tick(), "FAILED");
  EXPECT_EQ(house.flight.cause(), "LeaveByDoor: no path; the door was not reached: a chair is in the way");
}

// ---------------------------------------------------------------------------------------------------- the whole task

/// With the places of the room of this test.
Mission leaveHouse() {
  const std::string task = std::string(SWIFTLET_SOURCE_DIR) + "/missions/tasks/leave_house_by_window.xml";
  return Mission::fromText(
      R"(<root BTCPP_format="4" main_tree_to_execute="M"><include path=")" + task +
          R"("/><BehaviorTree ID="M"><SubTree ID="LeaveHouseByWindow" window="4;0" before="2;0" door="4;2" outside="4.6;2"/>)" +
          "</BehaviorTree></root>",
      "mission.xml");
}

TEST(LeaveHouseByWindow, FliesThroughTheWindowThatItFinds) {
  HouseFlight house(leaveHouse());
  EXPECT_EQ(house.tick(), "RUNNING 1 go to (2.00, 0.00)");
  house.flight.at(2.0, 0.0).succeeds();
  house.sees({openingAt(3, "window", 0.0, kIsOpen)}).tick();
  house.flight.stops();
  EXPECT_THAT(house.tick(), HasSubstr("fly through window 3"));
  house.flight.succeeds();
  EXPECT_EQ(house.tick(), "DONE");
}

TEST(LeaveHouseByWindow, TriesFromAnotherPositionAndAtLastLeavesByTheDoor) {
  HouseFlight house(leaveHouse());
  house.sees({openingAt(2, "window", 0.0, kIsClosed)});
  const auto places = house.flyViews();
  EXPECT_EQ(house.flight.last.state, common::MissionState::kDone) << house.flight.last.reason;
  EXPECT_NEAR(places.back().position_m().x(), 4.6, 1e-9) << "outside";
  std::vector<std::string> said;
  for (const std::string& event : house.flight.events()) said.push_back(event.substr(0, event.find(" (")));
  EXPECT_EQ(std::count(said.begin(), said.end(), "the window was not detected or lost: another position indoors"), 3);
  EXPECT_EQ(std::count(said.begin(), said.end(), "too many failures at the window: by the door"), 1);
  EXPECT_THAT(said, Contains("leaves by the door"));
}

/// A window that is lost in flight is looked for once more, from elsewhere.
TEST(LeaveHouseByWindow, FliesThroughAtTheSecondTry) {
  HouseFlight house(leaveHouse());
  house.sees({openingAt(3, "window", 0.0, kIsOpen)});
  house.flyViews();
  ASSERT_THAT(house.tick(), HasSubstr("fly through window 3"));
  house.flight.fails("it is no longer seen");
  const auto places = house.flyViews();
  ASSERT_FALSE(places.empty());
  EXPECT_THAT(house.tick(), HasSubstr("fly through window 3"));
  house.flight.succeeds();
  EXPECT_EQ(house.tick(), "DONE");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
