// Doors that close and open during a flight.
#include "simulation/doors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "arena_fixtures.hpp"
#include "common/config_check.hpp"
#include "common/random.hpp"
#include "fixtures.hpp"
#include "simulation/truth_map.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

/// Across the middle of boxRoom() at x = 2.
DoorConfig doorAcross(std::vector<double> closed_s, double width_m = 8.0) {
  return {.name = "hall", .x_m = 2.0, .yaw_deg = 90.0, .width_m = width_m, .height_m = 3.0, .closed_s = closed_s};
}

TEST(DoorConfig, NeedsANameAndTimesInOrder) {
  using test_support::HasProblem;
  const auto problems = [](const DoorConfig& door) { return common::config::problemsOf(door); };
  EXPECT_TRUE(problems(doorAcross({0.0, 3.0, 5.0})).empty());
  EXPECT_THAT(problems(doorAcross({})), HasProblem("door.never-closes", "closed_s"));
  EXPECT_THAT(problems(doorAcross({3.0, 3.0})), HasProblem("door.not-in-order", "closed_s"));
  DoorConfig nameless = doorAcross({1.0});
  nameless.name = "";
  EXPECT_THAT(problems(nameless), HasProblem("door.no-name", "name"));
  Scenario scenario;
  scenario.doors = {doorAcross({1.0}), doorAcross({2.0})};
  EXPECT_THAT(scenario.validate(), HasProblem("config.name-twice", "doors", "`hall`"));
}

/// A shutter, for example: of a window that some flights find closed.
TEST(Doors, AreClosedAllTheTimeInTheirShareOfTheSeeds) {
  Scenario scenario;
  scenario.doors = {doorAcross({})};
  scenario.doors[0].closed_share = 0.33;
  EXPECT_TRUE(common::config::problemsOf(scenario.doors[0]).empty());
  int closed = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    scenario.seed = seed;
    const auto isClosed = [&] {
      SimulatedVehicle vehicle(boxRoom(), scenario);
      std::vector<common::SensorEvent> events;
      EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(0.1), events));
      return !vehicle.truth().closed_doors.empty();
    };
    const bool drawn = isClosed();
    EXPECT_EQ(isClosed(), drawn) << "the same for a seed";
    closed += drawn ? 1 : 0;
  }
  EXPECT_GT(closed, 10);
  EXPECT_LT(closed, 30);
}

TEST(Doors, AreWhereRaysMeetTheSameBoxOfTriangles) {
  DoorConfig config{.name = "any", .x_m = 0.7, .y_m = -0.4, .yaw_deg = 25.0, .width_m = 1.4, .thickness_m = 0.3};
  const Door door(config, 0.1);
  WorldModel world;
  world.shapes = {boxShape("box", {-0.7, -0.15, 0.1}, {0.7, 0.15, 2.1})};
  const Eigen::Rotation2Dd turn(25.0 * common::kRadPerDeg);
  for (Eigen::Vector3f& vertex : world.shapes[0].vertices_world_m) {
    const Eigen::Vector2d at = turn * vertex.head<2>().cast<double>() + Eigen::Vector2d(0.7, -0.4);
    vertex.head<2>() = at.cast<float>();
  }
  const RayCaster triangles(world), nothing{WorldModel()};
  common::RandomStream random(1, "rays");
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d from(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-1, 4));
    const Eigen::Vector3d to(random.uniform(-0.2, 1.6), random.uniform(-1, 0.3), random.uniform(-0.2, 2.4));
    const Eigen::Vector3d direction = (to - from).normalized();
    if (castOnActor(door.actor(), from, direction).distance_m == 0.0) continue;  // From inside, triangles have a back.
    const Hit wanted = triangles.cast(from, direction, 20.0);
    const Hit hit = nothing.cast(from, direction, 20.0, std::vector<Actor>{door.actor()});
    ASSERT_EQ(static_cast<bool>(hit), static_cast<bool>(wanted)) << i;
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit.distance_m, wanted.distance_m, 1e-4);
    EXPECT_NEAR((hit.normal_world - wanted.normal_world).norm(), 0.0, 1e-4);
  }
  EXPECT_GT(hits, 1000);
}

