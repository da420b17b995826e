// What behaviours do in a flight with a given map, tick by tick: where the places of the mission lie, LoadMap and
// Relocalize. The test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The given map lies turned by 90 degrees about (x_m, 2) in `map`: its (3, -1) is (x_m + 1, 5).
Flight& placed(Flight& flight, double x_m) {
  return flight.localization(common::LocalizationState::kLocalized).change([x_m](auto& layers) {
    layers.map.T_map_given = common::Pose2{x_m, 2.0, 90.0 * common::kRadPerDeg};
  });
}

Flight& lost(Flight& flight) {
  return flight.localization(common::LocalizationState::kLost).change([](auto& layers) {
    layers.map.T_map_given.reset();
  });
}

template <typename Kind>
const Kind& kindOf(const Flight& flight) {
  return std::get<Kind>(flight.context.intent->kind);
}

TEST(GivenMap, BoundsOfExploreLieInTheGivenMap) {
  Flight flight(R"(<Explore bounds="0;0;4;2"/>)");
  placed(flight, 1.0);
  flight.tick();
  const auto bounds = kindOf<common::ExploreIntent>(flight).bounds;
  ASSERT_TRUE(bounds);
  EXPECT_TRUE(bounds->contains({0.0, 4.0})) << "(2, 1) of the given map";
  EXPECT_FALSE(bounds->contains({2.0, 1.0}));
}

TEST(GivenMap, BoundsOfAnUnknownPlaceFail) {
  Flight flight(R"(<Explore bounds="0;0;4;2"/>)");
  lost(flight);
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.context.intent, std::nullopt);
}

TEST(GivenMap, FollowPathPassesItsPointsThereAndFollowsTheMap) {
  Flight flight(R"(<FollowPath points="3;-1 | 3;1"/>)");
  placed(flight, 1.0);
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (3.00, -1.00) in the given map");
  EXPECT_TRUE(kindOf<common::GoToIntent>(flight).goal_map_m.isApprox(Eigen::Vector2d(2.0, 5.0)));
  placed(flight, 1.05);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 go to (3.00, -1.00) in the given map");
  EXPECT_NEAR(kindOf<common::GoToIntent>(flight).goal_map_m.x(), 2.05, 1e-9);
  flight.at(2.05, 4.9);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 3 go to (3.00, 1.00) in the given map") << "the first point is passed";
  lost(flight);
  EXPECT_EQ(flight.runs().tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "FollowPath: point 2: its place in the given map is not known");
}

TEST(GivenMap, AClickThatIsRefusedIsToldPlacesOfTheMapThatItWasMadeIn) {
  Flight flight("<Sequence><TakeOff/><OperatorCommand/></Sequence>");
  placed(flight, 1.0).tick();
  flight.succeeds().tick();
  // The wall at x = 4.05 of `map`.
  flight.command({0, common::GoalCommand{{4.05, 0.0}, Eigen::Vector2d(-2.0, -3.05)}}).tick();
  EXPECT_THAT(flight.results(),
              ElementsAre("1 refused: goal (-2.00, -3.05) in the given map is in an obstacle at clearance 0.10 m, the "
                          "nearest free place is (-2.00, -2.62)"));
}

TEST(GivenMap, AClickThatIsShiftedIsToldItsPlaceThere) {
  Flight flight("<Sequence><TakeOff/><OperatorCommand/></Sequence>");
  placed(flight, 1.0).tick();
  flight.succeeds().tick();
  // 0.2 m before the wall at x = 4.05 of `map`, clicked on in the frame `map`.
  EXPECT_EQ(flight.goal(3.85, 0.0).tick(), "RUNNING 3 go to (-2.00, -2.62) in the given map");
  EXPECT_THAT(flight.events(), Contains("goal (-2.00, -2.85) in the given map shifted by 0.23 m (to (-2.00, -2.62) "
                                        "in the given map, the nearest free place)"));
}

