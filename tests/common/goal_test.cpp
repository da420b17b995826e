// The one rule of goals: each reason to refuse a goal, and what the tolerance permits.
#include "common/goal.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

using Reason = GoalRefusal::Reason;
using Point = Eigen::Vector2d;

/// Free floor from x = 0 to 10 m; from 10 to 10.4 m too close to the obstacle, which extends to 11 m; unknown behind
/// it, and at 12 m the map ends.
class Corridor final : public GoalMap {
 public:
  PlaceState stateAt(const Point& p, double) const override {
    if (p.x() < 0.0 || p.x() > 12.0) return PlaceState::kOutsideMap;
    if (p.x() > 11.0) return PlaceState::kUnseen;
    if (p.x() > 10.4) return PlaceState::kObstacle;
    return p.x() > 10.0 ? PlaceState::kTooClose : PlaceState::kFree;
  }
  std::optional<Point> nearestFree(const Point& p, double reach_m, double) const override {
    const Point free(std::clamp(p.x(), 0.0, 10.0), p.y());
    return (free - p).norm() <= reach_m ? std::optional(free) : std::nullopt;
  }
};

struct GoalRule : testing::Test {
  tl::expected<Point, GoalRefusal> judge(double x_m, double tolerance_m = 0.05) const {
    return judgeGoal({{x_m, 1.0}, std::nullopt, tolerance_m, 0.10}, {}, &map);
  }
  Corridor map;
};

TEST_F(GoalRule, AFreeGoalIsAccepted) { EXPECT_EQ(judge(9.0), Point(9.0, 1.0)); }

TEST_F(GoalRule, AGoalThatIsNotAPointIsRefused) {
  for (const double x_m : {std::nan(""), HUGE_VAL, 1e300, -2e5}) {
    const auto verdict = judge(x_m);
    ASSERT_FALSE(verdict) << x_m;
    EXPECT_EQ(verdict.error().reason, Reason::kNoPlace);
    EXPECT_EQ(verdict.error().text, "the goal is not a point of the map");
  }
}

TEST_F(GoalRule, AGoalOutsideTheMapIsRefused) {
  const auto verdict = judge(20.0);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().reason, Reason::kOutsideMap);
  EXPECT_EQ(verdict.error().text, "goal (20.00, 1.00) is outside the map");
  EXPECT_FALSE(verdict.error().nearest_free_map_m) << "more than 3 m off";
}

TEST_F(GoalRule, AGoalInSpaceNeverSeenIsRefused) {
  const auto verdict = judge(11.5);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().reason, Reason::kUnseen);
  EXPECT_EQ(verdict.error().text,
            "goal (11.50, 1.00) is in space never seen at clearance 0.10 m, the nearest free place is (10.00, 1.00)");
}

TEST_F(GoalRule, AGoalInAnObstacleIsRefused) {
  const auto verdict = judge(10.7);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().reason, Reason::kObstacle);
  EXPECT_EQ(verdict.error().nearest_free_map_m, Point(10.0, 1.0));
}

TEST_F(GoalRule, AGoalTooCloseToAnObstacleIsRefused) {
  const auto verdict = judge(10.2);
  ASSERT_FALSE(verdict);
  EXPECT_EQ(verdict.error().reason, Reason::kTooClose);
  EXPECT_EQ(verdict.error().text,
            "goal (10.20, 1.00) is too close to an obstacle or to unknown space at clearance 0.10 m, the nearest free "
            "place is (10.00, 1.00)");
}

TEST_F(GoalRule, AFreePlaceWellWithinTheToleranceReplacesTheGoal) {
  EXPECT_EQ(judge(10.2, 0.26), Point(10.0, 1.0));
  EXPECT_FALSE(judge(10.2, 0.24)) << "a fifth of the tolerance is left to the controller";
}

TEST_F(GoalRule, AGivenHeightMustBeWithinItsLimits) {
  const GoalLimits limits{.greatest_height_m = 3.0};
  const auto at = [&](double height_m) { return judgeGoal({{1.0, 1.0}, height_m, 0.05, 0.1}, limits, nullptr); };
  EXPECT_TRUE(at(0.3));
  EXPECT_TRUE(at(3.0));
  for (const double height_m : {0.29, 3.1, -1.0, std::nan(""), HUGE_VAL}) {
    ASSERT_FALSE(at(height_m)) << height_m;
    EXPECT_EQ(at(height_m).error().reason, Reason::kHeight);
  }
  EXPECT_EQ(at(3.5).error().text, "3.5 m is above the greatest height, 3 m");
  EXPECT_EQ(at(0.1).error().text, "0.1 m is below the least height, 0.3 m");
}

TEST_F(GoalRule, OnlyTheNumbersAreJudgedWithoutAMap) {
  EXPECT_EQ(judgeGoal({{20.0, 1.0}, std::nullopt, 0.0, 0.1}, {}, nullptr), Point(20.0, 1.0));
}

TEST(GoalOf, CopiesTheValuesOfTheIntent) {
  GoToIntent intent;
  intent.goal_map_m = {3.0, 4.0};
  intent.height_m = 1.5;
  intent.tolerance_m = 0.2;
  intent.clearance_m = 0.3;
  const Goal goal = goalOf(intent);
  EXPECT_EQ(goal.place_map_m, Point(3.0, 4.0));
  EXPECT_EQ(goal.height_m, 1.5);
  EXPECT_EQ(goal.tolerance_m, 0.2);
  EXPECT_EQ(goal.clearance_m, 0.3);
}

}  // namespace
}  // namespace swiftlet::common
