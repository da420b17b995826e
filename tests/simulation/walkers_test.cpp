// People in the room with a vehicle.
#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

TEST(WalkerConfig, APauseNeedsTwoPoints) {
  WalkerConfig walker;
  walker.mode = WalkerMode::kPath;
  walker.path_world_m = {1.0, 2.0};
  EXPECT_TRUE(walker.validate().empty());
  walker.pause_s = 1.0;
  EXPECT_FALSE(walker.validate().empty());
  walker.path_world_m = {1.0, 2.0, 3.0, 2.0};
  EXPECT_TRUE(walker.validate().empty());
}

TEST(Walkers, AWalkerIsBlamedForHittingAHoveringVehicle) {
  Scenario scenario;
  scenario.walkers.push_back({WalkerMode::kPath, {3, 0, -3, 0}, WalkerEnd::kStay, 1.0, 0.25, 1.75, 4.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  EXPECT_FALSE(pilot.fly(10));
  EXPECT_EQ(vehicle.truth().touched, "walker 1");
  EXPECT_TRUE(vehicle.truth().by_walker);
  EXPECT_TRUE(vehicle.truth().yielding);
  EXPECT_EQ(vehicle.truth().min_walker_clearance_m, 0.0);
  // It walked 3 m less both radii.
  EXPECT_NEAR(vehicle.truth().contact_time.seconds(), 4.0 + 3.0 - 0.525, 0.3);
  EXPECT_NEAR(vehicle.truth().walker_in_field_s.value(), vehicle.truth().contact_time.seconds() - 4.0, 0.05);
}

/// A walker who comes to the vehicle at (0, 0) from there.
Truth struckFrom(std::vector<double> path_world_m, const WorldModel& world = boxRoom()) {
  Scenario scenario;
  scenario.walkers.push_back({WalkerMode::kPath, std::move(path_world_m), WalkerEnd::kStay, 1.0, 0.25, 1.75, 4.0});
  SimulatedVehicle vehicle(world, scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  EXPECT_FALSE(pilot.fly(15));
  EXPECT_TRUE(vehicle.truth().by_walker);
  return vehicle.truth();
}

TEST(Walkers, AreInTheFieldOfTheLaserFromWhenItCanSeeThem) {
  EXPECT_FALSE(struckFrom({-3, 0, 0, 0}).walker_in_field_s) << "they come from behind";
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("screen", {1.5, -0.1, 0.0}, {1.6, 3.0, 2.5}));
  const auto round = struckFrom({3.0, 1.5, 3.0, -1.5, 1.0, -1.5, 0.0, 0.0}, world);
  EXPECT_LT(round.walker_in_field_s.value(), struckFrom({3.0, 1.5, 3.0, -1.5, 1.0, -1.5, 0.0, 0.0}).walker_in_field_s)
      << "they come from behind the screen";
}

TEST(Walkers, AWalkerStandsAtItsPointsAndChangesItsSpeed) {
  Scenario scenario;
  WalkerConfig walker{WalkerMode::kPath, {-2, 3, 0, 3, 0, 2}, WalkerEnd::kLoop, 1.0, 0.25, 1.75, 0.0};
  walker.speeds_m_s = {1.0, 0.5};
  walker.pause_s = 2.0;
  scenario.walkers.push_back(walker);
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  const auto placeAt = [&](double time_s) {
    EXPECT_TRUE(pilot.fly(time_s - vehicle.now().seconds()));
    return vehicle.walkers().at(0).position_world_m;
  };
  EXPECT_LT((placeAt(1.5) - Eigen::Vector2d(-2, 3)).norm(), 0.02) << "the first pause";
  EXPECT_LT((placeAt(3.0) - Eigen::Vector2d(-1, 3)).norm(), 0.02) << "1 m/s";
  EXPECT_LT((placeAt(5.5) - Eigen::Vector2d(0, 3)).norm(), 0.02) << "the second pause";
  EXPECT_LT((placeAt(7.0) - Eigen::Vector2d(0, 2.5)).norm(), 0.02) << "0.5 m/s";
  EXPECT_LT((placeAt(9.5) - Eigen::Vector2d(0, 2)).norm(), 0.02) << "the third pause";
}

TEST(Walkers, TheVehicleIsBlamedForHittingAStandingPerson) {
  Scenario scenario;
  scenario.walkers.push_back({WalkerMode::kPath, {2, 0}, WalkerEnd::kStay});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(3));
  pilot.flyTo(4, 0, 1);
  EXPECT_FALSE(pilot.fly(5));
  EXPECT_TRUE(vehicle.truth().by_walker);
  EXPECT_FALSE(vehicle.truth().yielding);
}

TEST(Walkers, AWalkerCrossesAheadInSightAndLeaves) {
  Scenario scenario;
  scenario.start = {false, -4.0, 0.0, 0.0, 0.0};
  scenario.walkers.push_back({.mode = WalkerMode::kCrossPath, .path_world_m = {}, .start_s = 1.0, .distance_m = 3.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-4, 0, 1);
  ASSERT_TRUE(pilot.fly(4));
  EXPECT_TRUE(vehicle.walkers().empty()) << "nobody crosses ahead of a vehicle at rest";
  pilot.max_speed_m_s = 0.5;
  pilot.flyTo(0, 0, 1);
  double least_y = 9, greatest_y = -9;
  bool came = false;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(pilot.fly(0.1)) << vehicle.stopReason();
    if (vehicle.walkers().empty()) continue;
    const Eigen::Vector2d at = vehicle.walkers()[0].position_world_m;
    if (!came) {
      EXPECT_GT((at - vehicle.truth().T_world_body.position_m.head<2>()).norm(), 2.0);
    }
    came = true;
    least_y = std::min(least_y, at.y());
    greatest_y = std::max(greatest_y, at.y());
  }
  EXPECT_TRUE(came);
  EXPECT_LT(least_y, -1.0);
  EXPECT_GT(greatest_y, 1.0);
  EXPECT_TRUE(vehicle.walkers().empty()) << "the walker has left";
}

TEST(Walkers, AFollowerStaysBehindOnTheVehiclesTrail) {
  Scenario scenario;
  scenario.start = {false, -4.0, -3.0, 0.0, 0.0};
  scenario.walkers.push_back({.mode = WalkerMode::kFollow, .path_world_m = {}, .distance_m = 1.0});
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(-4, -3, 1);
  ASSERT_TRUE(pilot.fly(3));
  pilot.flyTo(4, -3, 1);
  ASSERT_TRUE(pilot.fly(9));
  pilot.flyTo(4, 3, 1);
  ASSERT_TRUE(pilot.fly(12)) << vehicle.stopReason();
  ASSERT_EQ(vehicle.walkers().size(), 1U);
  const Eigen::Vector2d gap = vehicle.truth().T_world_body.position_m.head<2>() - vehicle.walkers()[0].position_world_m;
  EXPECT_NEAR(gap.norm(), 1.0 + 0.275 + 0.25, 0.1) << "it came after and stopped";
  EXPECT_GT(vehicle.truth().min_walker_clearance_m, 0.9);
}

}  // namespace
}  // namespace swiftlet::simulation
