// The reactive layer with a scan, moving people and the planner's map: frames, limits, retreat.
#include "autonomy/reactive.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/costs/cost_map.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose2;
using common::Time;
using testing::HasSubstr;

/// A vehicle in the middle of a room of 10 m by 8 m, its nose along y of the map; `map` and `odom` differ.
struct ReactiveStory : testing::Test {
  ReactiveStory() : cost_map(planning::test::mapOf(grid)) {
    state.T_map_odom = {1.0, -2.0, 0.3};
    state.T_odom_body = common::lifted(state.T_map_odom.inverse() * T_map_body, 1.0);
  }

  /// Returns of obstacles, in the level frame: x ahead.
  void returnAt(const Eigen::Vector2d& center_level_m) {
    for (int i = -5; i <= 5; ++i)
      scan.points_level_m.push_back((center_level_m + Eigen::Vector2d(0.0, 0.03 * i)).cast<float>());
  }
  void fliesWith(const Eigen::Vector2d& velocity_map_m_s) {
    wanted_map_m_s = velocity_map_m_s;
    state.velocity_odom_m_s.head<2>() = Eigen::Rotation2Dd(-state.T_map_odom.yaw_rad) * velocity_map_m_s;
  }
  const planning::AvoidanceDecision& scanAt(double s) {
    scan.stamp = Time::fromSeconds(s);
    return reactive.update({scan, T_map_body, state, age_s, 0.0, obstacles, wanted_map_m_s, &cost_map.clearance()});
  }

  common::OccupancyGrid grid = planning::test::room(200, 160);
  planning::CostMap cost_map;
  Pose2 T_map_body{5.0, 4.0, 0.5 * std::numbers::pi};
  common::VehicleState state;
  double age_s = 0.0;
  perception::ProjectedScan scan;
  std::vector<common::DynamicObstacle> obstacles;
  Eigen::Vector2d wanted_map_m_s = Eigen::Vector2d::Zero();
  Reactive reactive{ReactiveConfig{}, 0.275};
};

TEST_F(ReactiveStory, BeforeTheFirstScanNothingLimitsTheSpeed) {
  EXPECT_TRUE(std::isinf(reactive.decision().speed_limit_m_s));
  EXPECT_FALSE(reactive.decision().retreat_velocity_level_m_s);
}

TEST_F(ReactiveStory, BrakesForAnObstacleAheadOnItsCourseInTheMap) {
  returnAt({0.8, 0.0});
  fliesWith({0.0, 1.0});  // Forwards.
  const double towards_m_s = scanAt(0.0).speed_limit_m_s;
  EXPECT_LT(towards_m_s, 1.0);
  EXPECT_TRUE(reactive.decision().status.braking);
  fliesWith({1.0, 0.0});  // To the right.
  EXPECT_GT(scanAt(0.025).speed_limit_m_s, towards_m_s + 0.3);
}

TEST_F(ReactiveStory, BrakesEarlierForAnObstacleInAnOldScan) {
  returnAt({1.1, 0.0});
  fliesWith({0.0, 1.0});
  const double fresh_m_s = scanAt(0.0).speed_limit_m_s;
  age_s = 0.2;
  const double old_m_s = scanAt(0.025).speed_limit_m_s;
  EXPECT_LT(old_m_s, fresh_m_s - 0.1);
  age_s = 0.0;
  EXPECT_EQ(scanAt(0.05).speed_limit_m_s, fresh_m_s) << "the age is that of one scan";
}

TEST_F(ReactiveStory, AnOldScanKeepsADoorOfEightyCentimetresOpen) {
  for (const double ahead_m : {1.0, 0.5, 0.2})
    for (const double side_m : {-0.4, 0.4})
      for (int i = 0; i < 5; ++i)
        scan.points_level_m.push_back(Eigen::Vector2f(static_cast<float>(ahead_m), static_cast<float>(side_m)));
  fliesWith({0.0, 0.6});
  for (const double age : {0.0, 0.1, 0.2}) {
    age_s = age;
    EXPECT_GT(scanAt(age).speed_limit_m_s, 0.6) << age;
  }
}

TEST_F(ReactiveStory, RetreatsFromANearbyUnmappedObject) {
  returnAt({0.4, 0.0});
  const auto& decision = scanAt(0.0);
  ASSERT_TRUE(decision.retreat_velocity_level_m_s);
  EXPECT_LT(decision.retreat_velocity_level_m_s->x(), -0.1);
  EXPECT_TRUE(decision.status.retreating);
  EXPECT_THAT(decision.status.reason, HasSubstr("something unmapped"));
}

TEST_F(ReactiveStory, OnlyBrakesForMappedObstacles) {
  T_map_body = {9.6, 4.0, 0.0};  // 0.4 m before the wall.
  returnAt({0.4, 0.0});
  EXPECT_FALSE(scanAt(0.0).retreat_velocity_level_m_s);
}

TEST_F(ReactiveStory, RetreatsFromAnApproachingPersonWhoIsStillFar) {
  common::DynamicObstacle person;
  person.center_map_m = {5.0, 6.0};  // 2 m ahead of the nose.
  person.radius_m = 0.25;
  person.velocity_map_m_s = {0.0, -1.0};
  person.last_seen = Time::fromSeconds(0.0);
  obstacles = {person};
  EXPECT_FALSE(scanAt(0.0).retreat_velocity_level_m_s) << "it has not moved yet";
  obstacles[0].moving = true;
  const auto& decision = scanAt(0.025);
  ASSERT_TRUE(decision.retreat_velocity_level_m_s);
  EXPECT_LE(decision.retreat_velocity_level_m_s->x(), 1e-9) << "back, or aside";
  EXPECT_GT(decision.retreat_velocity_level_m_s->norm(), 0.1);
  EXPECT_THAT(decision.status.reason, HasSubstr("closing in"));
}

TEST_F(ReactiveStory, EndsTheRetreatWhenTheDangerIsGone) {
  returnAt({0.4, 0.0});
  ASSERT_TRUE(scanAt(0.0).retreat_velocity_level_m_s);
  scan.points_level_m.clear();
  EXPECT_TRUE(scanAt(0.1).status.retreating) << "not at once";
  EXPECT_FALSE(scanAt(2.0).status.retreating);
  EXPECT_FALSE(reactive.decision().status.retreating) << "the last decision stands";
}

}  // namespace
}  // namespace swiftlet::autonomy
