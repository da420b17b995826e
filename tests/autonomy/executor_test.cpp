// The executor carries out one intent at a time, and the retreat before all of them.
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using ExecutorInFlight = ManeuverInFlight;

TEST_F(ManeuverStory, HoldsBeforeTheFirstIntent) {
  EXPECT_EQ(executor_.status().id, 0U);
  run(0.5);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_EQ(executor_.status().reason, "holding");
  EXPECT_TRUE(executor_.status().released);
  EXPECT_TRUE(executor_.desk().costMap()) << "the cost map is refreshed without a request for a path";
}

TEST_F(ExecutorInFlight, TheSameIntentContinuesAndANewIntentRestarts) {
  want(to(6.0, 2.0));
  run(1.0);
  ASSERT_TRUE(controller_.follower().followsPath());
  want(to(6.0, 2.0));
  run(0.01);
  run(0.04);
  EXPECT_FALSE(controller_.follower().followsPath()) << "a new id stops the present path";
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty()) << "no plan outlives its intent";
  run(0.5);
  EXPECT_TRUE(controller_.follower().followsPath());
}

TEST_F(ExecutorInFlight, AnEndedIntentStaysEndedAndItsPlanIsDropped) {
  want(to(2.0, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
  EXPECT_FALSE(executor_.aim().goal_map_m);
  run(2.0);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
  EXPECT_EQ(timesSaid("go to (2.00, 2.00): done"), 1);
}

/// The job takes 60 ms: its answer comes when another intent is carried out.
TEST_F(ExecutorInFlight, ALateAnswerIsNotFlown) {
  want(to(6.0, 2.0));
  runUntil([this] { return !jobs_->idle("planning"); }, 1.0);
  want(common::HoldIntent{});
  run(1.0);
  EXPECT_FALSE(controller_.follower().followsPath());
  EXPECT_TRUE(controller_.stopped());
}

TEST_F(ExecutorInFlight, AFailedIntentLeavesTheVehicleHolding) {
  want(to(8.5, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kFailed);
  EXPECT_EQ(timesSaid("go to (8.50, 2.00): failed"), 1);
  run(2.0);
  EXPECT_TRUE(executor_.status().released);
}

// ---------------------------------------------------------------------------------------------------------- retreats

class ExecutorRetreating : public ManeuverInFlight {
 protected:
  /// The vehicle is halfway to a goal on the left of its take-off place when a retreat begins.
  void SetUp() override {
    ManeuverInFlight::SetUp();
    want(to(1.5, 3.4));
    runUntil([this] { return position_m().y() > 2.6; }, 10.0);
    yaw_rad_ = state_.T_map_body_planar().yaw_rad;
    retreat({-0.5, 0.0}, 0.4);
  }
  /// The vehicle has turned by then, but the retreat still goes backwards from its heading at the beginning.
  void expectRetreat() {
    run(1.5);
    const Eigen::Vector2d from_m = position_m();
    run(1.0);
    const Eigen::Vector2d moved_m = Eigen::Rotation2Dd(-yaw_rad_) * (position_m() - from_m);
    EXPECT_LT((moved_m - Eigen::Vector2d(-0.5, 0.0)).norm(), 0.02) << moved_m.transpose();
    EXPECT_NEAR(state_.T_map_body_planar().yaw_rad, yaw_rad_ + 0.4, 0.02);
    EXPECT_FALSE(controller_.follower().followsPath());
    EXPECT_TRUE(executor_.remainingPlan_map_m().empty());
    EXPECT_FALSE(executor_.status().released);
  }
  double yaw_rad_ = 0.0;
};

TEST_F(ExecutorRetreating, ARetreatInterruptsTheGoalUntilItIsOver) {
  expectRetreat();
  calm();
  EXPECT_EQ(runToTheEnd(15.0), IntentState::kSucceeded) << "the goal is still wanted";
}

TEST_F(ExecutorRetreating, ARetreatContinuesUnderEveryIntent) {
  want(common::HoldIntent{});
  expectRetreat();
  calm();
  run(1.5);
  EXPECT_TRUE(executor_.status().released) << "it has stopped";
}

TEST_F(ExecutorRetreating, ARetreatEndsInAHoldWhenNothingIsSeenAnyMore) {
  want(common::HoldIntent{});
  expectRetreat();
  executor_.endRetreat();
  run(1.5);
  EXPECT_TRUE(executor_.status().released) << "it has stopped";
}

TEST_F(ExecutorRetreating, ARetreatDropsThePlanAtOnce) {
  EXPECT_TRUE(executor_.remainingPlan_map_m().empty()) << "not only at the next tick";
  EXPECT_EQ(executor_.aim().velocity_map_m_s, Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace swiftlet::autonomy
