// Both planners against Dijkstra, after every random change; what they refuse and why; the shape of their paths.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "dijkstra.hpp"
#include "grid_builder.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using testing::HasSubstr;

constexpr Footprint kSmall{0.10, 0.05};

std::optional<CellIndex> randomFree(const CostMap& map, common::RandomStream& random) {
  for (int i = 0; i < 200; ++i) {
    const int index = static_cast<int>(random.uniform() * static_cast<double>(map.costs().size()));
    if (!map.isLethal(index)) return map.cellOf(index);
  }
  return std::nullopt;
}

common::LevelMap randomLevels(common::RandomStream& random) {
  common::LevelMap levels;
  for (int id = 1; id <= 3; ++id) {
    common::Level level{id, random.uniform(-0.3, 0.9), 0.001, {}};
    const int x0 = static_cast<int>(random.uniform(0, 40)), y0 = static_cast<int>(random.uniform(0, 30));
    for (int x = x0; x < x0 + 12; ++x)
      for (int y = y0; y < y0 + 8; ++y) level.cells.push_back({x, y});
    levels.levels.push_back(level);
  }
  return levels;
}

/// Plans in a world that changes before each of them: boxes come and go, people walk, the vehicle moves, sometimes the
/// goal does. Returns the first difference from the oracle. `bug`: the planner does not get the discs, so its plan is
/// not repaired.
std::string firstDifference(std::uint64_t seed, int plans, bool bug) {
  common::RandomStream random(seed, "planner_test");
  common::OccupancyGrid grid = test::room(80, 60);
  const common::CellRect room{{0, 0}, {80, 60}};
  CostMap map({}, grid.resolution_m());
  const common::LevelMap levels = randomLevels(random);
  const bool with_levels = random.chance(0.5);
  DStarLite dstar;
  Wavefront wavefront;
  std::optional<CellIndex> start, goal;
  for (int compared = 0; compared < plans;) {
    if (random.chance(0.05)) test::fill(grid, room, test::kFreeCell);
    test::clutter(grid, room, 1 + static_cast<int>(random.uniform() * 4), random);
    std::vector<common::Disc> discs;
    if (random.chance(0.5)) discs.push_back({{random.uniform(0, 4), random.uniform(0, 3)}, random.uniform(0.05, 0.4)});
    CostLayers layers{discs, with_levels ? &levels : nullptr};
    map.update(grid.snapshot(), kSmall, layers);
    if (!start || random.chance(0.6) || map.costAt(*start) == CostMap::kLethal) start = randomFree(map, random);
    if (!goal || random.chance(0.02) || map.costAt(*goal) == CostMap::kLethal) goal = randomFree(map, random);
    if (!start || !goal) continue;
    if (escapeFrom(map, *start)->size() > 1) continue;  // A pocket, from which the planners go on.

    ++compared;
    const std::int64_t truth = test::dijkstra(map, map.indexOf(*start))[static_cast<std::size_t>(map.indexOf(*goal))];
    std::optional<CostMap> without;
    if (bug) without.emplace(map).update(grid.snapshot(), kSmall, {{}, layers.levels});
    const CostMap& seen = bug ? *without : map;
    const auto a = dstar.plan(seen, map.centerOf(*start), map.centerOf(*goal));
    const auto b = wavefront.plan(seen, map.centerOf(*start), map.centerOf(*goal));
    const std::string where = fmt::format("seed {} plan {}: ", seed, compared);
    if (a.has_value() != (truth != test::kNever)) return where + "D* Lite disagrees on whether there is a path";
    if (b.has_value() != (truth != test::kNever)) return where + "wavefront disagrees on whether there is a path";
    if (!a) continue;
    if (dstar.searchCost() != truth) return where + fmt::format("D* Lite {} != {}", dstar.searchCost(), truth);
    if (wavefront.searchCost() != truth)
      return where + fmt::format("wavefront {} != {}", wavefront.searchCost(), truth);
  }
  return "";
}

RC_GTEST_PROP(Planner, EqualsDijkstraInEveryWorld, (std::uint64_t seed)) {
  RC_ASSERT(firstDifference(seed, 20, false) == "");
}

TEST(Planner, EqualsDijkstraAfterEachOfTenThousandChanges) {
  constexpr int kPlans = 1000;  // In each of ten worlds.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) EXPECT_EQ(firstDifference(seed, kPlans, false), "");
}

TEST(Planner, TheOracleCatchesAPlanThatWasNotRepaired) {
  int caught = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) caught += !firstDifference(seed, 20, true).empty();
  EXPECT_GE(caught, 8);
}

