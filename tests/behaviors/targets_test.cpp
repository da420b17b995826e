// IsTargetFound, LocateTarget and ExploreUntilFound, tick by tick; the test plays the autonomy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "behaviors/seen_places.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/rgbd_frame.hpp"
#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

common::Target target(int id, const std::string& name, const Eigen::Vector3d& place, double sigma_m,
                      bool found = true) {
  common::Target one;
  one.id = id;
  one.name = name;
  one.number = found ? id : 0;
  one.position_map_m = place;
  one.covariance_m2 = sigma_m * sigma_m / 3.0 * Eigen::Matrix3d::Identity();
  one.state = found ? common::TargetState::kFound : common::TargetState::kCandidate;
  return one;
}

Flight& shows(Flight& flight, std::vector<common::Target> targets) {
  return flight.change([&](test::Layers& layers) { layers.targets.targets = std::move(targets); });
}

const common::GoToIntent& goToOf(const Flight& flight) {
  return std::get<common::GoToIntent>(flight.context.intent->kind);
}

Eigen::Vector2d bearingOf(const common::GoToIntent& go_to, const Eigen::Vector2d& place) {
  return (go_to.goal_map_m - place).normalized();
}

std::vector<tree::Problem> problemsInFlight(const std::string& inside, const MissionLimits& limits) {
  return problemsInside("<TakeOff/>" + inside + "<Land/>", limits);
}

TEST(IsTargetFound, CountsThoseOfTheNameThatAreFound) {
  Flight flight(R"(<IsTargetFound target="red" count="2"/>)");
  shows(flight, {target(1, "red", {1, 0, 0}, 0.05), target(2, "red", {2, 0, 0}, 0.05, false),
                 target(3, "blue", {3, 0, 0}, 0.05)});
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "IsTargetFound: 1 of 2 `red` found");
  Flight any(R"(<IsTargetFound count="2"/>)");
  shows(any, {target(1, "red", {1, 0, 0}, 0.05), target(3, "blue", {3, 0, 0}, 0.05)});
  EXPECT_EQ(any.tick(), "DONE");
}

TEST(LocateTarget, FliesToWhereItSeesTheTargetAndFacesIt) {
  Flight flight(R"(<LocateTarget target="red" sigma_m="0.06" distance_m="1.5"/>)");
  flight.at(-2.0, 0.0);
  shows(flight, {target(1, "red", {1.0, 0.0, 0.0}, 0.04), target(2, "blue", {-1.9, 0.2, 0.0}, 0.04)});
  EXPECT_THAT(flight.tick(), StartsWith("RUNNING 1 go to (-0.50, 0.00)"));
  EXPECT_NEAR(*goToOf(flight).yaw_map_rad, 0.0, 1e-9);
  flight.at(-0.5, 0.0).succeeds().tick();
  EXPECT_THAT(flight.stops().tick(), HasSubstr("hold"));
  for (int i = 0; i < 8 && flight.last.state == common::MissionState::kRunning; ++i) flight.stops().tick();
  EXPECT_EQ(flight.last.state, common::MissionState::kDone);
}

TEST(LocateTarget, LooksFromAnotherSideUntilThePlaceIsKnown) {
  Flight flight(R"(<LocateTarget target="red" sigma_m="0.06" distance_m="1.5"/>)");
  flight.at(-2.0, 0.0);
  const Eigen::Vector2d place(1.0, 0.0);
  shows(flight, {target(1, "red", {1.0, 0.0, 0.0}, 0.09)});
  flight.tick();
  const Eigen::Vector2d first = bearingOf(goToOf(flight), place);
  flight.succeeds().tick();
  for (int i = 0; i < 21; ++i) flight.stops().tick();
  ASSERT_THAT(toString(*flight.context.intent), StartsWith("go to"));
  const double turned_rad = std::acos(bearingOf(goToOf(flight), place).dot(first));
  EXPECT_GT(turned_rad, 50.0 * common::kRadPerDeg);
  shows(flight, {target(1, "red", {1.0, 0.0, 0.0}, 0.05)});
  flight.succeeds().tick();
  for (int i = 0; i < 8; ++i) flight.stops().tick();
  EXPECT_EQ(flight.last.state, common::MissionState::kDone);
}

