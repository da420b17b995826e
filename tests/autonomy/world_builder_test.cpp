// Successive snapshots of the World: what they share, and how the trail and the distance grow.
#include "autonomy/world_builder.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::FlightState;
using common::Time;
using World = std::shared_ptr<const common::World>;

/// A vehicle that hovers in a map that does not change.
class WorldBuilderStory : public ::testing::Test {
 protected:
  WorldBuilderStory() {
    parts_.vehicle.flight_state = FlightState::kFlying;
    parts_.map.grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
    parts_.map.levels = std::make_shared<const common::LevelMap>();
    parts_.map.frontiers = std::make_shared<const std::vector<common::Frontier>>();
    parts_.map.localization.emplace().T_given_odom = {1.0, 2.0, 0.3};
    parts_.mission.status.state = common::MissionState::kRunning;
    parts_.mission.status.name = "Main";
    parts_.mission.status.phase = "hold";
    parts_.mission.status.tree = {{0, -1, "Hold", "RUNNING"}};
    parts_.mission.goal_map_m = {3.0, 4.0};
    parts_.energy.battery_voltage_v = 11.1;
  }

  World snapshot() {
    time_s_ += 0.05;
    parts_.vehicle.state.stamp = Time::fromSeconds(time_s_);
    return builder_.build(Time::fromSeconds(time_s_), parts_);
  }
  World snapshotAt(double x_m, double y_m) {
    parts_.vehicle.state.T_odom_body.position_m = {x_m, y_m, 1.0};
    return snapshot();
  }

  WorldParts parts_;
  WorldBuilder builder_;
  double time_s_ = 0.0;
};

TEST_F(WorldBuilderStory, OnlyTheVehicleLayerIsNewWhileHovering) {
  const World before = snapshot(), after = snapshot();
  EXPECT_EQ(after->map, before->map);
  EXPECT_EQ(after->mission, before->mission);
  EXPECT_EQ(after->people, before->people);
  EXPECT_EQ(after->energy, before->energy);
  EXPECT_NE(after->vehicle, before->vehicle);
  EXPECT_GT(after->stamp, before->stamp);
}

TEST_F(WorldBuilderStory, ReplacesOnlyTheLayersThatChanged) {
  const World first = snapshot();
  parts_.map.grid = std::make_shared<const common::OccupancyGrid>(*parts_.map.grid);
  const World mapped = snapshot();
  EXPECT_NE(mapped->map, first->map);
  EXPECT_EQ(mapped->map->grid, parts_.map.grid);
  EXPECT_EQ(mapped->mission, first->mission);

  parts_.mission.status.tree[0].status = "SUCCESS";
  const World done = snapshot();
  EXPECT_NE(done->mission, mapped->mission);
  EXPECT_EQ(first->mission->status.tree[0].status, "RUNNING") << "a snapshot never changes";
  EXPECT_EQ(done->map, mapped->map);

  parts_.energy.battery_voltage_v = 11.0;
  parts_.people.people.push_back({{1.0, 2.0}, 0.3});
  const World walked = snapshot();
  EXPECT_NE(walked->energy, done->energy);
  ASSERT_EQ(walked->people->people.size(), 1u);
  EXPECT_TRUE(done->people->people.empty());
}

TEST_F(WorldBuilderStory, AChangeOfAnyPartReplacesTheMapLayer) {
  World last = snapshot();
  const auto isNew = [&] {
    const World next = snapshot();
    const bool is = next->map != last->map;
    last = next;
    return is;
  };
  EXPECT_FALSE(isNew());
  parts_.map.levels = std::make_shared<const common::LevelMap>();
  EXPECT_TRUE(isNew());
  parts_.map.frontiers = std::make_shared<const std::vector<common::Frontier>>();
  EXPECT_TRUE(isNew());
  parts_.map.explored_area_m2 = 1.0;
  EXPECT_TRUE(isNew());
  common::Localization& localization = *parts_.map.localization;
  localization.state = common::LocalizationState::kLocalized;
  EXPECT_TRUE(isNew());
  localization.stamp = Time::fromSeconds(1.0);
  EXPECT_TRUE(isNew());
  localization.T_given_odom.yaw_rad += 1e-9;
  EXPECT_TRUE(isNew());
  localization.T_given_body.x_m += 1e-9;
  EXPECT_TRUE(isNew());
  localization.covariance(1, 1) = 0.5;
  EXPECT_TRUE(isNew());
  localization.explained = 0.5;
  EXPECT_TRUE(isNew());
  localization.places = 2;
  EXPECT_TRUE(isNew());
  parts_.map.localization.reset();
  EXPECT_TRUE(isNew());
  EXPECT_FALSE(isNew());
}

TEST_F(WorldBuilderStory, TrailAndDistanceGrowWhileItIsAirborne) {
  parts_.vehicle.flight_state = FlightState::kLanded;
  EXPECT_TRUE(snapshotAt(0.0, 0.0)->vehicle->trail.points_map_m().empty());
  EXPECT_EQ(snapshotAt(1.0, 0.0)->vehicle->distance_flown_m, 0.0) << "carried, not flown";
  parts_.vehicle.flight_state = FlightState::kFlying;
  const World begin = snapshotAt(1.0, 0.0);
  snapshotAt(1.03, 0.0);
  const World end = snapshotAt(1.06, 0.0);
  EXPECT_NEAR(end->vehicle->distance_flown_m, 0.06, 1e-12);
  ASSERT_EQ(end->vehicle->trail.points_map_m().size(), 2u) << "one every 5 cm";
  EXPECT_TRUE(end->vehicle->trail.continues(begin->vehicle->trail));
  EXPECT_EQ(begin->vehicle->trail.points_map_m().size(), 1u);
}

TEST_F(WorldBuilderStory, AHoverFliesNowhereHoweverLongItIs) {
  snapshotAt(0.0, 0.0);
  snapshotAt(2.0, 0.0);
  double flown_m = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double wandered_m = 0.06 * std::sin(0.02 * i), noise_m = i % 2 == 0 ? 0.01 : -0.01;
    const double next_m = snapshotAt(2.0 + wandered_m + noise_m, wandered_m)->vehicle->distance_flown_m;
    EXPECT_GE(next_m, flown_m) << "it never shrinks";
    flown_m = next_m;
  }
  EXPECT_NEAR(flown_m, 2.0, 0.3);
  snapshotAt(2.0, 3.0);
  EXPECT_NEAR(snapshotAt(2.0, 4.0)->vehicle->distance_flown_m, 6.0, 0.5);
}

TEST_F(WorldBuilderStory, TheTrailIsInMapAndAMapCorrectionAddsNoDistance) {
  snapshotAt(0.0, 0.0);
  parts_.vehicle.state.T_map_odom = {0.0, 5.0, 0.0};
  const World corrected = snapshotAt(1.0, 0.0);
  EXPECT_NEAR(corrected->vehicle->distance_flown_m, 1.0, 1e-12);
  EXPECT_EQ(corrected->vehicle->trail.points_map_m().back(), Eigen::Vector2d(1.0, 5.0));
}

TEST_F(WorldBuilderStory, TheVehicleHasItsConfiguredName) {
  EXPECT_EQ(snapshot()->vehicle->name, "");
  EXPECT_EQ(WorldBuilder("second").build(Time{}, parts_)->vehicle->name, "second");
}

}  // namespace
}  // namespace swiftlet::autonomy
