// The way out of places where the planners may not start.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "grid_builder.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {
namespace {

/// The vehicle hovers between a slanted wall and a post, where its clearance hardly fits and its trail makes some cells
/// passable. Wherever it is, it gets out: to a place in the open behind the post.
TEST(Escape, LeadsAwayFromCellsThatTouchNoOthers) {
  const Eigen::Vector2d middle_m(2.5, 2.5);
  int alone = 0, failed = 0;
  for (double wall_rad = 0.0; wall_rad < 1.5; wall_rad += 0.1)
    for (double post_m = 0.74; post_m < 0.82; post_m += 0.02)
      for (double off_m = 0.34; off_m < 0.42; off_m += 0.02) {
        common::OccupancyGrid grid = test::room(100, 100);
        const Eigen::Vector2d along(std::cos(wall_rad), std::sin(wall_rad)), away(-along.y(), along.x());
        for (double t_m = -1.0; t_m <= 1.0; t_m += 0.02) grid.set(grid.cellAt(middle_m + t_m * along), test::kWallCell);
        grid.set(grid.cellAt(middle_m + post_m * away), test::kWallCell);
        const Eigen::Vector2d here = middle_m + off_m * away;
        const std::vector<Eigen::Vector2d> flown{here, here + 0.03 * along};
        CostLayers layers;
        layers.flown_map_m = flown;
        const CostMap map = test::mapOf(grid, {}, {}, layers);
        const common::CellIndex cell = map.cellAt(here);
        const std::optional<CellPath> escape = escapeFrom(map, cell);
        ASSERT_TRUE(escape);
        alone += !map.isLethal(map.indexOf(cell)) && escape->size() > 1;
        Wavefront planner;
        failed += planner.plan(map, here, middle_m + 1.6 * away) ? 0 : 1;
      }
  EXPECT_EQ(failed, 0);
  EXPECT_GT(alone, 0) << "no such place was met";
}

/// A room whose only door is too narrow: the vehicle is not squeezed through it.
TEST(Escape, ARoomWithANarrowDoorIsNotLeft) {
  common::OccupancyGrid grid = test::room(100, 60);
  test::fill(grid, {{40, 0}, {41, 60}}, test::kWallCell);
  test::fill(grid, {{40, 25}, {41, 35}}, test::kFreeCell);  // A door of 0.5 m, too narrow.
  const CostMap map = test::mapOf(grid);
  const common::CellIndex start = map.cellAt({1.0, 1.5});
  ASSERT_FALSE(map.isLethal(map.indexOf(start)));
  EXPECT_EQ(*escapeFrom(map, start), CellPath{start});
  Wavefront planner;
  EXPECT_EQ(planner.plan(map, {1.0, 1.5}, {4.0, 1.5}).error().reason, PlanFailure::Reason::kUnreachable);
}

/// Behind a door of 0.9 m the way is blocked. The vehicle fits into the door, but has no room there to stop and look.
TEST(Escape, ABlockageIsLookedAtFromWhereThereIsRoomToStop) {
  common::OccupancyGrid grid = test::room(100, 60);
  test::fill(grid, {{40, 0}, {41, 60}}, test::kWallCell);
  test::fill(grid, {{40, 21}, {41, 39}}, test::kFreeCell);
  test::fill(grid, {{52, 0}, {53, 60}}, test::kWallCell);
  test::fill(grid, {{52, 25}, {53, 35}}, test::kFreeCell);  // Too narrow.
  const CostMap map = test::mapOf(grid);
  const auto blocked = blockedPath(map, map.cellAt({1.0, 1.5}), map.cellAt({4.0, 1.5}));
  ASSERT_TRUE(blocked);
  EXPECT_GE(blocked->first_lethal.x, 41);
  EXPECT_LT(blocked->outlook.x, 40);
  EXPECT_GE(map.clearance().at_m(blocked->outlook, Against::kObstacles), map.footprint().stopRadius_m());
  EXPECT_FALSE(map.isLethal(map.indexOf({40, 30}))) << "the door itself is passable";
}

}  // namespace
}  // namespace swiftlet::planning
