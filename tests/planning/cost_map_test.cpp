// The cost map against the definition: distances by brute force, repair equal to a fresh map.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/config_check.hpp"
#include "grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;

RC_GTEST_PROP(CostMap, DistancesEqualBruteForce, (std::uint64_t seed)) {
  common::RandomStream random(seed, "distances");
  common::OccupancyGrid grid = test::room(50, 40, 0.04);
  test::clutter(grid, {{-5, -5}, {55, 45}}, 12, random);
  const CostMap map = test::mapOf(grid, {0.2, 0.1});
  std::vector<CellIndex> occupied, unknown;
  for (int y = -20; y < 70; ++y)
    for (int x = -20; x < 80; ++x) {
      if (map.states().at({x, y}) == CellState::kOccupied) occupied.push_back({x, y});
      if (map.states().at({x, y}) == CellState::kUnknown) unknown.push_back({x, y});
    }
  const auto nearest_m = [](CellIndex c, const std::vector<CellIndex>& cells) {
    double best = 1e9;
    for (const CellIndex o : cells) best = std::min(best, std::hypot(o.x - c.x, o.y - c.y) * 0.04);
    return best;
  };
  for (int i = 0; i < 80; ++i) {
    const CellIndex c{static_cast<int>(random.uniform(-5, 55)), static_cast<int>(random.uniform(-5, 45))};
    const double wall_m = nearest_m(c, occupied);
    RC_ASSERT(std::abs(map.clearance().at_m(c, Against::kObstacles) - std::min(wall_m, map.reach_m())) < 1e-9);
    const bool lethal = wall_m < 0.3 - 1e-9 || nearest_m(c, unknown) < 0.2 - 1e-9;
    if (std::abs(wall_m - 0.3) > 1e-6 && std::abs(nearest_m(c, unknown) - 0.2) > 1e-6)
      RC_ASSERT(lethal == (map.costAt(c) == CostMap::kLethal));
  }
}

RC_GTEST_PROP(CostMap, ARepairedMapEqualsAFreshOne, (std::uint64_t seed)) {
  common::RandomStream random(seed, "repair");
  common::OccupancyGrid grid = test::room(150, 100);
  CostMap map({}, grid.resolution_m());
  for (int step = 0; step < 5; ++step) {
    // Some changes lie outside, so that the map grows.
    test::clutter(grid, {{-40, -30}, {190, 130}}, 3, random);
    std::vector<common::Disc> discs;
    for (int i = 0; i < step % 3; ++i) discs.push_back({{random.uniform(0, 7), random.uniform(0, 5)}, 0.25});
    const Footprint footprint{0.275, step < 4 ? 0.10 : 0.20};
    map.update(grid.snapshot(), footprint, {discs, nullptr});
    CostMap fresh({}, grid.resolution_m());
    fresh.update(grid.snapshot(), footprint, {discs, nullptr});
    RC_ASSERT(map.rect() == fresh.rect());
    RC_ASSERT(map.costs() == fresh.costs());
    RC_ASSERT(map.states().all() == fresh.states().all());
  }
}

TEST(CostMap, CostFallsWithDistanceToTheOpenCost) {
  common::OccupancyGrid grid = test::room(100, 100);
  const CostMap map = test::mapOf(grid);
  CostMap::Cost last = CostMap::kLethal;
  for (int x = 0; x < 50; ++x) {
    const CostMap::Cost cost = map.costAt({x, 50});
    EXPECT_LE(cost, last);
    last = cost;
  }
  EXPECT_EQ(last, CostMap::kOpenCost);
  EXPECT_EQ(map.costAt({6, 50}), CostMap::kLethal);  // 0.35 m from the wall's cell
  EXPECT_NE(map.costAt({7, 50}), CostMap::kLethal);  // 0.40 m
}

TEST(CostMap, UnknownIsNotFree) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  test::fill(grid, {{0, 0}, {60, 60}}, test::kFreeCell);
  EXPECT_EQ(test::mapOf(grid).costAt({2, 30}), CostMap::kLethal);
  EXPECT_EQ(test::mapOf(grid).costAt({-10, 30}), CostMap::kLethal);
  EXPECT_EQ(test::mapOf(grid).costAt({30, 30}), CostMap::kOpenCost);
}

TEST(CostMap, DiscsAreInflatedAndLeaveNoTrace) {
  common::OccupancyGrid grid = test::room(100, 100);
  CostMap map = test::mapOf(grid);
  const auto before = map.costs();
  const std::vector<common::Disc> discs{{{2.5, 2.5}, 0.25}, {{NAN, 1.0}, 0.2}};
  map.update(grid.snapshot(), {}, {discs, nullptr});
  EXPECT_EQ(map.costAt(map.cellAt({2.5 + 0.57, 2.5})), CostMap::kLethal);
  EXPECT_NE(map.costAt(map.cellAt({2.5 + 0.7, 2.5})), CostMap::kLethal);
  EXPECT_GT(map.costAt(map.cellAt({2.5 + 0.7, 2.5})), CostMap::kOpenCost);
  map.update(grid.snapshot(), {});
  EXPECT_EQ(map.costs(), before);
}

TEST(CostMap, ReportsConfigProblems) {
  CostMap::Config config;
  config.comfort_weight = -1;
  EXPECT_EQ(common::config::problemsOf(config).size(), 1u);
  EXPECT_TRUE(common::config::problemsOf(CostMap::Config()).empty());
}

}  // namespace
}  // namespace swiftlet::planning
