// The executor's stories: how each intent is carried out, given up, interrupted and taken up again.
#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/executor_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kFreeCell;
using planning::test::kWallCell;
using testing::HasSubstr;
using testing::StartsWith;

constexpr common::CellRect kDoor{{80, 28}, {81, 52}};  ///< 1.2 m wide, in the wall at x = 4 m, about y = 2 m.

// ------------------------------------------------------------------------------------------- taking off and landing

TEST_F(ExecutorStory, ATakeOffSucceedsAtTheHeight) {
  ceiling_m_ = 0.8;
  want(common::TakeOffIntent{kHeight_m});
  run(6.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  ceiling_m_ = kHeight_m;
  EXPECT_EQ(runToTheEnd(2.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "at the take-off height");
}

TEST_F(ExecutorStory, ATakeOffThatIsRefusedOrBrokenOffFails) {
  want(common::TakeOffIntent{0.1});
  ASSERT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, HasSubstr("is not above"));
  ceiling_m_ = 0.5;  // The controller gives up in the end and lands.
  want(common::TakeOffIntent{kHeight_m});
  EXPECT_EQ(runToTheEnd(30.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot take off while landing");
}

TEST_F(ExecutorInFlight, ALandingSucceedsOnTheGroundHoweverOftenItIsWanted) {
  want(common::LandIntent{});
  run(0.5);
  want(common::LandIntent{});
  run(0.5);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_EQ(controller_.state(), FlightState::kLanding);
  EXPECT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  EXPECT_EQ(controller_.state(), FlightState::kLanded);
  EXPECT_EQ(executor_.status().reason, "on the ground");
  want(common::LandIntent{});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kSucceeded);
}

TEST_F(ExecutorStory, OnTheGroundNothingIsFlown) {
  want(to(6.0, 2.0));
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot fly to a goal while powered off");
  want(common::ExploreIntent{});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot explore while powered off");
}

// ------------------------------------------------------------------------------------------------------------- goals

class ExecutorToGoal : public ExecutorInFlight {
 protected:
  /// Another wall, at x = 4 m.
  void build(bool open) {
    fill(grid_, {{80, 0}, {81, 80}}, kWallCell);
    if (open) fill(grid_, kDoor, kFreeCell);
  }
  long detours() const { return timesSaid("goes nearer to look") + timesSaid("goes aside to make room"); }
};

TEST_F(ExecutorToGoal, TheGoalIsFlownToThroughTheDoor) {
  build(true);
  want(to(6.0, 3.2));
  run(0.5);
  EXPECT_TRUE(controller_.followsPath());
  EXPECT_FALSE(executor_.status().released);
  EXPECT_GT(executor_.wishedVelocity_map_m_s().x(), 0.5);
  EXPECT_EQ(executor_.goal_map_m(), Eigen::Vector2d(6.0, 3.2));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "reached (6.00, 3.20)");
  EXPECT_LT(distanceTo_m({6.0, 3.2}), 0.05);
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
}

TEST_F(ExecutorToGoal, ReachedMeansNearAndSlowForAWhile) {
  follows_ = false;
  want(to(2.0, 2.0));
  const auto stillRuns = [this](double seconds) {
    run(seconds);
    return executor_.status().state == IntentState::kRunning;
  };
  place(2.0, 2.0);
  state_.velocity_odom_m_s = {0.2, 0.0, 0.0};
  EXPECT_TRUE(stillRuns(1.0)) << "too fast";
  place(2.0, 2.06);
  EXPECT_TRUE(stillRuns(1.0)) << "too far";
  place(2.0, 2.0);
  state_.T_odom_body.position_m.z() = kHeight_m + 0.15;
  EXPECT_TRUE(stillRuns(1.0)) << "too high";
  state_.T_odom_body.position_m.z() = kHeight_m;
  EXPECT_TRUE(stillRuns(0.2)) << "too short";
  place(2.0, 2.06);
  EXPECT_TRUE(stillRuns(0.1));
  place(2.0, 2.0);
  EXPECT_TRUE(stillRuns(0.2)) << "the time counts from when it came back";
  EXPECT_FALSE(stillRuns(0.2));
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
}

TEST_F(ExecutorToGoal, AWayIsWaitedForAndADetourGoesToLook) {
  build(false);
  want(to(6.0, 2.0));
  run(2.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_THAT(executor_.status().reason, StartsWith("waiting: goal (6.00, 2.00) is unreachable"));
  EXPECT_EQ(timesSaid("no way to the goal at present"), 1);
  EXPECT_EQ(detours(), 0);
  EXPECT_LT(distanceTo_m({1.5, 2.0}), 0.05) << "meanwhile it stays";
  run(1.0);
  EXPECT_EQ(timesSaid("goes nearer to look"), 1);
  run(3.0);
  EXPECT_NEAR(position_m().x(), 4.0 - 0.375, 0.2);
  run(3.0);
  EXPECT_EQ(detours(), 2) << "having looked, it makes room";
  fill(grid_, kDoor, kFreeCell);
  run(1.4);
  ASSERT_FALSE(executor_.remainingPlan_map_m().empty());
  EXPECT_EQ(executor_.remainingPlan_map_m().back(), Eigen::Vector2d(6.0, 2.0)) << "asked for on the detour too";
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(ExecutorToGoal, RoomIsMadeForWhoStandsInTheDoor) {
  build(true);
  discs_ = {{{4.0, 2.0}, 0.5}};
  want(to(6.0, 2.0));
  runUntil([this] { return detours() > 0; }, 5.0);
  EXPECT_EQ(timesSaid("goes aside to make room"), 1);
  discs_.clear();
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(ExecutorToGoal, WithoutAWayItFailsInTheEndWithThePlannersWords) {
  build(false);
  want(to(6.0, 2.0));
  EXPECT_NEAR(runUntil([this] { return ended(); }, 30.0), 12.1, 0.3);
  EXPECT_EQ(executor_.status().state, IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "goal (6.00, 2.00) is unreachable at clearance 0.10 m");
  EXPECT_FALSE(controller_.followsPath());
}

TEST_F(ExecutorToGoal, ForAGoalNeverSeenItWaitsNoLongerThanAMapTakesToGrow) {
  want(to(8.5, 2.0));
  EXPECT_NEAR(runUntil([this] { return ended(); }, 30.0), 2.1, 0.3);
  EXPECT_EQ(executor_.status().state, IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, HasSubstr("space never seen"));
  EXPECT_EQ(detours(), 0);
}

TEST_F(ExecutorToGoal, APlanThatBecameBlockedIsGivenUpAndTheVehicleHolds) {
  build(true);
  want(to(6.0, 2.0));
  runUntil([this] { return position_m().x() > 2.0; }, 10.0);
  ASSERT_TRUE(controller_.followsPath());
  fill(grid_, kDoor, kWallCell);
  EXPECT_LT(runUntil([this] { return timesSaid("plan given up") > 0; }, 5.0), 0.5);
  EXPECT_THAT(reasonOf("plan given up"), StartsWith("blocked before"));
  EXPECT_FALSE(controller_.followsPath());
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
  run(1.5);
  EXPECT_TRUE(controller_.stopped());
  EXPECT_LT(position_m().x(), 4.0 - 0.375);
  fill(grid_, kDoor, kFreeCell);
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(timesSaid("plan given up"), 1);
}

TEST_F(ExecutorToGoal, APathLostWithTheEstimateIsSentAgain) {
  want(to(6.5, 2.0));
  run(1.0);
  ASSERT_TRUE(controller_.followsPath());
  state_.horizontal_valid = false;
  run(0.03);
  ASSERT_FALSE(controller_.followsPath()) << "the controller holds";
  state_.horizontal_valid = true;
  run(0.5);
  EXPECT_TRUE(controller_.followsPath());
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

/// The controller forgets it when the estimate is back: it starts from where it is then.
TEST_F(ExecutorToGoal, APathSentWhileTheEstimateIsLostIsSentAgain) {
  want(to(6.5, 2.0));
  run(1.0);
  state_.horizontal_valid = false;
  run(0.5);
  state_.horizontal_valid = true;
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(ExecutorStory, WhatAGoalIsRefusedFor) {
  EXPECT_EQ(executor_.refusalOfGoal({6.0, 2.0}), "there is no map yet");
  fill(grid_, {{80, 0}, {81, 80}}, kWallCell);
  run(0.5);
  EXPECT_EQ(executor_.refusalOfGoal({6.0, 2.0}), std::nullopt) << "a way there is not asked for";
  EXPECT_EQ(executor_.refusalOfGoal({NAN, 2.0}), "the goal is not a place");
  EXPECT_EQ(executor_.refusalOfGoal({90.0, 2.0}), "(90.00, 2.00) is outside the map");
  EXPECT_EQ(executor_.refusalOfGoal({8.5, 2.0}), "(8.50, 2.00) is not explored yet");
  EXPECT_EQ(executor_.refusalOfGoal({4.02, 2.0}), "(4.02, 2.00) is in an obstacle");
  EXPECT_EQ(executor_.refusalOfGoal({3.8, 2.0}), "(3.80, 2.00) is nearer to an obstacle than the hull and 0.10 m");
}

// ---------------------------------------------------------------------------------------------------------- retreats

class ExecutorRetreating : public ExecutorToGoal {
 protected:
  /// Half way to a goal to the left of where it took off.
  void SetUp() override {
    ExecutorInFlight::SetUp();
    want(to(1.5, 3.4));
    runUntil([this] { return position_m().y() > 2.6; }, 10.0);
    yaw_rad_ = state_.T_map_body_planar().yaw_rad;
    decision_.retreat_velocity_level_m_s = Eigen::Vector2d(-0.5, 0.0);
    decision_.retreat_acceleration_m_s2 = 2.0;
    decision_.turn_rad = 0.4;
    decision_.status.reason = "somebody comes";
    executor_.react(decision_, state_);
  }
  /// It has turned back by then; the retreat is behind where it faced when that began.
  void expectRetreat() {
    run(1.5);
    const Eigen::Vector2d from_m = position_m();
    run(1.0);
    const Eigen::Vector2d path_length_m = Eigen::Rotation2Dd(-yaw_rad_) * (position_m() - from_m);
    EXPECT_LT((path_length_m - Eigen::Vector2d(-0.5, 0.0)).norm(), 0.02) << path_length_m.transpose();
    EXPECT_NEAR(state_.T_map_body_planar().yaw_rad, yaw_rad_ + 0.4, 0.02);
    EXPECT_FALSE(controller_.followsPath());
    EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
    EXPECT_FALSE(executor_.status().released);
  }
  void calm() {
    decision_ = {};
    decision_.speed_limit_m_s = 1.0;
    executor_.react(decision_, state_);
  }
  double yaw_rad_ = 0.0;
};

TEST_F(ExecutorRetreating, ComesBeforeTheGoalUntilItIsOver) {
  expectRetreat();
  calm();
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << "the goal is still wanted";
}

TEST_F(ExecutorRetreating, GoesOnUnderTheIntentToAvoidAndTheNextIntentWorks) {
  want(common::AvoidIntent{});
  expectRetreat();
  EXPECT_EQ(executor_.status().reason, "somebody comes");
  decision_.retreat_velocity_level_m_s = Eigen::Vector2d::Zero();
  executor_.react(decision_, state_);
  run(1.5);
  EXPECT_FALSE(executor_.status().released) << "it stands, but is not its own yet";
  calm();
  run(1.5);
  EXPECT_TRUE(executor_.status().released) << "it has stopped";
  want(to(1.5, 3.4));
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
}

TEST_F(ExecutorRetreating, EndsWithALanding) {
  want(common::LandIntent{});
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  calm();
  run(0.5);
  EXPECT_TRUE(executor_.status().released);
}

}  // namespace
}  // namespace swiftlet::autonomy
