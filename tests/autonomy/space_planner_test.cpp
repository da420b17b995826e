// Paths in space as a flight asks for them: through a window above the height of flight, and the same whatever other
// threads plan.
#include "autonomy/planning_jobs/space_planner.hpp"

#include <cmath>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/planning_jobs/planning_worker.hpp"
#include "tests/autonomy/voxel_room.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kWallCell;

/// 6 m by 4 m with a wall at x = 3 m; above its lower 1.1 m it has a window of 0.8 m by 0.8 m around y = 2 m.
struct WallWithAWindow {
  WallWithAWindow() {
    fill(grid, {{60, 0}, {63, 80}}, kWallCell);
    VoxelRoom room;
    room.draw({0.1, 0.1, 0.1}, {5.9, 3.9, 2.1}, VoxelRoom::kSeenFree);
    room.draw({3.0, 0.0, 0.0}, {3.15, 4.0, 2.2}, VoxelRoom::kSeenOccupied);
    room.draw({2.9, 1.6, 1.1}, {3.25, 2.4, 1.9}, VoxelRoom::kSeenFree);
    layer = room.layer();
  }
  PlanningRequest request(double x_m, double reference_m) const {
    PlanningRequest request;
    request.grid = std::make_shared<const common::OccupancyGrid>(grid);
    request.map3d = layer;
    request.T_map_body = {x_m, 2.0, 0.0};
    GoalRequest goal{{5.0, 2.0}, 0.05, 0.0, {1.0, reference_m, 2.0, reference_m != 1.0}};
    request.question = goal;
    return request;
  }
  common::OccupancyGrid grid = planning::test::room(120, 80);
  std::shared_ptr<const common::Map3dLayer> layer;
};

PlanningConfig spaceConfig(planning::PlannerKind kind = planning::PlannerKind::kDStarLite, bool enabled = true) {
  PlanningConfig config;
  config.planner.kind = kind;
  config.lower.enabled = enabled;
  return config;
}

TEST(SpacePlanner, LeadsThroughAWindowAndBackToTheHeightOfFlight) {
  const WallWithAWindow scene;
  PlanningWorker worker(spaceConfig(), 0.05);
  const PlanningAnswer answer = worker.answer(scene.request(1.0, 1.0));
  ASSERT_TRUE(answer.path && *answer.path) << answer.path->error().text;
  const planning::Path& path = **answer.path;
  ASSERT_EQ(path.heights_m.size(), path.points_map_m.size());
  EXPECT_EQ(path.heights_m.front(), 1.0);
  EXPECT_EQ(path.heights_m.back(), 1.0);
  EXPECT_EQ(path.points_map_m.back(), Eigen::Vector2d(5.0, 2.0));
  ASSERT_TRUE(answer.space);
  for (std::size_t i = 1; i < path.points_map_m.size(); ++i) {
    const auto placeOf = [&](std::size_t at) {
      return Eigen::Vector3d(path.points_map_m[at].x(), path.points_map_m[at].y(), path.heights_m[at]);
    };
    EXPECT_TRUE(answer.space->hull.isFree(placeOf(i - 1), placeOf(i))) << i;
    const double from_x = path.points_map_m[i - 1].x(), to_x = path.points_map_m[i].x();
    if (from_x < 3.0 && to_x > 3.15) {
      EXPECT_GT(std::min(path.heights_m[i - 1], path.heights_m[i]), 1.1 + 0.125);
      EXPECT_LT(std::max(path.heights_m[i - 1], path.heights_m[i]), 1.9 - 0.125);
    }
  }
}

TEST(SpacePlanner, ChangesTheHeightOnlyNearTheWindow) {
  const WallWithAWindow scene;
  PlanningWorker worker(spaceConfig(), 0.05);
  const PlanningAnswer answer = worker.answer(scene.request(1.0, 1.0));
  ASSERT_TRUE(answer.path && *answer.path);
  const planning::Path& path = **answer.path;
  double off_m = 0.0;
  for (std::size_t i = 1; i < path.points_map_m.size(); ++i)
    if (path.heights_m[i - 1] != 1.0 || path.heights_m[i] != 1.0)
      off_m += (path.points_map_m[i] - path.points_map_m[i - 1]).norm();
  EXPECT_LT(off_m, 2.5) << "of 4 m";
}

