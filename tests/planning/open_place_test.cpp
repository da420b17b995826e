// The open place near a vehicle that is about to fly blind.
#include "planning/costs/open_place.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

TEST(OpenPlace, LeadsAwayFromAWallAndNoFartherThanItMust) {
  common::OccupancyGrid grid = test::room(160, 80);  // 8 m by 4 m.
  const CostMap map = test::mapOf(grid);
  const Vector2d displacement_m = displacementToOpenPlace_m(map, {4.0, 0.5}, 1.0);
  EXPECT_LT(std::abs(displacement_m.x()), 0.5 * displacement_m.y());
  EXPECT_NEAR(displacement_m.y(), map.reach_m() - 0.5, 0.1) << "beyond its reach the map tells no distance";
  EXPECT_LE(displacementToOpenPlace_m(map, {4.0, 0.5}, 0.2).norm(), 0.2 + 1e-9);
}

TEST(OpenPlace, LeadsOutOfACorner) {
  common::OccupancyGrid grid = test::room(160, 80);
  const Vector2d displacement_m = displacementToOpenPlace_m(test::mapOf(grid), {0.45, 0.45}, 1.0);
  EXPECT_GT(displacement_m.x(), 0.25);
  EXPECT_GT(displacement_m.y(), 0.25);
}

TEST(OpenPlace, InTheMiddleTheVehicleStays) {
  common::OccupancyGrid grid = test::room(160, 80);
  const CostMap map = test::mapOf(grid);
  EXPECT_EQ(displacementToOpenPlace_m(map, {4.0, 2.0}, 1.0), Vector2d(0.0, 0.0));
  common::OccupancyGrid passage = test::room(160, 20);  // 1 m wide.
  EXPECT_LT(displacementToOpenPlace_m(test::mapOf(passage), {4.0, 0.525}, 1.0).norm(), 0.06);
}

TEST(OpenPlace, NeverLeadsThroughAWallOrIntoTheUnknown) {
  common::OccupancyGrid grid = test::room(160, 80);
  test::fill(grid, {{0, 18}, {160, 19}}, test::kWallCell);  // A wall at 0.9 m, and open space behind it.
  const Vector2d beside_m = displacementToOpenPlace_m(test::mapOf(grid), {4.0, 0.4}, 1.5);
  EXPECT_LT(0.4 + beside_m.y(), 0.6);
  common::OccupancyGrid half = test::room(160, 80);
  test::fill(half, {{0, 24}, {160, 81}}, common::occupancy::kUnknown);  // Nothing is known from 1.2 m on.
  const Vector2d known_m = displacementToOpenPlace_m(test::mapOf(half), {4.0, 0.5}, 1.5);
  EXPECT_LE(0.5 + known_m.y(), 1.2);
}

TEST(OpenPlace, OutsideTheMapTheVehicleStays) {
  common::OccupancyGrid grid = test::room(40, 40);
  EXPECT_EQ(displacementToOpenPlace_m(test::mapOf(grid), {50.0, 50.0}, 1.0), Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace swiftlet::planning