/// The least length of a path over cells that are free, in cells, by a search that shares no code with the planners.
double octileDistance(const CostMap& map, int source, int target) {
  std::vector<double> least(map.costs().size(), 1e18);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  least[static_cast<std::size_t>(source)] = 0.0;
  open.push({0.0, source});
  while (!open.empty()) {
    const auto [length, at] = open.top();
    open.pop();
    if (at == target) return length;
    const CellIndex cell = map.cellOf(at);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto lethal = [&](int x, int y) { return map.costAt({cell.x + x, cell.y + y}) == CostMap::kLethal; };
        if (lethal(dx, dy) || lethal(dx, 0) || lethal(0, dy)) continue;
        const double there = length + std::sqrt(dx * dx + dy * dy);
        double& known = least[static_cast<std::size_t>(map.indexOf({cell.x + dx, cell.y + dy}))];
        if (there > known - 1e-12) continue;
        known = there;
        open.push({there, map.indexOf({cell.x + dx, cell.y + dy})});
      }
  }
  return -1.0;
}

RC_GTEST_PROP(DStarLite, WithOctileCostsHasTheLeastLength, (std::uint64_t seed)) {
  common::RandomStream random(seed, "octile");
  common::OccupancyGrid grid = test::room(150, 110, 1.0);
  test::clutter(grid, {{0, 0}, {150, 110}}, 120, random);
  CostMap::Config plain;
  plain.comfort_weight = 0.0;
  const CostMap map = test::mapOf(grid, {0.1, 0.0}, plain);
  DStarLite planner(kOctileScale);
  for (int i = 0; i < 5; ++i) {
    const auto start = randomFree(map, random), goal = randomFree(map, random);
    if (!start || !goal || escapeFrom(map, *start)->size() > 1) continue;
    const double truth = octileDistance(map, map.indexOf(*start), map.indexOf(*goal));
    const auto plan = planner.planCells(map, map.centerOf(*start), map.centerOf(*goal));
    RC_ASSERT(plan.has_value() == (truth >= 0.0));
    if (!plan) continue;
    double length = 0.0;
    for (std::size_t c = 1; c < plan->cells.size(); ++c)
      length += (map.centerOf(plan->cells[c]) - map.centerOf(plan->cells[c - 1])).norm();
    RC_ASSERT(std::abs(length - truth) < 1e-6);
  }
}

TEST(Planner, APathStartsAndEndsExactlyAndKeepsItsClearance) {
  common::OccupancyGrid grid = test::room(200, 100);
  test::fill(grid, {{90, 0}, {94, 70}}, test::kWallCell);
  const CostMap map = test::mapOf(grid);
  DStarLite planner;
  const Eigen::Vector2d start{1.013, 1.027}, goal{8.931, 1.017};
  const auto path = planner.plan(map, start, goal);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->points_map_m.front(), start);
  EXPECT_EQ(path->points_map_m.back(), goal);
  EXPECT_LT(path->points_map_m.size(), 40u);
  for (std::size_t i = 1; i < path->points_map_m.size(); ++i)
    EXPECT_FALSE(segmentCost(map, path->points_map_m[i - 1], path->points_map_m[i]).lethal);
  EXPECT_GE(path->cost_m, path->length_m - 1e-9);
}

TEST(Planner, CrossesAnEmptyHallInAStraightLine) {
  common::OccupancyGrid grid = test::room(240, 160);
  const CostMap map = test::mapOf(grid);
  Wavefront planner;
  const auto path = planner.plan(map, {2.0, 2.0}, {10.0, 5.5});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->points_map_m.size(), 2u);
  EXPECT_NEAR(path->length_m, std::hypot(8.0, 3.5), 1e-9);
}

TEST(Planner, KeepsToTheMiddleOfAPassage) {
  common::OccupancyGrid grid = test::room(200, 30);  // 1.5 m wide
  const CostMap map = test::mapOf(grid);
  DStarLite planner;
  const auto path = planner.plan(map, {0.6, 0.45}, {9.4, 0.45});
  ASSERT_TRUE(path);
  double greatest_y = 0.0;
  for (const auto& p : path->points_map_m) greatest_y = std::max(greatest_y, p.y());
  EXPECT_GT(greatest_y, 0.65);
}

TEST(Planner, RefusalsGiveAReason) {
  common::OccupancyGrid grid = test::room(100, 100);
  test::fill(grid, {{48, 0}, {52, 100}}, test::kWallCell);
  const CostMap map = test::mapOf(grid);
  DStarLite planner;
  const auto across = planner.plan(map, {1, 1}, {4, 4});
  ASSERT_FALSE(across);
  EXPECT_EQ(across.error().reason, PlanFailure::Reason::kUnreachable);
  EXPECT_THAT(across.error().text, HasSubstr("unreachable at clearance 0.10 m"));

  const auto wall = planner.plan(map, {1, 1}, {2.45, 3});
  ASSERT_FALSE(wall);
  EXPECT_EQ(wall.error().reason, PlanFailure::Reason::kGoalBlocked);
  EXPECT_THAT(wall.error().text, HasSubstr("in an obstacle"));
  ASSERT_TRUE(wall.error().nearest_free_map_m);
  EXPECT_NEAR((*wall.error().nearest_free_map_m - Eigen::Vector2d(2.45, 3)).norm(), 0.425, 0.06);

  EXPECT_EQ(planner.plan(map, {1, 1}, {400, 4}).error().reason, PlanFailure::Reason::kOutsideMap);
  EXPECT_EQ(planner.plan(map, {-300, 1}, {1, 1}).error().reason, PlanFailure::Reason::kOutsideMap);
  EXPECT_EQ(planner.plan(map, {1, 1}, {NAN, 1}).error().reason, PlanFailure::Reason::kOutsideMap);
  EXPECT_EQ(planner.plan(map, {1, 1}, {-1.5, 3}).error().reason, PlanFailure::Reason::kGoalUnseen);

  const CostMap nothing({}, 0.05);
  EXPECT_EQ(planner.plan(nothing, {0, 0}, {1, 1}).error().reason, PlanFailure::Reason::kOutsideMap);
}

