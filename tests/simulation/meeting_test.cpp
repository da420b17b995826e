// Two vehicles that see each other, meet people, and touch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "arena_fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using ::testing::StartsWith;

constexpr double kRadius_m = 0.275;

TEST(Meeting, TheLaserMeasuresTheOtherHull) {
  Pair pair(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 1, 0, 180)}));
  pair.fly(0.5);
  EXPECT_NEAR(rangeAhead_m(pair.pilot_a.events), 3.0 - kRadius_m, 0.05);
  EXPECT_NEAR(rangeAhead_m(pair.pilot_b.events), 3.0 - kRadius_m, 0.05);

  pair.pilot_b.flyTo(1, 0, 1.2);
  pair.fly(4.0);
  EXPECT_NEAR(rangeAhead_m(pair.pilot_a.events), 7.0, 0.05) << "b is above the plane of a's laser: the wall";
  EXPECT_EQ(pair.a.truth().min_vehicle_clearance_m, Truth::kClearanceLimit_m);
}

TEST(Meeting, TheCameraSeesTheOtherHull) {
  Pair seen(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", -1, 0)}));
  Pair unseen(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", -4, 0)}));
  double redness[2] = {0.0, 0.0};
  for (Pair* pair : {&seen, &unseen}) {
    pair->a.setCameraConsumer(true);
    pair->fly(0.3);
    const common::Image& image = eventsOf<Frame>(pair->pilot_a.events).back()->image;
    const std::size_t middle = 3U * (12U * 32U + 16U);
    redness[pair == &seen ? 0 : 1] = static_cast<double>(image.rgb[middle]) / image.rgb[middle + 2];
  }
  EXPECT_LT(redness[0], 0.5) << "a blue hull";
  EXPECT_NEAR(redness[1], 1.0, 0.15) << "a grey wall";
}

TEST(Meeting, TouchingHullsEndBothFlights) {
  Pair pair(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 2, 0)}));
  pair.pilot_a.flyTo(-2, 0, 1);
  pair.pilot_b.flyTo(2, 0, 1);
  pair.fly(4.0);
  ASSERT_TRUE(pair.a.truth().airborne && pair.b.truth().airborne);
  pair.pilot_a.flyTo(1, 0, 1);
  pair.pilot_b.flyTo(-1, 0, 1);
  pair.fly(6.0);
  EXPECT_THAT(pair.a.stopReason(), StartsWith("touched `b` at ("));
  EXPECT_THAT(pair.b.stopReason(), StartsWith("touched `a` at ("));
  EXPECT_EQ(pair.a.truth().contact_time, pair.b.truth().contact_time);
  EXPECT_EQ(pair.a.now(), pair.a.truth().contact_time);
  EXPECT_FALSE(pair.a.truth().by_walker);
  EXPECT_EQ(pair.a.truth().min_vehicle_clearance_m, 0.0);
  const Eigen::Vector3d apart = pair.a.truth().T_world_body.position_m - pair.b.truth().T_world_body.position_m;
  EXPECT_NEAR(apart.norm(), 2 * kRadius_m, 0.05);
  std::vector<common::SensorEvent> more;
  EXPECT_FALSE(pair.a.advanceTo(common::Time::fromSeconds(60), more)) << "it stays crashed";
}

TEST(Meeting, AVehicleMayFlyOverAnother) {
  Pair pair(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 0, 0)}));
  pair.pilot_a.flyTo(-2, 0, 1.5);
  pair.fly(4.0);
  pair.pilot_a.flyTo(2, 0, 1.5);
  pair.fly(6.0);
  EXPECT_FALSE(pair.a.truth().crashed) << pair.a.stopReason();
  EXPECT_GT(pair.a.truth().T_world_body.position_m.x(), 1.5);
}