TEST(SpacePlanner, NotEnabledThereIsNoPath) {
  const WallWithAWindow scene;
  PlanningWorker worker(spaceConfig(planning::PlannerKind::kDStarLite, false), 0.05);
  const PlanningAnswer answer = worker.answer(scene.request(1.0, 1.0));
  EXPECT_TRUE(answer.path && !*answer.path);
}

TEST(SpacePlanner, AVehicleInTheWindowPlansOnFromItsHeightAndKnowsTheMapThere) {
  const WallWithAWindow scene;
  PlanningWorker worker(spaceConfig(), 0.05);
  const PlanningAnswer answer = worker.answer(scene.request(3.07, 1.5));
  ASSERT_TRUE(answer.path && *answer.path) << answer.path->error().text;
  EXPECT_EQ((*answer.path)->heights_m.front(), 1.5);
  ASSERT_TRUE(answer.space && answer.space->here);
  const planning::CostMap& here = *answer.space->here;
  EXPECT_EQ(here.states().at(here.cellAt({3.07, 2.0})), planning::CellState::kFree);
  EXPECT_EQ(here.states().at(here.cellAt({3.07, 2.7})), planning::CellState::kOccupied);
}

TEST(SpacePlanner, AGoalThatNobodyHasSeenIsRefused) {
  WallWithAWindow scene;
  PlanningRequest request = scene.request(1.0, 1.0);
  std::get<GoalRequest>(request.question).goal_map_m = {40.0, 2.0};
  PlanningWorker worker(spaceConfig(), 0.05);
  const PlanningAnswer answer = worker.answer(request);
  EXPECT_TRUE(answer.path && !*answer.path);
}

TEST(SpacePlanner, TheSamplingPlannerPrefersAShorterPathInSpace) {
  WallWithAWindow scene;
  fill(scene.grid, {{60, 1}, {63, 18}}, planning::test::kFreeCell);  // A door at the side, 3 m longer.
  PlanningWorker plane(spaceConfig(), 0.05), space(spaceConfig(planning::PlannerKind::kSampling), 0.05);
  const PlanningAnswer around = plane.answer(scene.request(1.0, 1.0)), through = space.answer(scene.request(1.0, 1.0));
  ASSERT_TRUE(around.path && *around.path && through.path && *through.path);
  EXPECT_FALSE((*around.path)->isInSpace());
  EXPECT_TRUE((*through.path)->isInSpace());
}

TEST(SpacePlanner, PlansTheSameInTwoThreadsAtOnce) {
  const WallWithAWindow scene;
  const auto plans = [&](std::vector<planning::Path>& paths) {
    PlanningWorker worker(spaceConfig(), 0.05);
    for (int i = 0; i < 4; ++i) {
      const PlanningAnswer answer = worker.answer(scene.request(1.0 + 0.1 * i, 1.0));
      paths.push_back(answer.path && *answer.path ? **answer.path : planning::Path{});
    }
  };
  std::vector<planning::Path> alone, one, other;
  plans(alone);
  std::thread first([&] { plans(one); }), second([&] { plans(other); });
  first.join();
  second.join();
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_FALSE(alone[i].points_map_m.empty());
    EXPECT_EQ(alone[i].points_map_m, one[i].points_map_m) << i;
    EXPECT_EQ(alone[i].points_map_m, other[i].points_map_m) << i;
    EXPECT_EQ(alone[i].heights_m, one[i].heights_m) << i;
    EXPECT_EQ(alone[i].heights_m, other[i].heights_m) << i;
  }
}

}  // namespace
}  // namespace swiftlet::autonomy
