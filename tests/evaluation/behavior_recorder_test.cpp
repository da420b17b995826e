// What behaviours promise, by the truth.
#include "evaluation/behavior_recorder.hpp"
#include "evaluation/criteria.hpp"
#include "evaluation/true_world.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "evaluation/figure_measures.hpp"
#include "tests/simulation/fixtures.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::evaluation {
namespace {

class Behaviors : public testing::Test {
 protected:
  void zones(std::vector<common::Polygon> zones) {
    test::Layers layers;
    layers.map.keep_out = std::make_shared<const std::vector<common::Polygon>>(std::move(zones));
    recorder_.world(layers.world());
  }
  void at(double x_m, double y_m, bool airborne = true) {
    common::Pose3 pose;
    pose.position_m = {x_m, y_m, 1.0};
    simulation::Truth truth;
    truth.stamp = now_;
    truth.airborne = airborne;
    truth.T_world_body = pose;
    recorder_.tick(truth, pose, {});
    now_ += common::Duration::fromMilliseconds(100);
  }
  void intent(common::IntentKind kind, std::uint64_t id = 1, bool inspecting = false) {
    recorder_.intent({id, std::move(kind)}, {id, common::IntentState::kRunning, "", false, inspecting});
  }
  void believed(double x_m) {
    test::Layers layers;
    layers.people.followed_map_m = Eigen::Vector2d(x_m, 0.0);
    recorder_.world(layers.world());
  }
  BehaviorRecorder recorder_;
  common::Time now_;
};

const common::Polygon kSquare{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};

TEST_F(Behaviors, TheLeastDistanceFromAZoneCountsFromWhenItWasOutside) {
  at(1.5, 1.5);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "there is no zone yet";
  zones({kSquare});
  at(1.5, 1.5);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "it was made around the vehicle, which leaves";
  at(0.2, 1.5, false);
  EXPECT_FALSE(recorder_.record().keep_out_distance_m) << "on the ground";
  at(0.0, 1.5);
  at(0.6, 1.5);
  at(0.1, 1.5);
  EXPECT_NEAR(*recorder_.record().keep_out_distance_m, 0.4, 1e-9);
  at(1.3, 1.5);
  EXPECT_NEAR(*recorder_.record().keep_out_distance_m, -0.3, 1e-9) << "inside";
}

TEST_F(Behaviors, FollowingCountsFromTheRightDistanceOn) {
  recorder_.people({{2.0, 0.0}});
  believed(2.0);
  at(-4.0, 0.0);
  EXPECT_TRUE(recorder_.record().follows.empty()) << "nobody follows yet";
  intent(common::FollowIntent{});
  at(-4.0, 0.0);
  EXPECT_TRUE(recorder_.record().follows.empty()) << "still on its way";
  for (int i = 0; i < 30; ++i) at(0.0, 0.0);
  believed(3.5);
  for (int i = 0; i < 20; ++i) at(-1.5, 0.0);
  ASSERT_EQ(recorder_.record().follows.size(), 1u);
  EXPECT_NEAR(recorder_.record().follows.front().followed_s, 5.0, 1e-6);
  EXPECT_NEAR(recorder_.record().follows.front().in_distance_s, 3.0, 1e-6);
  EXPECT_NEAR(recorder_.record().follows.front().lost_s, 2.0, 1e-6);
  EXPECT_NEAR(recorder_.record().follows.front().farthest_m, 3.5, 1e-9);
}

TEST_F(Behaviors, EachModeOfFollowingHasItsFiguresAndTheLeastShareCounts) {
  recorder_.people({{2.0, 0.0}});
  believed(2.0);
  common::FollowIntent follow;
  intent(follow, 1);
  for (int i = 0; i < 20; ++i) at(0.0, 0.0);
  intent(follow, 2);  // After an interruption.
  for (int i = 0; i < 20; ++i) at(0.0, 0.0);
  EXPECT_EQ(recorder_.record().follows.size(), 1u);
  follow.mode = common::FlightMode::kBrisk;
  intent(follow, 3);
  at(-2.0, 0.0);
  for (int i = 0; i < 30; ++i) at(0.0, 0.0);
  for (int i = 0; i < 10; ++i) at(-2.0, 0.0);
  FlightRecord flight;
  flight.behaviors = recorder_.record();
  FlightScore score;
  measureBehaviors(flight, {}, score);
  EXPECT_NEAR(*score["follow_first_share"], 1.0, 1e-9);
  EXPECT_NEAR(*score["follow_last_share"], 0.75, 1e-6);
  EXPECT_EQ(score["follow_share"], score["follow_last_share"]);
  EXPECT_NEAR(*score["follow_farthest_m"], 4.0, 1e-9);
}

TEST_F(Behaviors, InspectingCountsOnceItHasTurnedToThePoint) {
  intent(common::InspectIntent{});
  at(1.0, 0.0);
  EXPECT_TRUE(recorder_.record().inspecting.empty());
  intent(common::InspectIntent{}, 1, true);
  at(1.0, 0.0);
  EXPECT_EQ(recorder_.record().inspecting.size(), 1u);
}

/// A floor with a table and a wall, and a camera that looks 45 deg down from 1 m.
class Surveyed : public testing::Test {
 protected:
  Surveyed() {
    world_.rays = &rays_;
    world_.rgbd_camera.emplace();
    world_.rgbd_camera->range_min_m = 0.3;
    world_.T_body_camera.rotation = common::quaternionFrom({0.0, 0.25 * std::numbers::pi, 0.0});
  }
  static simulation::WorldModel floor() {
    simulation::WorldModel world;
    world.shapes.push_back(simulation::boxShape("floor", {-5, -5, -0.1}, {5, 5, 0}));
    world.shapes.push_back(simulation::boxShape("wall", {-1.2, -2.0, 0}, {-1.0, 2.0, 2.5}));
    world.shapes.push_back(simulation::boxShape("table", {1.0, -0.2, 0}, {1.4, 0.2, 0.7}));
    return world;
  }
  common::Pose3 at(double x_m, double yaw_rad) const {
    return {common::quaternionFrom({0, 0, yaw_rad}), {x_m, 0.0, 1.0}};
  }
  simulation::WorldModel model_ = floor();
  simulation::RayCaster rays_{model_};
  TrueWorld world_;
};

TEST_F(Surveyed, WhatTheCameraSeesUnhiddenCountsAndFloorBelowATableDoesNot) {
  const common::Polygon ahead{{{0.8, -0.3}, {1.2, -0.3}, {1.2, 0.3}, {0.8, 0.3}}};
  EXPECT_NEAR(*surveyCoverage(ahead, world_, {}, {at(0.0, 0.0)}), 1.0, 1e-9);
  EXPECT_NEAR(*surveyCoverage(ahead, world_, {}, {at(0.0, std::numbers::pi)}), 0.0, 1e-9) << "it looks away";
  const common::Polygon behind{{{1.5, -0.1}, {1.9, -0.1}, {1.9, 0.1}, {1.5, 0.1}}};
  EXPECT_LT(*surveyCoverage(behind, world_, {}, {at(0.3, 0.0)}), 0.5) << "the table hides it";
  EXPECT_NEAR(*surveyCoverage(behind, world_, {}, {at(0.3, 0.0), at(2.7, std::numbers::pi)}), 1.0, 1e-9);
}

TEST_F(Surveyed, FloorInsideAWallDoesNotCountAndTheHeightIsThatOfTheFlight) {
  common::Pose3 landed = at(-2.0, 0.0);
  landed.position_m.z() = 0.15;
  const common::Polygon around{{{-1.6, -0.2}, {-0.6, -0.2}, {-0.6, 0.2}, {-1.6, 0.2}}};  // With a wall across it.
  EXPECT_NEAR(*surveyCoverage(around, world_, {}, {at(-2.2, 0.0), at(0.0, std::numbers::pi)}), 1.0, 1e-9);
  const common::Polygon table{{{0.8, -0.15}, {1.6, -0.15}, {1.6, 0.15}, {0.8, 0.15}}};
  EXPECT_NEAR(*surveyCoverage(table, world_, {}, {at(0.0, 0.0), at(2.5, std::numbers::pi), landed}), 1.0, 1e-9);
}

TEST(BehaviorCriteria, AnUnmeasuredOrLesserDistanceIsAMiss) {
  FlightScore score;
  score.mission_done = true;
  Criteria criteria;
  EXPECT_TRUE(missed(score, criteria).empty());
  criteria["keep_out_gap_min_m"] = 0.02;
  EXPECT_EQ(missed(score, criteria).size(), 1u);
  score["keep_out_gap_m"] = 0.01;
  EXPECT_EQ(missed(score, criteria).size(), 1u);
  score["keep_out_gap_m"] = 0.03;
  EXPECT_TRUE(missed(score, criteria).empty());
}

}  // namespace
}  // namespace swiftlet::evaluation
