// Maps against a room that is known to the millimetre.
#include "evaluation/map_metrics.hpp"

#include <gtest/gtest.h>

#include "small_world.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Pose2;

simulation::FreeSpace freeSpaceOf(const simulation::RayCaster& rays) {
  simulation::FreeSpaceQuery query;
  query.start_world_m = {1.0, 1.0};
  return simulation::freeSpace(rays, query);
}

TEST(WallError, IsHalfACellForTheTrueMap) {
  const simulation::RayCaster rays(smallWorld(1.0F));
  const auto error = wallError(smallMap(), Pose2{}, rays, 1.0);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->median_m, 0.025, 1e-4) << "from the centre of the cell behind the surface";
  EXPECT_LE(error->max_m, 0.025 * std::sqrt(2.0) + 1e-4);
  EXPECT_EQ(error->cells, 2u * 82 + 2u * 60);
}

TEST(WallError, MeasuresAShiftAndATurn) {
  const simulation::RayCaster rays(smallWorld(1.0F));
  // Shifted by 0.1 m in x: the walls along x still fit, those along y are off by it.
  const auto shifted = wallError(smallMap(), Pose2{0.1, 0, 0}, rays, 1.0);
  EXPECT_NEAR(shifted->p95_m, 0.125, 0.01);
  // The map's own frame may be anywhere, if only it is placed right.
  const Pose2 T_world_map{1.0, 1.0, 0.0};
  common::OccupancyGrid moved = common::makeOccupancyGrid(0.05);
  smallMap().forEachCell([&](common::CellIndex c, common::occupancy::Cell value) {
    if (!common::occupancy::isUnknown(value)) moved.set({c.x - 20, c.y - 20}, value);
  });
  EXPECT_NEAR(wallError(moved, T_world_map, rays, 1.0)->median_m, 0.025, 1e-4);
}

TEST(WallError, AGhostObstacleHasALargeError) {
  const simulation::RayCaster rays(smallWorld(1.0F));
  common::OccupancyGrid ghost = common::makeOccupancyGrid(0.05);
  EXPECT_FALSE(wallError(ghost, Pose2{}, rays, 1.0));
  ghost.set(ghost.cellAt(1.0, 1.5), 10);
  EXPECT_NEAR(wallError(ghost, Pose2{}, rays, 1.0)->median_m, WallError::kLimit_m, 0.05);
  ghost.set(ghost.cellAt(30.0, 30.0), 10);
  EXPECT_EQ(wallError(ghost, Pose2{}, rays, 1.0)->max_m, WallError::kLimit_m);
}

TEST(Coverage, IsTheKnownShareOfTheReachableArea) {
  const simulation::RayCaster rays(smallWorld(1.0F));
  const auto space = freeSpaceOf(rays);
  EXPECT_EQ(coverage(smallMap(), Pose2{}, space), 1.0);
  EXPECT_EQ(coverage(common::makeOccupancyGrid(0.05), Pose2{}, space), 0.0);
  common::OccupancyGrid left_half = common::makeOccupancyGrid(0.05);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 40; ++x) left_half.set({x, y}, -50);
  EXPECT_NEAR(coverage(left_half, Pose2{}, space), 0.5, 0.02);
}

TEST(Coverage, UnreachableAreaDoesNotCount) {
  const simulation::RayCaster rays(smallWorld(0.4F));  // The hull of 0.55 m does not fit through.
  const auto space = freeSpaceOf(rays);
  common::OccupancyGrid left_half = common::makeOccupancyGrid(0.05);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 42; ++x) left_half.set({x, y}, -50);
  EXPECT_GT(coverage(left_half, Pose2{}, space), 0.99);
}

}  // namespace
}  // namespace swiftlet::evaluation
