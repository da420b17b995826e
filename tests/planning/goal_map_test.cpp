// The cost map that judges goals: at its own clearance it agrees with the planner, at others the obstacles decide.
#include "planning/search/goal_map.hpp"

#include <gtest/gtest.h>

#include "planning/search/dstar_lite.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using common::PlaceState;
using Point = Eigen::Vector2d;

/// 8 m by 4 m, a wall of a cell at x = 4 m, hull 0.275 m, clearance 0.10 m.
struct GoalMapTest : testing::Test {
  GoalMapTest() { test::fill(grid, {{80, 0}, {81, 80}}, test::kWallCell); }
  common::OccupancyGrid grid = test::room(160, 80);
};

TEST_F(GoalMapTest, GivesTheStateOfAPlace) {
  const CostMap map = test::mapOf(grid);
  const CostGoalMap goals(map);
  EXPECT_EQ(goals.stateAt({2.0, 2.0}, 0.10), PlaceState::kFree);
  EXPECT_EQ(goals.stateAt({90.0, 2.0}, 0.10), PlaceState::kOutsideMap);
  EXPECT_EQ(goals.stateAt({8.5, 2.0}, 0.10), PlaceState::kUnseen);
  EXPECT_EQ(goals.stateAt({4.02, 2.0}, 0.10), PlaceState::kObstacle);
  EXPECT_EQ(goals.stateAt({3.8, 2.0}, 0.10), PlaceState::kTooClose);
}

TEST_F(GoalMapTest, AgreesWithThePlannerInEveryCell) {
  test::fill(grid, {{20, 20}, {30, 30}}, common::occupancy::kUnknown);
  const CostMap map = test::mapOf(grid);
  const CostGoalMap goals(map);
  DStarLite planner;
  for (double y_m = -0.5; y_m < 4.5; y_m += 0.13) {
    for (double x_m = -0.5; x_m < 8.5; x_m += 0.17) {
      const auto path = planner.plan(map, {5.5, 3.0}, {x_m, y_m});
      const bool refused = !path && path.error().reason != PlanFailure::Reason::kUnreachable;
      EXPECT_EQ(goals.stateAt({x_m, y_m}, 0.10) == PlaceState::kFree, !refused) << x_m << ", " << y_m;
    }
  }
}

/// A path is planned when the person has gone.
TEST_F(GoalMapTest, PeopleRefuseNoGoal) {
  const std::vector<common::Disc> people{{{6.5, 2.0}, 0.4}, {{4.5, 2.0}, 0.4}};
  const CostMap map = test::mapOf(grid, {}, {}, {.discs = people});
  const CostGoalMap goals(map);
  for (const double clearance_m : {0.05, 0.10, 0.20}) {
    EXPECT_EQ(goals.stateAt({6.5, 2.0}, clearance_m), PlaceState::kFree) << clearance_m;
    EXPECT_EQ(goals.stateAt({4.2, 2.0}, clearance_m), PlaceState::kTooClose) << "to the wall, too: " << clearance_m;
  }
}

TEST_F(GoalMapTest, JudgesOtherClearancesByTheObstacles) {
  const CostMap map = test::mapOf(grid);
  const CostGoalMap goals(map);
  EXPECT_EQ(goals.stateAt({3.5, 2.0}, 0.10), PlaceState::kFree);
  EXPECT_EQ(goals.stateAt({3.5, 2.0}, 0.40), PlaceState::kTooClose);
  EXPECT_EQ(goals.stateAt({3.7, 2.0}, 0.10), PlaceState::kTooClose);
  EXPECT_EQ(goals.stateAt({3.7, 2.0}, 0.0), PlaceState::kFree);
  EXPECT_EQ(goals.stateAt({8.2, 2.0}, 0.0), PlaceState::kUnseen) << "a smaller clearance opens no unseen space";
}

TEST_F(GoalMapTest, FindsTheNearestFreePlaceForTheClearance) {
  const CostMap map = test::mapOf(grid);
  const CostGoalMap goals(map);
  for (const double clearance_m : {0.0, 0.10, 0.30}) {
    const auto place = goals.nearestFree({3.9, 2.0}, 3.0, clearance_m);
    ASSERT_TRUE(place);
    EXPECT_NEAR(4.0 - place->x(), 0.275 + clearance_m, 0.06);
    EXPECT_NEAR(place->y(), 2.0, 0.05);  // Somewhere in a cell beside it.
  }
  EXPECT_FALSE(goals.nearestFree({90.0, 2.0}, 3.0, 0.10));
}

TEST_F(GoalMapTest, KeepsItsCostMapAlive) {
  EXPECT_EQ(goalMapOf(nullptr), nullptr);
  auto map = std::make_shared<const CostMap>(test::mapOf(grid));
  const auto goals = goalMapOf(map);
  map.reset();
  EXPECT_EQ(goals->stateAt({2.0, 2.0}, 0.10), PlaceState::kFree);
}

}  // namespace
}  // namespace swiftlet::planning
