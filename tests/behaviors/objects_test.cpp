// LandOnPattern and FindEntrance, tick by tick; the test plays the autonomy and what it recognizes.
#include <cmath>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

common::RecognizedObject recognizedAt(int id, const std::string& what, double x_m, double y_m, bool confirmed = true) {
  common::RecognizedObject object;
  object.id = id;
  object.what = what;
  object.T_map_object.position_m = {x_m, y_m, 0.0};
  object.covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
  object.confirmed = confirmed;
  return object;
}

/// Its normal points back to where it was seen from.
common::RecognizedObject openDoorAt(int id, double x_m, double y_m, double normal_deg) {
  common::RecognizedObject door = recognizedAt(id, "door", x_m, y_m);
  door.T_map_object.position_m.z() = 1.0;
  door.T_map_object.rotation = common::quaternionFrom({0.0, 0.0, normal_deg * common::kRadPerDeg});
  door.size_m = {1.0, 2.0};
  door.passage = common::Passage::kOpen;
  return door;
}

Flight& showsRecognized(Flight& flight, std::vector<common::RecognizedObject> objects) {
  return flight.change([&](test::Layers& layers) {
    layers.objects = std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{std::move(objects)});
  });
}

template <typename Intent>
const Intent& emittedKind(const Flight& flight) {
  return std::get<Intent>(flight.context.intent->kind);
}

TEST(LandOnPattern, SearchesFliesOverItAndLandsOnIt) {
  Flight flight(R"(<LandOnPattern pattern="H" radius_m="1.5" height_m="1.4"/>)");
  showsRecognized(flight.at(-1.0, 0.5), {recognizedAt(1, "F", -1.0, 0.5)});
  EXPECT_THAT(flight.tick(), StartsWith("RUNNING 1 survey an area with 4 corners about (-1.00, 0.50)"));
  EXPECT_EQ(emittedKind<common::SurveyIntent>(flight).height_m, 1.4);
  EXPECT_NEAR(emittedKind<common::SurveyIntent>(flight).area.max_map_m().x(), 0.5, 1e-9);
  showsRecognized(flight.runs(), {recognizedAt(1, "F", -1.0, 0.5), recognizedAt(2, "H", 0.2, 0.3, false)});
  EXPECT_THAT(flight.tick(), HasSubstr("survey")) << "a decoy, and a candidate";
  showsRecognized(flight.runs(), {recognizedAt(1, "F", -1.0, 0.5), recognizedAt(2, "H", 0.2, 0.3)});
  EXPECT_EQ(flight.tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 hold") << "it still moves";
  EXPECT_EQ(flight.stops().tick(), "RUNNING 3 go to (0.20, 0.30)");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 4 land");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 4 land");
  EXPECT_EQ(flight.at(0.3, 0.3).succeeds().tick(), "DONE");
  EXPECT_THAT(flight.events(), ::testing::Contains("found `H` (at (0.20, 0.30, 0.00) +- 0.02 m)"));
}

TEST(LandOnPattern, BesideThePatternIsNoSuccess) {
  Flight flight(R"(<LandOnPattern pattern="H"/>)");
  showsRecognized(flight.at(0.0, 0.0), {recognizedAt(2, "H", 0.2, 0.3)});
  flight.tick();
  flight.stops().tick();
  flight.succeeds().tick();
  EXPECT_EQ(flight.at(0.2, 0.7).succeeds().tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "LandOnPattern: it stands 0.40 m off the middle of `H`");
}

TEST(LandOnPattern, TakesTheNearestOfItsName) {
  Flight flight(R"(<LandOnPattern pattern="H"/>)");
  showsRecognized(flight.at(0.0, 0.0), {recognizedAt(1, "H", 2.0, 0.0), recognizedAt(2, "H", -1.0, 0.0)});
  flight.tick();
  EXPECT_EQ(flight.stops().tick(), "RUNNING 2 go to (-1.00, 0.00)");
}

TEST(LandOnPattern, FailsInTheAirWhenItIsNotSeen) {
  Flight flight(R"(<LandOnPattern pattern="H" radius_m="1.5"/>)");
  showsRecognized(flight, {recognizedAt(1, "F", 1.0, 0.5)});
  flight.tick();
  EXPECT_EQ(flight.succeeds().tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "LandOnPattern: no `H` was seen within 1.5 m");
  Flight blind(R"(<LandOnPattern pattern="H"/>)");
  EXPECT_EQ(blind.tick(), "FAILED");
  EXPECT_EQ(blind.cause(), "LandOnPattern: the profile recognizes nothing");
}

TEST(LandOnPattern, LandsElsewhereWhereThePortSaysSo) {
  Flight flight(R"(<LandOnPattern pattern="H" elsewhere="true"/>)");
  showsRecognized(flight, {});
  flight.tick();
  EXPECT_EQ(flight.fails("none of its places is free").tick(), "RUNNING 2 land");
  EXPECT_EQ(flight.events().back(), "lands elsewhere than on `H` (no `H` was seen: none of its places is free)");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 land");
  EXPECT_EQ(flight.succeeds().tick(), "DONE");
}