TEST(Doors, AGapIsThatToTheNearestPointOfTheBox) {
  const Door door({.name = "any", .x_m = 1.0, .yaw_deg = 90.0, .width_m = 2.0, .thickness_m = 0.2}, 0.0);
  const Hull hull{0.3, 0.1};
  EXPECT_NEAR(gapTo_m(door.actor(), hull, {0.0, 0.5, 1.0}), 0.6, 1e-12);
  EXPECT_NEAR(gapTo_m(door.actor(), hull, {1.4, 1.4, 1.0}), 0.5 - 0.3, 1e-12) << "from a corner";
  EXPECT_EQ(gapTo_m(door.actor(), hull, {1.0, 0.0, 1.0}), 0.0);
  EXPECT_EQ(gapTo_m(door.actor(), hull, {0.0, 0.0, 2.2}), std::numeric_limits<double>::infinity()) << "above it";
}

TEST(Doors, TheLaserSeesThemWhileTheyAreClosed) {
  Scenario scenario;
  scenario.doors = {doorAcross({1.0, 2.0, 3.0, 4.0})};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  const auto aheadAt = [&](double time_s) {
    std::vector<common::SensorEvent> events;
    EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(time_s), events));
    return rangeAhead_m(events);
  };
  const float open_m = aheadAt(0.9);
  EXPECT_NEAR(open_m - aheadAt(1.5), 3.0 + 0.025, 0.1);
  EXPECT_NEAR(aheadAt(2.5), open_m, 0.1);
  EXPECT_NEAR(open_m - aheadAt(3.5), 3.0 + 0.025, 0.1);
  EXPECT_EQ(vehicle.truth().closed_doors.size(), 1U);
  EXPECT_NEAR(aheadAt(4.5), open_m, 0.1);
  EXPECT_TRUE(vehicle.truth().closed_doors.empty());
}

TEST(Doors, AClosedDoorIsAWallForTheHull) {
  Scenario scenario;
  scenario.doors = {doorAcross({1.0})};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(3));
  EXPECT_EQ(vehicle.truth().min_clearance_m, Truth::kClearanceLimit_m);
  pilot.flyTo(4, 0, 1);
  EXPECT_FALSE(pilot.fly(8));
  EXPECT_EQ(vehicle.truth().touched, "door hall");
  EXPECT_EQ(vehicle.truth().min_clearance_m, 0.0);
  EXPECT_FALSE(vehicle.truth().by_walker);
  EXPECT_NEAR(vehicle.truth().T_world_body.position_m.x(), 2.0 - 0.025 - 0.275, 0.03);
}

TEST(Doors, ADoorWaitsUntilTheVehicleIsGone) {
  Scenario scenario;
  scenario.start = {false, 2.0, 0.0, 0.0, 0.0};
  scenario.doors = {doorAcross({0.0})};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(2, 0, 1);
  ASSERT_TRUE(pilot.fly(3)) << vehicle.stopReason();
  EXPECT_TRUE(vehicle.truth().closed_doors.empty());
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(4)) << vehicle.stopReason();
  EXPECT_EQ(vehicle.truth().closed_doors.size(), 1U);
  EXPECT_NEAR(vehicle.truth().min_clearance_m, Door::kRoom_m, 0.02) << "that of the moment in which it closed";
}

TEST(Doors, AClosedDoorDividesTheFreeSpace) {
  const RayCaster rays(boxRoom());
  FreeSpaceQuery query;
  query.hull_radius_m = 0.275;
  const double open_m2 = area_m2(reachableSpace(rays, query));
  query.closed_doors = {Door(doorAcross({0.0}, 7.9), 0.0).actor()};
  EXPECT_NEAR(area_m2(reachableSpace(rays, query)), open_m2 * 6.425 / 9.45, 1.0);
  query.closed_doors = {Door(doorAcross({0.0}, 4.0), 0.0).actor()};
  EXPECT_NEAR(area_m2(reachableSpace(rays, query)), open_m2 - 0.6 * 4.5, 1.0) << "there is room beside it";
}

}  // namespace
}  // namespace swiftlet::simulation
