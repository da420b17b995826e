// Explore: viewpoints, looks, what is left, and people who block the path.
#include <algorithm>
#include <numbers>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kFreeCell;
using planning::test::kWallCell;

TEST_F(ManeuverStory, ExploreFailsOnTheGround) {
  want(common::ExploreIntent{});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot explore while powered off");
}

class ExploreManeuver : public ManeuverInFlight {
 protected:
  using ManeuverInFlight::ManeuverInFlight;
  /// The vehicle takes off facing away from the unexplored area.
  void SetUp() override {
    place(1.5, 2.0, std::numbers::pi);
    ManeuverInFlight::SetUp();
  }
  /// A room of 5 m by 4 m. What is behind its door, if it has one, is unknown.
  void build(bool door) {
    grid_ = planning::test::room(100, 80);
    if (door) fill(grid_, {{100, 28}, {101, 52}}, kFreeCell);
  }
  /// The room with a passage that turns: its end is visible from inside only, and a person in it blocks it.
  void buildPassage() {
    build(false);
    fill(grid_, {{100, 27}, {132, 49}}, kWallCell);
    fill(grid_, {{109, 49}, {132, 90}}, kWallCell);
    fill(grid_, {{100, 28}, {131, 48}}, kFreeCell);
    fill(grid_, {{110, 48}, {131, 89}}, kFreeCell);
    fill(grid_, {{109, 70}, {110, 89}}, common::occupancy::kUnknown);
  }
  common::Disc personInThePassage() const { return {{5.4, 1.9}, 0.5}; }
  int looks() const {
    int most = 0;
    for (const common::Frontier& frontier : *executor_.desk().frontiers()) most = std::max(most, frontier.attempts);
    return most;
  }
};

TEST_F(ExploreManeuver, AViewpointCountsAfterHalfASecondThere) {
  build(true);
  want(common::ExploreIntent{});
  runUntil([this] { return looks() == 1 && executor_.aim().goal_map_m; },
           5.0);     // The door is visible from the take-off place.
  follows_ = false;  // The reference flies on alone; the vehicle stays where the test puts it.
  ASSERT_GT(distanceTo_m(*executor_.aim().goal_map_m), 1.0);
  run(0.1);
  EXPECT_TRUE(controller_.follower().followsPath());
  runUntil([this] { return controller_.follower().finished(); }, 15.0);
  const common::Pose2 there = reference();
  EXPECT_LT((there.position_m() - *executor_.aim().goal_map_m).norm(), 0.01);
  run(1.0);
  EXPECT_EQ(looks(), 1) << "the vehicle is not there";
  place(there.x_m, there.y_m, there.yaw_rad);
  run(0.4);
  place(there.x_m, there.y_m, there.yaw_rad + 0.4);
  run(0.4);
  place(there.x_m, there.y_m, there.yaw_rad);
  run(0.45);
  EXPECT_EQ(looks(), 1) << "it turned away in between";
  run(0.25);
  EXPECT_EQ(looks(), 2);
}

