// Two vehicles in one arena: what they share, what each has alone, and how time passes for both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "arena_fixtures.hpp"
#include "event_bytes.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using common::Duration;
using common::Time;
using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;

constexpr double kHullRadius_m = 0.275;

/// A wall across the middle of the room: nothing is seen from one half in the other.
WorldModel halvedRoom() {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("wall", {-0.1, -4.0, 0.0}, {0.1, 4.0, 3.0}));
  return world;
}

Scenario withEverything(Scenario scenario) {
  scenario.seed = 7;
  scenario.wind = {.mean_x_m_s = 0.2, .mean_y_m_s = -0.1, .gust_m_s = 0.2, .gust_time_s = 1.0};
  scenario.variation.start_position_m = 0.3;
  scenario.variation.start_yaw_deg = 10.0;
  scenario.variation.wind_m_s = 0.1;
  scenario.variation.battery_remaining = 0.2;
  scenario.walkers.push_back({WalkerMode::kPath, {-4, -3, -4, 3}, WalkerEnd::kReturn});
  return scenario;
}

TEST(Arena, ASecondVehicleOutOfSightDoesNotAffectTheFirst) {
  Scenario alone = withEverything(scenarioOf({}));
  alone.start = vehicleAt("a", -2.5, 0).start;
  SimulatedVehicle vehicle(halvedRoom(), alone);
  vehicle.setCameraConsumer(true);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-2.5, 0.5, 1.0);
  ASSERT_TRUE(pilot.fly(3.0)) << vehicle.stopReason();

  Pair pair(withEverything(scenarioOf({vehicleAt("a", -2.5, 0), vehicleAt("b", 2.5, 0)})), halvedRoom());
  pair.a.setCameraConsumer(true);
  pair.pilot_a.flyTo(-2.5, 0.5, 1.0);
  pair.pilot_b.flyTo(2.5, 1.0, 1.2);
  pair.fly(3.0);
  ASSERT_TRUE(pair.b.truth().airborne) << pair.b.stopReason();
  EXPECT_EQ(bytesOf(pilot.events, true), bytesOf(pair.pilot_a.events, true));
  EXPECT_EQ(vehicle.truth().T_world_body.position_m, pair.a.truth().T_world_body.position_m);
}

TEST(Arena, EachVehicleHasItsOwnNoiseAndStart) {
  Pair pair(withEverything(scenarioOf({vehicleAt("a", -2.5, 0), vehicleAt("b", 2.5, 0)})), halvedRoom());
  pair.fly(0.5);
  const auto first = eventsOf<common::ImuSample>(pair.pilot_a.events);
  const auto second = eventsOf<common::ImuSample>(pair.pilot_b.events);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_NE(first[10].angular_velocity_body_rad_s, second[10].angular_velocity_body_rad_s);
  const Eigen::Vector3d shift_a = pair.a.T_world_map().position_m - Eigen::Vector3d(-2.5, 0, 0);
  const Eigen::Vector3d shift_b = pair.b.T_world_map().position_m - Eigen::Vector3d(2.5, 0, 0);
  EXPECT_NE(shift_a, shift_b);
  for (const Eigen::Vector3d& shift : {shift_a, shift_b}) EXPECT_LE(shift.lpNorm<Eigen::Infinity>(), 0.3);
  EXPECT_NE(pair.a.scenario().battery_remaining, pair.b.scenario().battery_remaining);
  EXPECT_EQ(pair.a.scenario().wind.mean_x_m_s, pair.b.scenario().wind.mean_x_m_s) << "there is one wind";
}

TEST(Arena, TheOrderOfAdvancingChangesNothing) {
  const Scenario scenario = scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 2, 0, 180)});
  Pair forth(scenario), back(scenario);
  for (Pair* pair : {&forth, &back}) {
    pair->pilot_a.flyTo(-1.5, 0.5, 1.0);
    pair->pilot_b.flyTo(1.5, -0.5, 1.0);
  }
  forth.fly(2.0, true);
  back.fly(2.0, false);
  ASSERT_TRUE(forth.a.truth().airborne);
  EXPECT_EQ(bytesOf(forth.pilot_a.events, true), bytesOf(back.pilot_a.events, true));
  EXPECT_EQ(bytesOf(forth.pilot_b.events, true), bytesOf(back.pilot_b.events, true));
}