TEST(Meeting, ACrashedVehicleFallsAndTheOtherContinues) {
  Pair pair(scenarioOf({vehicleAt("a", -2, 0), vehicleAt("b", 3.5, 0)}));
  pair.pilot_a.flyTo(-2, 0, 1);
  pair.pilot_b.flyTo(3.5, 0, 1);
  pair.fly(4.0);
  pair.pilot_b.flyTo(9, 0, 1);
  pair.fly(4.0);
  EXPECT_EQ(pair.b.truth().touched, "east");
  EXPECT_GT(pair.b.truth().T_world_body.position_m.z(), 0.8) << "the truth stays at the contact";
  EXPECT_NEAR(pair.arena->vehicle(1).hull().bottom_m, 0.0, 1e-6);
  EXPECT_FALSE(pair.a.truth().crashed) << pair.a.stopReason();
  EXPECT_EQ(pair.a.now(), common::Time::fromSeconds(8.0));
}

TEST(Meeting, APersonFollowsTheGivenVehicle) {
  Scenario scenario = scenarioOf({vehicleAt("a", -4, 3), vehicleAt("b", -4, -3)});
  WalkerConfig follower{.mode = WalkerMode::kFollow, .path_world_m = {}, .distance_m = 1.0};
  follower.vehicle = "b";
  scenario.walkers.push_back(follower);
  Pair pair(scenario);
  pair.pilot_a.flyTo(-4, 3, 1);
  pair.pilot_b.flyTo(-4, -3, 1);
  pair.fly(3.0);
  pair.pilot_b.flyTo(4, -3, 1);
  pair.fly(12.0);
  ASSERT_EQ(pair.arena->people().size(), 1U);
  const Eigen::Vector2d gap =
      pair.b.truth().T_world_body.position_m.head<2>() - pair.arena->people()[0].position_world_m;
  EXPECT_NEAR(gap.norm(), 1.0 + kRadius_m + 0.25, 0.1);
  EXPECT_LT(pair.arena->people()[0].position_world_m.y(), -2.5);
}

TEST(Meeting, APersonCrossesAheadOfTheGivenVehicle) {
  Scenario scenario = scenarioOf({vehicleAt("a", -4, 3), vehicleAt("b", -4, -1)});
  WalkerConfig crosser{.mode = WalkerMode::kCrossPath, .path_world_m = {}, .distance_m = 3.0};
  crosser.vehicle = "b";
  scenario.walkers.push_back(crosser);
  Pair pair(scenario);
  pair.pilot_a.flyTo(-4, 3, 1);
  pair.pilot_b.flyTo(-4, -1, 1);
  pair.fly(4.0);
  EXPECT_TRUE(pair.arena->people().empty()) << "b stands still in the air";
  pair.pilot_b.max_speed_m_s = 0.5;
  pair.pilot_b.flyTo(0, -1, 1);
  double least_y_m = 9.0, greatest_y_m = -9.0;
  for (int i = 0; i < 80; ++i) {
    pair.fly(0.1);
    for (const Actor& person : pair.arena->people()) {
      least_y_m = std::min(least_y_m, person.position_world_m.y());
      greatest_y_m = std::max(greatest_y_m, person.position_world_m.y());
    }
  }
  EXPECT_LT(least_y_m, -2.0);
  EXPECT_GT(greatest_y_m, 0.0);
  EXPECT_FALSE(pair.b.truth().crashed) << pair.b.stopReason();
}

TEST(Gap, IsHorizontalAndInfiniteBetweenCylindersAboveEachOther) {
  const Actor low{{0.0, 0.0}, 0.3, 0.0, 0.25};
  EXPECT_NEAR(gapBetween_m(low, {{3.0, 4.0}, 0.2, 0.2, 0.5}), 4.5, 1e-12);
  EXPECT_EQ(gapBetween_m(low, {{0.4, 0.0}, 0.2, 0.2, 0.5}), 0.0);
  EXPECT_EQ(gapBetween_m(low, {{0.0, 0.0}, 0.2, 0.3, 0.5}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace swiftlet::simulation