TEST_F(ExploreManeuver, GivesUpAFrontierAfterThreeLooksAndReportsTheReason) {
  build(true);
  fill(grid_, {{20, 80}, {23, 81}}, kFreeCell);  // A crack.
  want(common::ExploreIntent{});
  ASSERT_EQ(runToTheEnd(60.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(looks(), 3);
  EXPECT_EQ(executor_.status().reason, "explored 20.1 m2, 2 frontiers left, each with a reason");
  EXPECT_EQ(reasonOf("frontier of 1.20 m"), "blacklisted: looked at 3 times");
  EXPECT_EQ(reasonOf("frontier of 0.15 m"), "too small: 0.15 m long");
}

/// The default, another planner and another explorer. The counters show which of them did the work.
class ExploreChoices : public ExploreManeuver, public testing::WithParamInterface<std::tuple<Choices, PlanningUse>> {
 protected:
  ExploreChoices() : ExploreManeuver(std::get<Choices>(GetParam())) {}
};

TEST_P(ExploreChoices, UsesTheChosenExplorerAndPlanner) {
  const PlanningUse& expected = std::get<PlanningUse>(GetParam());
  build(true);
  want(common::ExploreIntent{});
  ASSERT_EQ(runToTheEnd(60.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(looks(), 3);
  const PlanningUse& use = executor_.desk().use();
  EXPECT_EQ(use.explorer, expected.explorer);
  EXPECT_GE(use.viewpoints, 3) << "one a look";
  EXPECT_EQ(use.planner, expected.planner);
  EXPECT_GE(use.paths, use.viewpoints) << "every leg is planned, and replanned while it is flown";
}

INSTANTIATE_TEST_SUITE_P(
    Chosen, ExploreChoices,
    testing::Values(std::tuple{Choices{}, PlanningUse{"D* Lite", 0, "utility", 0}},
                    std::tuple{Choices{planning::PlannerKind::kWavefront}, PlanningUse{"wavefront", 0, "utility", 0}},
                    std::tuple{Choices{planning::PlannerKind::kDStarLite, planning::ExplorerKind::kNearestFrontier},
                               PlanningUse{"D* Lite", 0, "nearest frontier", 0}}));

TEST_F(ExploreManeuver, EndsWhenTheExplorerReportsDoneTwiceAtRest) {
  build(false);
  want(common::ExploreIntent{});
  runUntil([this] { return executor_.desk().exploredArea_m2() > 0.0; }, 1.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning) << "said once";
  EXPECT_EQ(runToTheEnd(2.0), IntentState::kSucceeded);
  follows_ = false;
  state_.velocity_odom_m_s = {0.2, 0.0, 0.0};
  want(common::ExploreIntent{});
  run(3.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning) << "it moves";
  state_.velocity_odom_m_s.setZero();
  EXPECT_EQ(runToTheEnd(2.0), IntentState::kSucceeded);
}

TEST_F(ExploreManeuver, WaitsForAPersonWhoBlocksTheWayAndGoesOn) {
  buildPassage();
  discs_ = {personInThePassage()};
  want(common::ExploreIntent{});
  run(2.0);
  EXPECT_EQ(executor_.status().reason.substr(0, 45), "waiting: incomplete, 1 blocked by a person at");
  EXPECT_EQ(timesSaid("moves aside to make room"), 0);
  run(100.0);
  EXPECT_EQ(timesSaid("moves aside to make room"), 1) << "it does not shuttle";
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  discs_.clear();
  runUntil([this] { return distanceTo_m({6.0, 2.0}) < 0.6; }, 20.0);
  EXPECT_LT(distanceTo_m({6.0, 2.0}), 0.6) << "the path is free: " << executor_.status().reason;
}

TEST_F(ExploreManeuver, WhatIsBlockedWhenTheChargeIsNeededIsIncomplete) {
  buildPassage();
  discs_ = {personInThePassage()};
  want(common::ExploreIntent{});
  run(60.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  spare_s_ = 0.0;
  EXPECT_EQ(runToTheEnd(1.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason.substr(0, 36), "incomplete, 1 blocked by a person at");
}

TEST_F(ExploreManeuver, WhatIsBehindSomebodyIsBlockedAndNotUnreachable) {
  buildPassage();
  discs_ = {personInThePassage()};
  want(common::ExploreIntent{});
  run(2.0);
  const auto blocked = [this] {
    const auto& frontiers = *executor_.desk().frontiers();
    return std::count_if(frontiers.begin(), frontiers.end(), [](const common::Frontier& frontier) {
      return frontier.reason == common::FrontierReason::kBlocked;
    });
  };
  EXPECT_EQ(blocked(), 1);
  spare_s_ = 0.0;
  EXPECT_EQ(runToTheEnd(30.0), IntentState::kFailed);
  EXPECT_EQ(timesSaid("frontier of 0.95 m at"), 1);
  EXPECT_EQ(reasonOf("frontier of 0.95 m at").substr(0, 21), "blocked: a person at ");
}

/// He stands in a door, and three looks past him show nothing more of what is behind it.
TEST_F(ExploreManeuver, LooksPastSomebodyCountNoLongerOnceHeHasGone) {
  build(true);
  people_ = {{1, {5.0, 2.0}, 0.25, {0.3, 0.0}, true, {}}};
  discs_ = {{{5.0, 2.0}, 0.5}};
  want(common::ExploreIntent{});
  runUntil([this] { return executor_.status().reason.starts_with("waiting: incomplete"); }, 90.0);
  ASSERT_THAT(executor_.status().reason, testing::HasSubstr(" blocked by a person at (5.00, 2.00)"));
  run(20.0);
  people_.clear();
  discs_.clear();
  const int viewpoints = executor_.desk().use().viewpoints;
  EXPECT_EQ(runToTheEnd(120.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_GE(executor_.desk().use().viewpoints, viewpoints + 3);
}

/// Free space is seen behind a slit in the wall, and not all of it. While it looks there, a door is opened elsewhere.
TEST_F(ExploreManeuver, LooksBehindAGapOnceThoughMoreOpensMeanwhile) {
  build(false);
  fill(grid_, {{100, 24}, {117, 48}}, kWallCell);
  fill(grid_, {{101, 25}, {116, 47}}, kFreeCell);
  fill(grid_, {{112, 25}, {116, 47}}, common::occupancy::kUnknown);
  fill(grid_, {{100, 33}, {101, 39}}, kFreeCell);
  want(common::ExploreIntent{});
  runUntil([this] { return timesSaid("looks once more at what is behind a gap") == 1; }, 60.0);
  ASSERT_EQ(timesSaid("looks once more at what is behind a gap"), 1) << executor_.status().reason;
  fill(grid_, {{20, 80}, {44, 81}}, kFreeCell);
  EXPECT_EQ(runToTheEnd(80.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_EQ(timesSaid("looks once more at what is behind a gap"), 1);
}

TEST_F(ExploreManeuver, RemembersFruitlessLooksAfterAnInterruption) {
  build(true);
  want(common::ExploreIntent{});
  runUntil([this] { return looks() == 2; }, 30.0);
  ASSERT_EQ(looks(), 2);
  want(common::HoldIntent{});
  run(1.0);
  want(common::ExploreIntent{});
  run(0.5);
  EXPECT_EQ(looks(), 2);
  EXPECT_EQ(runToTheEnd(60.0), IntentState::kSucceeded);
  EXPECT_EQ(looks(), 3) << "one more look, not three";
}

TEST_F(ExploreManeuver, ContinuesAfterARetreat) {
  build(true);
  want(common::ExploreIntent{});
  runUntil([this] { return looks() == 1 && executor_.aim().goal_map_m; }, 5.0);
  const Eigen::Vector2d viewpoint_m = *executor_.aim().goal_map_m;
  retreat({-0.3, 0.0});
  run(2.0);
  EXPECT_GT(distanceTo_m({1.5, 2.0}), 0.4);
  calm();
  runUntil([&] { return distanceTo_m(viewpoint_m) < 0.15; }, 10.0);
  EXPECT_LT(distanceTo_m(viewpoint_m), 0.15) << executor_.status().reason;
}

}  // namespace
}  // namespace swiftlet::autonomy
