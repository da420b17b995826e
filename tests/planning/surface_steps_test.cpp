// Steps of the surface below, from levels on larger cells.
#include <gtest/gtest.h>

#include <utility>

#include "grid_builder.hpp"
#include "planning/costs/surface_steps.hpp"

namespace swiftlet::planning {
namespace {

class Steps : public testing::Test {
 protected:
  Steps() { cells_.update(grid_.snapshot()); }
  int indexAt(double x_m, double y_m) const { return cells_.indexOf(cells_.grid().cellAt(x_m, y_m)); }
  int heightAt_cm(const SurfaceSteps& steps, double x_m, double y_m) const {
    return steps.heights_cm[static_cast<std::size_t>(indexAt(x_m, y_m))];
  }
  common::OccupancyGrid grid_ = test::room(60, 60);
  CellStates cells_{0.05};
};

TEST_F(Steps, AFlatFloorHasNone) {
  common::LevelMap levels{0.10, {}};
  levels.levels.push_back({0, 0.004, 0.0, {{5, 5}}});
  for (const common::LevelMap* given : {static_cast<const common::LevelMap*>(nullptr), &std::as_const(levels)}) {
    const SurfaceSteps steps = surfaceSteps(cells_, given, 7);
    EXPECT_TRUE(steps.heights_cm.empty());
    EXPECT_EQ(steps.cost(0, 1), 0);
    EXPECT_EQ(steps.greatestCost(), 0);
  }
}

TEST_F(Steps, TheHighestLevelOfACellCountsAndTheRestIsFloor) {
  common::LevelMap levels{0.10, {}};
  levels.levels.push_back({0, 0.75, 0.0, {{5, 5}}});
  levels.levels.push_back({1, 0.40, 0.0, {{5, 5}, {6, 5}}});
  levels.levels.push_back({2, 9.0, 0.0, {{20, 20}}});
  const SurfaceSteps steps = surfaceSteps(cells_, &levels, 7);
  EXPECT_EQ(heightAt_cm(steps, 0.52, 0.58), 75) << "both cells of the map that lie in the cell of the level";
  EXPECT_EQ(heightAt_cm(steps, 0.58, 0.52), 75);
  EXPECT_EQ(heightAt_cm(steps, 0.62, 0.52), 40);
  EXPECT_EQ(heightAt_cm(steps, 0.48, 0.52), 0);
  EXPECT_EQ(heightAt_cm(steps, 2.02, 2.02), 250) << "so that no step is higher than 5 m";
  EXPECT_EQ(steps.cost(indexAt(0.58, 0.52), indexAt(0.62, 0.52)), 7 * 35);
  EXPECT_EQ(steps.cost(indexAt(0.62, 0.52), indexAt(0.58, 0.52)), 7 * 35);
  EXPECT_EQ(steps.greatestCost(), 7 * 500);
}

}  // namespace
}  // namespace swiftlet::planning
