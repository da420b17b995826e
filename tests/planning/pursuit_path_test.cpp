// The path that keeps a person in sight and at a distance: in a hall, at a box, too near, and too near to a wall.
#include "planning/pursuit/pursuit_path.hpp"

#include <gtest/gtest.h>

#include "planning/search/planner.hpp"
#include "tests/planning/flatland.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

/// A free hall of 10 x 10 m.
class Pursuing : public testing::Test {
 protected:
  Pursuing() { test::fill(grid_, {{0, 0}, {199, 199}}, test::kFreeCell); }
  void wall(const common::CellRect& cells) { test::fill(grid_, cells, test::kWallCell); }
  PursuitPath from(const Point& here_map_m, const std::vector<common::PossibleWalk>& walks,
                   const std::vector<Point>& walked_map_m = {}) {
    CostMap costs(CostMap::Config{}, grid_.resolution_m());
    costs.update(grid_.snapshot(), Footprint{});
    return pursuitPath({costs, grid_, here_map_m, walks, walked_map_m, 2.0, 0.73});
  }

  common::OccupancyGrid grid_ = common::makeOccupancyGrid(0.05);
};

TEST_F(Pursuing, StaysAtTheDistanceOfOneWhoStands) {
  const PursuitPath pursuit = from({3.0, 5.0}, {{{5.0, 5.0}, {0.0, 0.0}}});
  EXPECT_EQ(pursuit.path.points_map_m.size(), 1u);
  EXPECT_NEAR(pursuit.in_sight, 1.0, 1e-9);
}

TEST_F(Pursuing, FollowsOneWhoWalksAwayAndGivesWayToOneWhoComes) {
  const PursuitPath behind = from({3.0, 5.0}, {{{5.0, 5.0}, {0.5, 0.0}}});
  EXPECT_GT(behind.path.points_map_m.back().x(), 3.4);
  const PursuitPath away = from({3.9, 5.0}, {{{5.0, 5.0}, {-0.1, 0.0}}});
  ASSERT_GT(away.path.points_map_m.size(), 1u);
  EXPECT_GT((away.path.points_map_m.back() - Point(5.0, 5.0)).norm(), 1.6);
}

/// The person walks north behind a box, at whose south side the vehicle is: to see the person it must fly round a
/// corner before.
TEST_F(Pursuing, FliesWhereABoxWillNotHideThePerson) {
  wall({{100, 90}, {120, 140}});
  const Point here(4.5, 4.2);
  const std::vector<common::PossibleWalk> walks{{{6.4, 4.2}, {0.0, 0.5}}};
  const PursuitPath pursuit = from(here, walks);
  ASSERT_GT(pursuit.path.points_map_m.size(), 1u);
  EXPECT_GT(pursuit.in_sight, 0.9);
  EXPECT_GT(pursuit.path.points_map_m.back().x(), 5.0) << "round the south-east corner of the box";
}

TEST_F(Pursuing, WhatTheMapShowsWhereHeWalkedHidesNothing) {
  wall({{84, 90}, {86, 110}});  // He stood there for long.
  const std::vector<common::PossibleWalk> walks{{{5.0, 5.0}, {0.0, 0.0}}};
  EXPECT_LT(from({3.0, 5.0}, walks).in_sight + 0.0, 1.1);
  wall({{60, 0}, {62, 199}});
  const Point here(2.0, 5.0);
  EXPECT_EQ(from(here, walks).in_sight, 0.0) << "a wall across the hall";
  EXPECT_EQ(from(here, walks, {{3.1, 5.0}, {4.3, 5.0}}).in_sight, 1.0);
}

TEST_F(Pursuing, LeavesAPlaceTooNearToAWallAlsoIfItIsBestToStay) {
  wall({{50, 0}, {55, 199}});
  const PursuitPath pursuit = from({3.0, 5.0}, {{{5.2, 5.0}, {0.0, 0.0}}});
  ASSERT_GT(pursuit.path.points_map_m.size(), 1u);
  EXPECT_EQ(pursuit.path.points_map_m.front(), Point(3.0, 5.0));
  EXPECT_GT(pursuit.path.points_map_m.back().x(), 2.725 + 0.375) << "the wall, and the hull with its clearance";
  EXPECT_LT(pursuit.path.points_map_m.back().x(), 3.4);
  EXPECT_GT(pursuit.path.cost_m, 0.1);
}

/// As the planners' paths do: what is likelier to be free comes first, so that no corner of a thing is cut.
TEST_F(Pursuing, EscapesCellByCell) {
  wall({{50, 0}, {55, 199}});
  wall({{64, 98}, {66, 102}});
  const Point here(3.05, 5.0);
  CostMap costs(CostMap::Config{}, grid_.resolution_m());
  costs.update(grid_.snapshot(), Footprint{});
  const auto escape = escapeFrom(costs, costs.cellAt(here));
  ASSERT_TRUE(escape && escape->size() > 3);
  const PursuitPath pursuit = from(here, {{{6.5, 5.0}, {0.4, 0.0}}});
  ASSERT_GE(pursuit.path.points_map_m.size(), escape->size());
  EXPECT_EQ(pursuit.path.points_map_m.front(), here);
  for (std::size_t i = 1; i < escape->size(); ++i)
    EXPECT_EQ(pursuit.path.points_map_m[i], costs.centerOf((*escape)[i]));
}

TEST_F(Pursuing, LeavesAPlaceTooNearToAWallFirst) {
  wall({{50, 0}, {55, 199}});
  const PursuitPath pursuit = from({3.0, 5.0}, {{{6.5, 5.0}, {0.4, 0.0}}});
  ASSERT_GT(pursuit.path.points_map_m.size(), 1u);
  EXPECT_EQ(pursuit.path.points_map_m.front(), Point(3.0, 5.0));
  EXPECT_GT(pursuit.path.points_map_m.back().x(), 3.5);
}

}  // namespace
}  // namespace swiftlet::planning