TEST(LocateTarget, FailsWhenAllSidesWereNotEnough) {
  Flight flight(R"(<LocateTarget target="red" sigma_m="0.06" distance_m="1.5"/>)");
  shows(flight, {target(1, "red", {1.0, 0.0, 0.0}, 0.09)});
  for (int i = 0; i < 400 && flight.last.state != common::MissionState::kFailed; ++i) {
    flight.tick();
    if (flight.context.intent && std::holds_alternative<common::GoToIntent>(flight.context.intent->kind))
      flight.succeeds();
    else
      flight.stops();
  }
  EXPECT_THAT(flight.last.reason, HasSubstr("red 1 is known to 0.09 m after looking from"));
}

TEST(LocateTarget, EachSuccessIsAboutAnotherOne) {
  Flight flight(R"(<Sequence><LocateTarget file="{a}"/><Photograph file="{a}"/><LocateTarget file="{b}"/>)"
                R"(<Photograph file="{b}"/><LocateTarget/></Sequence>)");
  shows(flight, {target(1, "red", {1.0, 0.0, 0.0}, 0.04), target(2, "dark blue", {-1.0, 0.0, 0.0}, 0.04)});
  std::vector<std::string> photos;
  for (int i = 0; i < 100 && flight.last.state != common::MissionState::kFailed; ++i) {
    flight.tick();
    const bool goes = flight.context.intent && std::holds_alternative<common::GoToIntent>(flight.context.intent->kind);
    goes ? flight.succeeds() : flight.stops();
    flight.context.answers.clear();
    for (const auto& request : std::exchange(flight.context.requests, {})) {
      photos.push_back(std::get<common::PhotographRequest>(request.kind).name);
      flight.context.answers.push_back({request.id, true, ""});
    }
  }
  EXPECT_THAT(photos, ElementsAre("red_1", "dark_blue_2"));
  EXPECT_EQ(flight.cause(), "LocateTarget: no target is known that was not located");
}

TEST(LocateTarget, NoPlaceToLookFromIsAReason) {
  Flight flight(R"(<LocateTarget distance_m="1.5"/>)");
  shows(flight, {target(1, "red", {40.0, 0.0, 0.0}, 0.04)});
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "LocateTarget: no place to see red 1 from is free");
}

TEST(ExploreUntilFound, StopsWhenEnoughAreFound) {
  Flight flight(R"(<ExploreUntilFound target="red" bounds="-1;-1;3;3"/>)");
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore");
  EXPECT_TRUE(std::get<common::ExploreIntent>(flight.context.intent->kind).bounds);
  EXPECT_EQ(flight.runs().tick(), "RUNNING 1 explore");
  shows(flight.runs(), {target(1, "blue", {1, 0, 0}, 0.05), target(2, "red", {1, 0, 0}, 0.05, false)});
  EXPECT_EQ(flight.tick(), "RUNNING 1 explore") << "a candidate";
  shows(flight.runs(), {target(2, "red", {1, 0, 0}, 0.05)});
  EXPECT_EQ(flight.tick(), "RUNNING 2 hold");
  EXPECT_EQ(flight.runs().tick(), "RUNNING 2 hold") << "it still moves";
  EXPECT_EQ(flight.stops().tick(), "DONE");
}

TEST(ExploreUntilFound, LooksAtWhatTheCameraHasNotSeenAndThenFails) {
  Flight flight(R"(<ExploreUntilFound bounds="-1.5;-1.5;1.5;1.5" leave_building="true"/>)");
  flight.tick();
  flight.succeeds();
  int looks = 0;
  for (int i = 0; i < 2000 && flight.last.state != common::MissionState::kFailed; ++i) {
    flight.tick();
    const bool goes = flight.context.intent && std::holds_alternative<common::GoToIntent>(flight.context.intent->kind);
    looks += goes ? 1 : 0;
    goes ? flight.succeeds() : flight.stops();
  }
  EXPECT_GT(looks, 4) << "no frame comes, so each place is flown to and given up";
  EXPECT_EQ(flight.cause(), "ExploreUntilFound: 0 of 1 found, and nothing is left to look at");
}

TEST(ExploreUntilFound, FailsAsExploringFails) {
  Flight flight("<ExploreUntilFound/>");
  flight.tick();
  EXPECT_EQ(flight.fails("no path").tick(), "FAILED");
  EXPECT_EQ(flight.cause(), "ExploreUntilFound: no path");
}