TEST(GivenMap, PatrolVisitsItsPointsThere) {
  Flight flight(R"(<Patrol points="3;-1" rounds="1" pause_s="0"/>)");
  placed(flight, 1.0).tick();
  EXPECT_TRUE(kindOf<common::GoToIntent>(flight).goal_map_m.isApprox(Eigen::Vector2d(2.0, 5.0)));
  EXPECT_TRUE(kindOf<common::GoToIntent>(flight).goal_given_m->isApprox(Eigen::Vector2d(3.0, -1.0)));
}

TEST(GivenMap, SurveyAndInspectLieThere) {
  Flight survey(R"(<Survey polygon="0;0 | 2;0 | 2;1"/>)");
  placed(survey, 1.0).tick();
  const auto& corners = kindOf<common::SurveyIntent>(survey).area.corners_map_m;
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector2d(1.0, 4.0)));
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector2d(0.0, 4.0), 1e-9));
  Flight inspect(R"(<Inspect point="3;-1"/>)");
  placed(inspect, 1.0).tick();
  EXPECT_TRUE(kindOf<common::InspectIntent>(inspect).point_map_m.isApprox(Eigen::Vector2d(2.0, 5.0)));
}

TEST(GivenMap, ALocatedTargetHasAPlaceThere) {
  Flight flight(R"(<Sequence><LocateTarget place="{p}"/><MoveToGoal goal="{p}"/></Sequence>)");
  placed(flight, 1.0).change([](test::Layers& layers) {
    common::Target target;
    target.id = target.number = 1;
    target.name = "red";
    target.position_map_m = {2.0, 5.0, 0.5};
    target.covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
    target.state = common::TargetState::kFound;
    layers.targets.targets = {target};
  });
  EXPECT_THAT(flight.tick(), HasSubstr("go to"));
  std::string tick = flight.succeeds().tick();
  for (int i = 0; i < 10 && tick.find("(3.00, -1.00)") == std::string::npos; ++i) tick = flight.stops().tick();
  EXPECT_THAT(tick, HasSubstr("go to (3.00, -1.00) in the given map"));
}

TEST(GivenMap, HeadingsAndZonesAreThoseOfTheMap) {
  Flight turn(R"(<TurnTo yaw_deg="10"/>)");
  placed(turn, 1.0).tick();
  EXPECT_NEAR(*kindOf<common::GoToIntent>(turn).yaw_map_rad, 100.0 * common::kRadPerDeg, 1e-9);
  Flight zone(R"(<KeepOut polygon="3;-1 | 4;-1 | 4;1"/>)");
  placed(zone, 1.0).tick();
  const auto& area = std::get<common::KeepOutRequest>(zone.context.requests.at(0).kind).area;
  EXPECT_TRUE(area.corners_map_m[0].isApprox(Eigen::Vector2d(2.0, 5.0)));
}

TEST(GivenMap, ConditionsAskThere) {
  Flight flight(R"(<IsAt place="3;-1"/>)");
  placed(flight, 1.0).at(2.0, 5.1);
  EXPECT_EQ(flight.tick(), "DONE");
}

TEST(GivenMap, AGoalOfTheOperatorFollowsTheMapAndIsGivenUpWithItsPlace) {
  Flight flight("<Sequence><TakeOff/><OperatorCommand/></Sequence>");
  flight.tick();
  flight.succeeds().tick();
  flight.events();
  placed(flight, 1.0);
  const common::GoalCommand goal{{2.0, 5.0}, Eigen::Vector2d(3.0, -1.0)};
  EXPECT_EQ(flight.command({0, goal}).tick(), "RUNNING 3 go to (3.00, -1.00) in the given map");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 3 go to (3.00, -1.00) in the given map");
  placed(flight, 1.3);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 4 go to (3.00, -1.00) in the given map");
  const auto& intent = std::get<common::GoToIntent>(flight.context.intent->kind);
  EXPECT_TRUE(intent.goal_map_m.isApprox(Eigen::Vector2d(2.3, 5.0), 1e-9));
  flight.runs().localization(common::LocalizationState::kLost).change([](auto& layers) {
    layers.map.T_map_given.reset();
  });
  EXPECT_EQ(flight.tick(), "RUNNING 5 hold");
  EXPECT_THAT(flight.events(),
              ElementsAre("goal (3.00, -1.00) in the given map cancelled (its place in the given map is "
                          "not known)"));
}