TEST(Planner, PlansAwayFromAWallThatTheVehicleWasPushedTo) {
  common::OccupancyGrid grid = test::room(100, 60);
  const CostMap map = test::mapOf(grid);
  for (const Eigen::Vector2d& start :
       {Eigen::Vector2d(0.28, 1.5), Eigen::Vector2d(0.05, 0.05), Eigen::Vector2d(0.30, 2.8)}) {
    DStarLite dstar;
    Wavefront wavefront;
    const auto a = dstar.plan(map, start, {3, 1.5});
    const auto b = wavefront.plan(map, start, {3, 1.5});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->points_map_m.front(), start);
    EXPECT_EQ(dstar.searchCost(), wavefront.searchCost());
    double distance_m = map.clearance().at_m(map.cellAt(start), Against::kObstacles);
    for (const auto& p : a->points_map_m) {
      const double next_m = map.clearance().at_m(map.cellAt(p), Against::kObstacles);
      if (distance_m < map.footprint().radius_m()) {
        EXPECT_GE(next_m, distance_m - 1e-9);
      }
      distance_m = next_m;
    }
  }
  test::fill(grid, {{0, 0}, {100, 60}}, test::kWallCell);
  grid.set({30, 30}, test::kFreeCell);
  const CostMap shut = test::mapOf(grid);
  EXPECT_FALSE(escapeFrom(shut, {30, 30}));
}

struct PlannerOverSteps : testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(UpAndDown, PlannerOverSteps, testing::Values(0.75, -0.75));

TEST_P(PlannerOverSteps, TakesADetourAroundAStepOfTheFloor) {
  common::OccupancyGrid grid = test::room(160, 160);
  common::LevelMap levels;
  levels.levels.push_back({1, GetParam(), 0.001, {}});
  for (int x = 35; x < 45; ++x)
    for (int y = 20; y < 60; ++y) levels.levels[0].cells.push_back({x, y});  // a table, or a pit, 1 m by 4 m
  DStarLite planner;
  const auto greatestHeight = [&](const CostMap& map) {
    const auto path = planner.plan(map, {2, 4}, {6, 4});
    EXPECT_TRUE(path);
    int height_cm = 0;
    for (std::size_t i = 1; i < path->points_map_m.size(); ++i)
      for (double t = 0; t <= 1.0; t += 0.01) {
        const Eigen::Vector2d p = path->points_map_m[i - 1] * (1 - t) + path->points_map_m[i] * t;
        height_cm =
            std::max(height_cm, std::abs(map.steps().heights_cm[static_cast<std::size_t>(map.indexOf(map.cellAt(p)))]));
      }
    return height_cm;
  };
  CostMap::Config dear, cheap;
  dear.height_step_weight = 4.0;  // up and down 1.5 m: worth a detour of 6 m
  cheap.height_step_weight = 0.2;
  EXPECT_EQ(greatestHeight(test::mapOf(grid, {}, dear, {{}, &levels})), 0);
  EXPECT_EQ(greatestHeight(test::mapOf(grid, {}, cheap, {{}, &levels})), 75);
}

RC_GTEST_PROP(Planner, ShortcutsNeverRaiseTheRisk, (std::uint64_t seed)) {
  common::RandomStream random(seed, "shortcut");
  common::OccupancyGrid grid = test::room(110, 80);
  test::clutter(grid, {{0, 0}, {110, 80}}, 20, random);
  const CostMap map = test::mapOf(grid, kSmall);
  const auto start = randomFree(map, random), goal = randomFree(map, random);
  if (!start || !goal) return;
  Wavefront planner;
  const auto path = planner.plan(map, map.centerOf(*start), map.centerOf(*goal));
  if (!path || escapeFrom(map, *start)->size() > 1) return;  // From a pocket the planners go on by the escape.
  const double cells_m = planner.searchCost() * map.resolution_m() / CostMap::kStraightMin;
  RC_ASSERT(path->cost_m <= cells_m * 1.01);
  for (std::size_t i = 1; i < path->points_map_m.size(); ++i)
    RC_ASSERT(!segmentCost(map, path->points_map_m[i - 1], path->points_map_m[i]).lethal);
}

}  // namespace
}  // namespace swiftlet::planning