/// A frame of the shipped camera at 1 m, at the origin, looking along x.
common::Map3dLayer frameAt(double yaw_rad, double stamp_s) {
  auto frame = std::make_shared<common::RgbdFrame>();
  frame->camera = common::RgbdCameraConfig{}.camera();
  frame->stamps.measured = common::Time::fromSeconds(stamp_s);
  common::Map3dLayer layer;
  layer.frame = frame;
  layer.T_map_camera = {common::quaternionFrom({0.0, 10.0 * common::kRadPerDeg, yaw_rad}), {0.0, 0.0, 1.0}};
  return layer;
}

TEST(SeenPlaces, AreInTheSectorOfTheCameraAndNotBehindWalls) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.1);
  for (int y = -50; y < 50; ++y)
    for (int x = -50; x < 50; ++x) grid.set({x, y}, x == 22 ? 50 : -50);
  SeenPlaces places;
  places.see(frameAt(0.0, 1.0), grid, 3.5);
  EXPECT_TRUE(places.isSeen({2.0, 0.0}));
  EXPECT_FALSE(places.isSeen({3.0, 0.0})) << "behind the wall";
  EXPECT_FALSE(places.isSeen({0.9, 0.0})) << "its floor is below the picture";
  EXPECT_FALSE(places.isSeen({0.0, 2.0})) << "to the side";
  places.see(frameAt(std::numbers::pi / 2, 2.0), grid, 3.5);
  EXPECT_TRUE(places.isSeen({0.0, 2.0}));
  EXPECT_TRUE(places.isSeen({0.0, 3.3}));
  EXPECT_FALSE(places.isSeen({0.0, 4.0})) << "too far";
}

TEST(SeenPlaces, TheNextIsTheNearestUnseenFromAFreePlaceThatFacesIt) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.1);
  for (int y = -30; y < 30; ++y)
    for (int x = -30; x < 30; ++x) grid.set({x, y}, std::max(std::abs(x), std::abs(y)) == 29 ? 50 : -50);
  SeenPlaces places;
  const auto look = places.next({0.0, 0.0}, grid, nullptr, {});
  ASSERT_TRUE(look);
  EXPECT_LT(look->place_map_m.norm(), 0.4);
  const Eigen::Vector2d ahead = look->place_map_m - look->from_map.position_m();
  EXPECT_NEAR(ahead.norm(), 2.0, 1e-6);
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), common::wrapAngle(look->from_map.yaw_rad), 1e-6);
}

TEST(SeenPlaces, PlacesThatTheCameraHasSeenAreLookedFromFirst) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.1);
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 40; ++x) grid.set({x, y}, std::max(std::abs(x), std::abs(y)) == 39 ? 50 : -50);
  SeenPlaces places;
  places.see(frameAt(0.0, 1.0), grid, 3.5);
  const auto look = places.next({0.0, 0.0}, grid, nullptr, {});
  ASSERT_TRUE(look);
  EXPECT_TRUE(places.isSeen(look->from_map.position_m())) << "and not one of those behind the vehicle, as near";
}

TEST(Targets, TheCheckRefusesAVehicleWithoutCameraAndNamesThatTheProfileLacks) {
  const std::string mission =
      R"(<ExploreUntilFound target="red"/><LocateTarget target="red"/><IsTargetFound target="red"/>)";
  MissionLimits limits;
  EXPECT_THAT(problemsInFlight(mission, limits), IsEmpty());
  limits.target_names = std::vector<std::string>{"reed", "blue"};
  EXPECT_THAT(problemsInFlight(R"(<LocateTarget target="red"/>)", limits),
              ElementsAre(At("3:21 LocateTarget", "mission.unknown-target", "`red`", "`reed`", "`blue`")));
  EXPECT_THAT(problemsInFlight("<LocateTarget/>", limits), IsEmpty());
  limits.target_names->clear();
  EXPECT_THAT(problemsInFlight("<LocateTarget/>", limits), ElementsAre(At("3:21 LocateTarget", "mission.no-targets")));
  limits.has_camera = false;
  EXPECT_THAT(problemsInFlight(mission, limits),
              ElementsAre(At("3:21 ExploreUntilFound", "mission.no-camera"),
                          At("3:54 LocateTarget", "mission.no-camera"), At("3:82 IsTargetFound", "mission.no-camera")));
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
