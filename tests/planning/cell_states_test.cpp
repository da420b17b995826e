// The states of cells: slivers, and updates that equal a fresh object and say what changed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "grid_builder.hpp"
#include "planning/clearance/cell_states.hpp"

namespace swiftlet::planning {
namespace {

using common::CellRect;

CellStates statesOf(common::OccupancyGrid& grid) {
  CellStates states(grid.resolution_m());
  states.update(grid.snapshot());
  return states;
}

TEST(CellStates, FillsThinUnknownLinesButNotHoles) {
  common::OccupancyGrid grid = test::room(100, 100);
  for (int i = 20; i < 80; ++i) grid.set({i, i / 2 + 10}, common::occupancy::kUnknown);
  test::fill(grid, {{60, 70}, {63, 73}}, common::occupancy::kUnknown);
  grid.set({-1, 50}, common::occupancy::kUnknown);  // a gap in the wall: free on one side alone
  const CellStates states = statesOf(grid);
  for (int i = 20; i < 80; ++i) EXPECT_EQ(states.at({i, i / 2 + 10}), CellState::kFree);
  EXPECT_EQ(states.at({61, 71}), CellState::kUnknown);
  EXPECT_EQ(states.at({-1, 50}), CellState::kUnknown);
}

TEST(CellStates, AnEmptyGridHasNoCells) {
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  const CellStates states = statesOf(grid);
  EXPECT_TRUE(states.rect().empty());
  EXPECT_TRUE(states.all().empty());
  EXPECT_EQ(states.at({0, 0}), CellState::kUnknown);
}

RC_GTEST_PROP(CellStates, AnUpdateEqualsAFreshObjectAndReturnsAllChanges, (std::uint64_t seed)) {
  common::RandomStream random(seed, "states");
  common::OccupancyGrid grid = test::room(150, 100);
  CellStates states(grid.resolution_m());
  for (int step = 0; step < 4; ++step) {
    // Some changes lie outside, so that the extent grows.
    test::clutter(grid, {{-40, -30}, {190, 130}}, 3, random);
    const CellStates before = states;
    const std::vector<CellRect> changes = states.update(grid.snapshot());
    const CellStates fresh = statesOf(grid);
    RC_ASSERT(states.rect() == fresh.rect());
    RC_ASSERT(states.all() == fresh.all());
    if (before.rect() != states.rect()) continue;
    const int width = states.rect().width();
    for (int i = 0; i < static_cast<int>(states.all().size()); ++i) {
      if (states[i] == before[i]) continue;
      RC_ASSERT(std::any_of(changes.begin(), changes.end(), [&](const CellRect& r) {
        return r.contains({i % width, i / width});
      }));
    }
  }
}

}  // namespace
}  // namespace swiftlet::planning
