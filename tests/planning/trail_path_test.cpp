// The path along a person's trail: straight where that is free, round what the person walked round, beside a wall that
// the person walked close to, and as far as it leads.
#include "planning/pursuit/trail_path.hpp"

#include <gtest/gtest.h>

#include "planning/search/planner.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

/// A free hall of 10 x 10 m.
class Trail : public testing::Test {
 protected:
  Trail() { test::fill(grid_, {{0, 0}, {199, 199}}, test::kFreeCell); }
  void wall(const common::CellRect& cells) { test::fill(grid_, cells, test::kWallCell); }
  Path along(const Point& from, const std::vector<Point>& trail) {
    const CostMap costs = test::mapOf(grid_);
    return trailPath(costs, from, trail.back(), trail);
  }
  static void walk(std::vector<Point>& trail, const Point& to) {
    const Point from = trail.back();
    const int steps = static_cast<int>((to - from).norm() / 0.2);
    for (int i = 1; i <= steps; ++i) trail.push_back(from + (to - from) * i / steps);
  }

  common::OccupancyGrid grid_ = common::makeOccupancyGrid(0.05);
};

TEST_F(Trail, IsAStraightLineInTheOpenAndEndsAtItsDistance) {
  std::vector<Point> trail{{3.0, 5.0}};
  walk(trail, {5.0, 6.0});
  walk(trail, {7.0, 5.0});
  const Path path = along({2.0, 5.0}, trail);
  ASSERT_EQ(path.points_map_m.size(), 2u);
  EXPECT_EQ(path.points_map_m.front(), Point(2.0, 5.0));
  EXPECT_LT((path.points_map_m.back() - Point(6.0, 5.0)).norm(), 1e-6);
  EXPECT_NEAR(path.length_m, 4.0, 1e-6);
}

TEST_F(Trail, LeadsRoundWhatThePersonWalkedRound) {
  wall({{80, 80}, {120, 199}});
  std::vector<Point> trail{{3.0, 6.0}};
  walk(trail, {3.0, 3.2});
  walk(trail, {7.0, 3.2});
  walk(trail, {7.0, 6.0});
  const Path path = along({2.5, 6.5}, trail);
  EXPECT_NEAR((path.points_map_m.back() - trail.back()).norm(), 1.0, 1e-6);
  const CostMap costs = test::mapOf(grid_);
  for (std::size_t i = 1; i < path.points_map_m.size(); ++i)
    EXPECT_FALSE(segmentCost(costs, path.points_map_m[i - 1], path.points_map_m[i]).lethal);
  EXPECT_LT(path.length_m, 9.0) << "it cuts corners short";
}

TEST_F(Trail, PassesBesideAWallThatThePersonWalkedCloseTo) {
  wall({{0, 110}, {199, 199}});
  std::vector<Point> trail{{2.0, 5.25}};  // 0.25 m from the wall.
  walk(trail, {8.0, 5.25});
  const Path path = along({2.0, 5.0}, trail);
  ASSERT_GT(path.points_map_m.size(), 1u);
  EXPECT_GT(path.points_map_m.back().x(), 6.8);
  EXPECT_LT(path.points_map_m.back().y(), 5.5 - 0.37) << "the hull with its clearance";
}

TEST_F(Trail, LeadsAsFarAsItIsFree) {
  wall({{100, 0}, {102, 199}});
  std::vector<Point> trail{{3.0, 5.0}};
  walk(trail, {8.0, 5.0});
  const Path path = along({2.0, 5.0}, trail);
  EXPECT_GT(path.points_map_m.back().x(), 4.2);
  EXPECT_LT(path.points_map_m.back().x(), 5.0 - 0.34) << "the hull with its clearance, by the cell";
}

TEST_F(Trail, IsToStayWhereThePersonIsNear) {
  EXPECT_EQ(along({4.2, 5.0}, {{4.0, 5.0}, {5.0, 5.0}}).points_map_m.size(), 1u);
}

TEST_F(Trail, LeavesTheZoneOfAWallFirst) {
  wall({{50, 0}, {55, 199}});
  const Path path = along({3.0, 5.0}, {{5.0, 5.0}, {6.5, 5.0}});
  ASSERT_GT(path.points_map_m.size(), 2u) << "cell by cell, as the planners do";
  EXPECT_NEAR(path.points_map_m.back().x(), 5.5, 0.1);
}

}  // namespace
}  // namespace swiftlet::planning