TEST(ArenaDeath, NoVehicleMayAdvanceAheadOfTheOthers) {
  Pair pair(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 2, 0)}));
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(pair.a.advanceTo(Time::fromSeconds(0.01), events));
  EXPECT_DEATH((void)pair.a.advanceTo(Time::fromSeconds(0.02), events), "seat.now == now_") << "b has still to follow";
  EXPECT_DEATH((void)pair.b.advanceTo(Time::fromSeconds(0.005), events), "time == now_") << "b cannot stop on the way";
  EXPECT_DEATH(pair.b.apply({}), "seat.now == now_") << "what b wants now comes too late";
  ASSERT_TRUE(pair.b.advanceTo(Time::fromSeconds(0.01), events));
  EXPECT_TRUE(pair.a.advanceTo(Time::fromSeconds(0.02), events));
}

TEST(ArenaDeath, AVehicleHasOneUserFromTheStart) {
  const auto arena = std::make_shared<Arena>(boxRoom(), scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 2, 0)}));
  SimulatedVehicle a(arena, 0);
  EXPECT_DEATH(SimulatedVehicle(arena, 0), "attended");
  EXPECT_DEATH(SimulatedVehicle(arena, 2), "index");
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(a.advanceTo(Time::fromSeconds(0.01), events)) << "b has no user";
  EXPECT_DEATH(SimulatedVehicle(arena, 1), "now_");
}

TEST(Arena, AnAbandonedVehicleLandsAndBlocksNobody) {
  const auto arena = std::make_shared<Arena>(boxRoom(), scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 2, 0)}));
  SimulatedVehicle a(arena, 0);
  std::optional<SimulatedVehicle> b(std::in_place, arena, 1);
  TruthPilot pilot_a(a), pilot_b(*b);
  pilot_a.flyTo(-2, 0, 1);
  pilot_b.flyTo(2, 0, 1);
  for (int tick = 0; tick < 300; ++tick) {
    pilot_a.steer();
    pilot_b.steer();
    ASSERT_TRUE(pilot_a.advance() && pilot_b.advance());
  }
  ASSERT_GT(arena->vehicle(1).hull().bottom_m, 0.7);
  b.reset();
  ASSERT_TRUE(pilot_a.fly(10.0)) << a.stopReason();
  EXPECT_FALSE(arena->vehicle(1).truth().airborne);
}

TEST(Arena, StartsThatTouchAreRefused) {
  const auto problems = problemsOf([] {
    const Arena arena(boxRoom(), scenarioOf({vehicleAt("alpha", 0, 0), vehicleAt("beta", 0.4, 0)}));
  });
  EXPECT_THAT(problems, ElementsAre(ProblemIs("start.touches-vehicle", "start of `beta`", "`alpha`")));
}

TEST(Arena, StartsAreRedrawnUntilTheyDoNotTouch) {
  Scenario scenario = scenarioOf({vehicleAt("a", 0, 0), vehicleAt("b", 0.6, 0)});
  scenario.variation.start_position_m = 0.4;
  int redraws = 0;
  for (scenario.seed = 1; scenario.seed <= 20; ++scenario.seed) {
    const Pair pair(scenario);
    const Eigen::Vector3d apart = pair.a.T_world_map().position_m - pair.b.T_world_map().position_m;
    EXPECT_GT(apart.norm(), 2 * kHullRadius_m) << "seed " << scenario.seed;
    EXPECT_EQ(pair.a.redraws(), 0) << "the first is drawn as if it were alone";
    redraws += pair.b.redraws();
  }
  EXPECT_GT(redraws, 0);
}

}  // namespace
}  // namespace swiftlet::simulation
