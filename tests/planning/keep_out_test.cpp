// Keep-out zones: costs, goals and paths keep the hull outside, and the reactive layer brakes before their edge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "avoidance_story.hpp"
#include "common/goal.hpp"
#include "grid_builder.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::planning {
namespace {

using testing::HasSubstr;

/// In the middle of a room of 8 m by 4 m, away from its walls.
const common::Polygon kZone{{{3.0, 1.2}, {5.0, 1.2}, {5.0, 2.8}, {3.0, 2.8}}};

class KeepOut : public testing::Test {
 protected:
  KeepOut() {
    layers_.keep_out = {&kZone, 1};
    map_ = test::mapOf(grid_, {}, {}, layers_);
  }
  common::OccupancyGrid grid_ = test::room(160, 80);
  CostLayers layers_;
  CostMap map_{{}, 0.05};
};

TEST_F(KeepOut, TheHullAndItsClearanceStayOutside) {
  const double radius_m = map_.footprint().radius_m();
  for (int i = 0; i < static_cast<int>(map_.costs().size()); ++i) {
    const double outside_m = kZone.signedDistance_m(map_.centerOf(map_.cellOf(i))) - radius_m;
    EXPECT_EQ(map_.isKeptOut(i), outside_m < 0.0);
    EXPECT_TRUE(map_.isLethal(i) || outside_m >= 0.0);
  }
  EXPECT_FALSE(map_.isLethal(map_.indexOf(map_.cellAt({1.0, 2.0}))));
}

TEST_F(KeepOut, ATrailThroughAZoneDoesNotOpenIt) {
  const std::vector<Eigen::Vector2d> flown{{2.0, 2.0}, {2.9, 2.0}, {3.8, 2.0}, {4.7, 2.0}, {5.6, 2.0}};
  layers_.flown_map_m = flown;
  map_ = test::mapOf(grid_, {}, {}, layers_);
  EXPECT_TRUE(map_.isLethal(map_.indexOf(map_.cellAt({3.8, 2.0}))));
}

TEST_F(KeepOut, AGoalInsideIsRefusedWithThatReasonHoweverLooseItsTolerance) {
  const CostGoalMap goals(map_);
  for (const double tolerance_m : {0.05, 3.0}) {
    const auto verdict = common::judgeGoal({{3.1, 2.0}, std::nullopt, tolerance_m, 0.10}, {}, &goals);
    ASSERT_FALSE(verdict);
    EXPECT_EQ(verdict.error().reason, common::GoalRefusal::Reason::kKeptOut);
    EXPECT_THAT(verdict.error().text, HasSubstr("goal (3.10, 2.00) is in a keep-out zone, the nearest free place is"));
  }
  EXPECT_EQ(goals.stateAt({3.1, 2.0}, 0.0), common::PlaceState::kKeptOut) << "also with less clearance";
}

TEST_F(KeepOut, APathLeadsAround) {
  DStarLite planner;
  const auto path = planner.plan(map_, {1.0, 2.0}, {7.0, 2.0});
  ASSERT_TRUE(path);
  EXPECT_GT(path->length_m, 6.3);
  for (std::size_t i = 1; i < path->points_map_m.size(); ++i)
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      const Eigen::Vector2d point =
          path->points_map_m[i - 1] + share * (path->points_map_m[i] - path->points_map_m[i - 1]);
      EXPECT_GT(kZone.signedDistance_m(point), 0.30) << point.transpose();
    }
}

TEST_F(KeepOut, FromItsMiddleAPathLeadsOut) {
  // 1.15 m from everywhere that the centre may be.
  DStarLite planner;
  const auto path = planner.plan(map_, {4.0, 2.0}, {7.0, 2.0});
  ASSERT_TRUE(path) << path.error().text;
  EXPECT_LT(path->length_m, 5.0);
  // A zone from wall to wall, 4 m long: across it there is no other way out than along the room.
  const common::Polygon wide{{{2.0, -1.0}, {6.0, -1.0}, {6.0, 5.0}, {2.0, 5.0}}};
  layers_.keep_out = {&wide, 1};
  map_ = test::mapOf(grid_, {}, {}, layers_);
  const auto along = planner.plan(map_, {4.0, 0.7}, {7.0, 2.0});
  ASSERT_TRUE(along) << along.error().text;
  for (const Eigen::Vector2d& point : along->points_map_m)
    EXPECT_GE(map_.clearance().at_m(map_.cellAt(point), Against::kObstacles), map_.footprint().radius_m() - 0.05)
        << point.transpose();
}

TEST_F(KeepOut, AZoneThatGoesLeavesNothingBehind) {
  map_.update(grid_.snapshot(), {}, {});
  EXPECT_EQ(map_.costs(), test::mapOf(grid_).costs());
  EXPECT_FALSE(map_.isKeptOut(map_.indexOf(map_.cellAt({4.0, 2.0}))));
}

TEST(KeepOutAvoidance, BrakesBeforeTheEdgeAndNeverRetreatsFromIt) {
  test::Story story;
  for (double y_m = 1.0; y_m < 7.0; y_m += 0.05) story.keep_out_map_m.push_back({7.0, y_m});
  for (int i = 0; i < 600; ++i) story.tick({1.5, 0});
  EXPECT_LT(story.velocity_map_m_s.norm(), 0.02);
  EXPECT_GT(7.0 - story.pose.x_m - test::kHull_m, 0.02);
  EXPECT_LT(7.0 - story.pose.x_m - test::kHull_m, 0.15);
  EXPECT_EQ(story.retreats, 0);
  EXPECT_GT(story.sense({0.0, 0.0}).status.nearest_m, 1.0) << "what is shown are obstacles";
}

TEST(KeepOutAvoidance, ARetreatFromAPersonDoesNotLeadAcrossTheEdge) {
  test::Story story;
  for (double y_m = 1.0; y_m < 7.0; y_m += 0.05) story.keep_out_map_m.push_back({4.4, y_m});
  story.people.push_back({{8.5, 4.0}, {-0.8, 0.0}});
  for (int i = 0; i < 120; ++i) story.tick({0, 0});
  EXPECT_GE(story.retreats, 1);
  EXPECT_GT(story.pose.x_m - 4.4, test::kHull_m - 0.02);
  EXPECT_GT(std::abs(story.pose.y_m - 4.0), 0.2) << "aside instead";
}

}  // namespace
}  // namespace swiftlet::planning