TEST(GivenMap, NothingIsFlownToWhileThePlaceIsNotKnown) {
  for (const char* leaf : {R"(<FollowPath points="3;-1"/>)", R"(<Survey polygon="0;0 | 2;0 | 2;1"/>)",
                           R"(<Inspect point="3;-1"/>)", R"(<TurnTo yaw_deg="10"/>)", R"(<IsAt place="3;-1"/>)",
                           R"(<KeepOut polygon="3;-1 | 4;-1 | 4;1"/>)", R"(<MoveToGoal goal="3;-1"/>)"}) {
    Flight flight(leaf);
    lost(flight).at(0.0, 0.0);
    EXPECT_EQ(flight.tick(), "FAILED") << leaf;
    EXPECT_THAT(flight.last.reason, HasSubstr("its place in the given map is not known")) << leaf;
  }
}

TEST(LoadMap, AsksForTheMapBeforeTheTakeOff) {
  Flight flight(R"(<Sequence><LoadMap file="office.yaml"/><TakeOff/></Sequence>)");
  flight.is(common::FlightState::kPreparation);
  EXPECT_EQ(flight.tick(), "RUNNING");
  ASSERT_EQ(flight.context.requests.size(), 1u);
  EXPECT_EQ(std::get<common::LoadMapRequest>(flight.context.requests[0].kind).file, "office.yaml");
  flight.context.answers.push_back({flight.context.requests[0].id, true, ""});
  EXPECT_THAT(flight.tick(), HasSubstr("take off"));
}

TEST(LoadMap, FailsWithTheReason) {
  Flight flight(R"(<LoadMap file="office.yaml"/>)");
  flight.tick();
  flight.context.answers.push_back({flight.context.requests[0].id, false, "the map `office.yaml` was not read"});
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "LoadMap: the map `office.yaml` was not read");
}

TEST(LoadMap, IsCheckedBeforeTheFlight) {
  MissionLimits limits;
  limits.has_map = false;
  limits.map_problem = [](const std::string& map, const std::string& mission) -> std::optional<common::Problem> {
    if (map == "good.yaml") return std::nullopt;
    if (map == "dull.yaml")
      return common::Problem{{"d.pgm", 3}, "width", common::Message("test.zero", "is 0"), "1 would fit"};
    return common::Problem{{}, "", common::Message("test.none", "{} of {} does not exist", map, mission), ""};
  };
  EXPECT_THAT(problemsInside(R"(<LoadMap file="bad.yaml"/><TakeOff/><Localize/><Land/>)", limits),
              ElementsAre(At("3:20 LoadMap.file", "mission.map-unusable", "bad.yaml of m.xml")));
  EXPECT_THAT(
      problemsInside(R"(<LoadMap file="dull.yaml"/><TakeOff/><Localize/><Land/>)", limits),
      ElementsAre(At("3:20 LoadMap.file", "mission.map-unusable", "`dull.yaml`: d.pgm:3: width: is 0", "1 would fit")));
  EXPECT_THAT(problemsInside(R"(<LoadMap file="good.yaml"/><TakeOff/><Relocalize/><Land/>)", limits), IsEmpty());
  EXPECT_THAT(problemsInside(R"(<TakeOff/><Relocalize/><Land/>)", limits),
              ElementsAre(At("3:21 Relocalize", "mission.no-map")));
}

TEST(LoadMap, OfAMissionAreNamedOnce) {
  const Mission mission = Mission::fromText(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><LoadMap file=\"a.yaml\"/><LoadMap file=\"b.yaml\"/>"
      "<LoadMap file=\"a.yaml\"/></Sequence></BehaviorTree></root>",
      "m.xml");
  EXPECT_THAT(mission.mapFiles(), ElementsAre("a.yaml", "b.yaml"));
}

/// The first tick asks, the second one looks: the flight has forgotten the place by then.
Flight& forgets(Flight& flight) {
  placed(flight, 1.0).at(0.0, 0.0).tick();
  EXPECT_TRUE(std::holds_alternative<common::RelocalizeRequest>(flight.context.requests.at(0).kind));
  flight.context.answers.push_back({flight.context.requests[0].id, true, ""});
  return lost(flight.stops());
}

