// Variation of a scenario by its seed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "fixtures.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::ProblemIs;
using test_support::problemsOf;
using testing::AllOf;
using testing::ElementsAre;

TEST(Variation, IsTheSameForASeedAndKeepsWithinItsBounds) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("crate", {2.0, -0.5, 0.0}, {3.0, 0.5, 1.5}));
  Scenario scenario;
  scenario.variation.start_position_m = 0.3;
  scenario.variation.start_yaw_deg = 10.0;
  scenario.variation.obstacles = {"crate"};
  scenario.variation.wind_m_s = 0.2;
  scenario.variation.battery_remaining = 0.1;
  std::vector<double> xs;
  for (int seed = 1; seed <= 20; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle a(world, scenario), b(world, scenario);
    EXPECT_EQ(a.T_world_map().position_m, b.T_world_map().position_m);
    EXPECT_EQ(a.world().shapes.back().vertices_world_m[0], b.world().shapes.back().vertices_world_m[0]);
    EXPECT_LE(a.T_world_map().position_m.head<2>().lpNorm<Eigen::Infinity>(), 0.3);
    EXPECT_LE(std::abs(common::yawOf(a.T_world_map().rotation)), 10.0 * M_PI / 180 + 1e-9);
    EXPECT_LE((a.world().shapes.back().vertices_world_m[0] - world.shapes.back().vertices_world_m[0]).norm(), 0.43F);
    EXPECT_GE(a.scenario().battery_remaining, 0.9);
    EXPECT_EQ(a.scenario().start.x_m, a.T_world_map().position_m.x());
    xs.push_back(a.T_world_map().position_m.x());
  }
  std::sort(xs.begin(), xs.end());
  EXPECT_LT(xs.front(), -0.1);
  EXPECT_GT(xs.back(), 0.1);
}

TEST(Variation, RedrawsUntilStartIsFreeAndGoalReachable) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("crate", {0.35, -0.5, 0.0}, {1.35, 0.5, 1.5}));
  Scenario scenario;
  scenario.variation.start_position_m = 0.3;
  scenario.variation.obstacles = {"crate"};
  scenario.variation.reachable_map_m = {2.0, 0.0};
  int redraws = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle vehicle(world, scenario);
    redraws += vehicle.redraws();
    const Eigen::Vector3d body = vehicle.truth().T_world_body.position_m;
    EXPECT_EQ(vehicle.rays().sweep({}, body, body, 0.01).shape, Hit::kNothing);
  }
  EXPECT_GT(redraws, 0);
  scenario.variation.reachable_map_m = {9.0, 0.0};
  const auto problems = [&] { return problemsOf([&] { const SimulatedVehicle vehicle(world, scenario); }); };
  EXPECT_THAT(problems(), ElementsAre(AllOf(ProblemIs("start.goal-not-reached", "reachable_map_m", "(9.00, 0.00)"),
                                            ProblemIs("start.goal-not-reached", "reachable_map_m", "200 draws"))));
  scenario.variation.obstacles = {"crates"};
  EXPECT_THAT(problems(), ElementsAre(ProblemIs("world.no-model", "variation.obstacles", "`crate`")));
}

TEST(Variation, ColoursAndLightAreThoseOfTheSeedWithinTheirBounds) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("ball", {2.0, -0.5, 0.0}, {2.3, -0.2, 0.3}));
  world.shapes.back().color = {0.8F, 0.4F, 0.2F};
  Scenario scenario;
  scenario.variation.tinted = {"ball"};
  scenario.variation.tint = 0.1;
  scenario.variation.light_tint = 0.2;
  scenario.variation.light_dimmed = 0.5;
  std::vector<float> reds, lights;
  for (int seed = 1; seed <= 20; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle a(world, scenario), b(world, scenario);
    EXPECT_EQ(a.world().shapes.back().color, b.world().shapes.back().color);
    EXPECT_EQ(a.world().light, b.world().light);
    EXPECT_EQ(a.world().shapes.front().color, world.shapes.front().color) << "a wall";
    const Color share = a.world().shapes.back().color.cwiseQuotient(world.shapes.back().color);
    EXPECT_LE((share - Color::Ones()).lpNorm<Eigen::Infinity>(), 0.1F + 1e-6F);
    reds.push_back(share.x());
    lights.push_back(a.world().light.y());
    EXPECT_NEAR(a.world().light.x() / a.world().light.y(), 1.0F, 0.2F + 1e-6F);
  }
  const auto [low, high] = std::minmax_element(reds.begin(), reds.end());
  EXPECT_LT(*low, 0.95F);
  EXPECT_GT(*high, 1.05F);
  const auto [dim, bright] = std::minmax_element(lights.begin(), lights.end());
  EXPECT_GE(*dim, 0.5F);
  EXPECT_LT(*dim, 0.65F);
  EXPECT_GT(*bright, 0.85F);
  scenario.variation.tinted = {"bal"};
  EXPECT_THROW(SimulatedVehicle(world, scenario), common::InputError);
}

/// The hull stands under a table, but cannot take off from there.
TEST(Variation, AVariedStartHasRoomAbove) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("table", {0.1, -1.0, 0.6}, {1.0, 1.0, 0.65}));
  Scenario scenario;
  scenario.variation.start_position_m = 0.6;
  for (int seed = 1; seed <= 20; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle vehicle(world, scenario);
    EXPECT_LT(vehicle.T_world_map().position_m.x(), 0.1 - scenario.vehicle.hullRadius_m()) << "seed " << seed;
  }
}

TEST(Variation, ARandomStartHasFloorHeadroomAndAPathToTheNominalStart) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("stage", {-5.0, -4.0, 0.0}, {-3.0, 4.0, 0.3}));
  world.shapes.push_back(boxShape("awning", {3.0, -4.0, 0.45}, {5.0, 4.0, 0.5}));
  // A closed room without a door.
  world.shapes.push_back(boxShape("closet_south", {-1.0, 2.0, 0.0}, {1.5, 2.1, 3.0}));
  world.shapes.push_back(boxShape("closet_west", {-1.1, 2.0, 0.0}, {-1.0, 4.0, 3.0}));
  world.shapes.push_back(boxShape("closet_east", {1.5, 2.0, 0.0}, {1.6, 4.0, 3.0}));
  Scenario scenario;
  scenario.variation.start_area_world_m = {5.0, 4.0, -5.0, -4.0};
  scenario.variation.start_yaw_deg = 180.0;
  scenario.variation.flight_height_m = 0.5;
  double least_x_m = 5.0, most_x_m = -5.0, most_yaw_rad = 0.0;
  for (int seed = 1; seed <= 40; ++seed) {
    scenario.seed = seed;
    const SimulatedVehicle vehicle(world, scenario);
    const Eigen::Vector3d at = vehicle.T_world_map().position_m;
    EXPECT_NEAR(at.z(), 0.0, 1e-6) << "on the stage, seed " << seed;
    EXPECT_LT(at.x(), 3.0) << "under the awning, seed " << seed;
    EXPECT_FALSE(at.x() > -1.0 && at.x() < 1.5 && at.y() > 2.0) << "in the closet, seed " << seed;
    least_x_m = std::min(least_x_m, at.x());
    most_x_m = std::max(most_x_m, at.x());
    most_yaw_rad = std::max(most_yaw_rad, std::abs(common::yawOf(vehicle.T_world_map().rotation)));
  }
  EXPECT_LT(least_x_m, -2.0);
  EXPECT_GT(most_x_m, 2.0);
  EXPECT_GT(most_yaw_rad, 2.5);
}

}  // namespace
}  // namespace swiftlet::simulation