TEST(LandOnPattern, AnInterruptionGoesOnOverThePattern) {
  Flight flight(R"(<Priority><Hold/><LandOnPattern pattern="H"/></Priority>)");
  showsRecognized(flight, {recognizedAt(2, "H", 0.2, 0.3)});
  flight.tick();
  flight.stops().tick();
  EXPECT_THAT(flight.succeeds().tick(), HasSubstr("land"));
  flight.runs().holds(true).tick();
  EXPECT_THAT(flight.stops().tick(), HasSubstr("hold"));
  EXPECT_THAT(flight.stops().holds(false).tick(), HasSubstr("land"));
  EXPECT_GT(flight.context.intent->resumes, 0U);
}

TEST(LandOnPattern, IsALandingForTheCheck) {
  EXPECT_THAT(problemsOf(R"(<Sequence><TakeOff/><LandOnPattern pattern="H"/></Sequence>)"), IsEmpty());
  EXPECT_EQ(problemsOf(R"(<Sequence><TakeOff/><LandOnPattern pattern="H"/><GoHome/></Sequence>)").size(), 1U);
  EXPECT_THAT(problemsOf(R"(<Sequence><TakeOff/><Fallback><LandOnPattern pattern="H"/><Sequence><GoHome/><Land/>)"
                         R"(</Sequence></Fallback></Sequence>)"),
              IsEmpty())
      << "it fails in the air";
}

// The free floor reaches from -5 to 5 m, with a wall at x = 4 m.

TEST(FindEntrance, ExploresUntilADoorIsOpenAndChoosesAPlaceInside) {
  Flight flight(R"(<Sequence><FindEntrance depth_m="2" place="{inside}" door="{door}"/>)"
                R"(<MoveToGoal goal="{door}"/><MoveToGoal goal="{inside}"/></Sequence>)");
  common::RecognizedObject window = openDoorAt(1, -1.0, 0.0, 180.0), shut = openDoorAt(2, -1.0, 1.0, 180.0);
  window.what = "window";
  shut.passage = common::Passage::kClosed;
  showsRecognized(flight.at(-3.0, 0.0), {window, shut});
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore");
  showsRecognized(flight.runs(), {window, shut, openDoorAt(3, 0.0, 0.5, 180.0)});
  EXPECT_EQ(flight.tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.stops().tick(), "RUNNING 3 go to (0.00, 0.50)");
  EXPECT_EQ(flight.succeeds().tick(), "RUNNING 4 go to (2.00, 0.50)");
  EXPECT_THAT(flight.events(),
              ::testing::Contains("an entrance (1.00 m wide at (0.00, 0.50), the place inside is (2.00, 0.50))"));
}

TEST(FindEntrance, GoesLessDeepWhereAWallStands) {
  Flight flight(R"(<Sequence><FindEntrance depth_m="4" place="{inside}"/><MoveToGoal goal="{inside}"/></Sequence>)");
  showsRecognized(flight.at(-3.0, 0.0), {openDoorAt(3, 1.0, 0.0, 180.0)});
  flight.tick();
  flight.stops().tick();
  flight.tick();
  EXPECT_LT((emittedKind<common::GoToIntent>(flight).goal_map_m - Eigen::Vector2d(3.4, 0.0)).norm(), 1e-9)
      << "the hull with its clearance fits no nearer to x = 4 m";
}

TEST(FindEntrance, IsOutsideOfWhatItLeaves) {
  Flight flight("<FindEntrance/>");
  showsRecognized(flight.at(2.0, 0.0), {openDoorAt(3, 0.0, 0.0, 180.0)});
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore") << "the vehicle is behind the door that it saw from before it";
}

TEST(FindEntrance, LooksInFromBeforeADoorBehindWhichNothingIsSeen) {
  Flight flight(R"(<FindEntrance/>)");
  showsRecognized(flight.at(0.0, 0.0), {openDoorAt(3, 3.2, 0.0, 180.0)});
  EXPECT_EQ(flight.tick(), "RUNNING 1 go to (2.00, 0.00)") << "the wall is too near behind it";
  EXPECT_NEAR(*emittedKind<common::GoToIntent>(flight).yaw_map_rad, 0.0, 1e-9);
  flight.succeeds().tick();
  for (int i = 0; i < 14; ++i) EXPECT_THAT(flight.stops().tick(), HasSubstr("hold"));
  for (int i = 0; i < 4; ++i) flight.stops().tick();
  EXPECT_THAT(toString(*flight.context.intent), HasSubstr("explore"));
  EXPECT_EQ(flight.succeeds().tick().substr(0, 7), "RUNNING");
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "FindEntrance: no entrance was found");
}

TEST(FindEntrance, FailsWithoutARecognizerAndAsExploringFails) {
  Flight blind("<FindEntrance/>");
  EXPECT_EQ(blind.tick(), "FAILED");
  EXPECT_EQ(blind.cause(), "FindEntrance: the profile recognizes no openings");
  Flight flight("<FindEntrance/>");
  showsRecognized(flight, {});
  flight.tick();
  EXPECT_EQ(flight.fails("incomplete").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "FindEntrance: no entrance was found: incomplete");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