TEST(Relocalize, TurnsAboutUntilThePlaceIsKnown) {
  Flight flight("<Relocalize/>");
  forgets(flight).tick();
  EXPECT_NEAR(*kindOf<common::GoToIntent>(flight).yaw_map_rad, 120.0 * common::kRadPerDeg, 1e-9);
  flight.succeeds().tick();
  EXPECT_NEAR(*kindOf<common::GoToIntent>(flight).yaw_map_rad, -120.0 * common::kRadPerDeg, 1e-9);
  placed(flight, 1.0);
  EXPECT_EQ(flight.runs().tick(), "DONE");
}

TEST(Relocalize, DoesNotBelieveThePoseThatItShallForget) {
  Flight flight("<Relocalize/>");
  placed(flight, 1.0);
  EXPECT_THAT(flight.tick(), HasSubstr("RUNNING"));
  EXPECT_THAT(flight.stops().tick(), HasSubstr("hold")) << "the flight has not forgotten it yet";
}

TEST(Relocalize, FliesToWhatIsFreeAroundAndFailsAfterIt) {
  Flight flight(R"(<Relocalize radius_m="4.1"/>)");
  forgets(flight).tick();
  std::vector<std::string> flown;
  for (int i = 0; i < 20 && flight.last.state == common::MissionState::kRunning; ++i)
    if (flight.succeeds().tick(); flight.context.intent) flown.push_back(toString(*flight.context.intent));
  EXPECT_EQ(flight.cause(), "Relocalize: looked around, and the place is still lost");
  // The wall at x = 4 m stands before the first place.
  EXPECT_THAT(flown,
              ElementsAre("go to (0.00, 0.00)", "go to (0.00, 0.00)", "go to (0.00, 4.10)", "go to (0.00, 0.00)",
                          "go to (-4.10, 0.00)", "go to (0.00, 0.00)", "go to (-0.00, -4.10)", "go to (0.00, 0.00)"));
}

// The shape of trials/missions/office_given_map.xml.
TEST(Relocalize, TakesTheFlightOnWhenThePlaceIsLostOnTheWay) {
  Flight flight(R"(<RetryUntilSuccessful num_attempts="5"><Sequence>
      <Fallback><Inverter><IsLost drift_m="100"/></Inverter><Relocalize/><AlwaysSuccess/></Fallback>
      <Localize/><MoveToGoal goal="3;-1"/></Sequence></RetryUntilSuccessful>)");
  placed(flight, 1.0).at(0.0, 0.0);
  EXPECT_THAT(flight.tick(), HasSubstr("go to (3.00, -1.00) in the given map"));
  EXPECT_THAT(flight.context.requests, IsEmpty()) << "a place that is known is not forgotten";
  lost(flight);
  for (int i = 0; i < 3 && flight.context.requests.empty(); ++i) flight.runs().tick();
  ASSERT_FALSE(flight.context.requests.empty());
  EXPECT_THAT(flight.last.phase, HasSubstr("hold")) << "it stops where it is";
  flight.context.answers.push_back({flight.context.requests[0].id, true, ""});
  flight.stops().tick();
  EXPECT_TRUE(kindOf<common::GoToIntent>(flight).yaw_map_rad) << "it turns about";
  placed(flight, 1.0);
  for (int i = 0; i < 3; ++i) flight.runs().tick();
  EXPECT_THAT(flight.tick(), HasSubstr("go to (3.00, -1.00) in the given map"));
}

TEST(Relocalize, FailsWithoutAMapOrInThatOfAnotherPlace) {
  Flight without("<Relocalize/>");
  EXPECT_EQ(without.tick(), "FAILED");
  EXPECT_EQ(without.cause(), "Relocalize: the flight was given no map");
  Flight other("<Relocalize/>");
  forgets(other).tick();
  other.runs().change([](auto& layers) { layers.map.localization->refuted = true; });
  EXPECT_EQ(other.tick(), "FAILED");
  EXPECT_EQ(other.cause(), "Relocalize: the given map does not match this place");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
