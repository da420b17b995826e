// The clearance of places and lines, in metres, over all that is in the way.
#include "planning/clearance/clearance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array kAllSorts{Against::kObstacles, Against::kUnseen, Against::kMapped,
                               Against::kBarred,    Against::kThings, Against::kAnything};

bool counts(Against layer, Against against) {
  return (static_cast<unsigned>(layer) & static_cast<unsigned>(against)) != 0;
}

/// By a search of all cells of a rectangle, as the header defines it.
double slowClearance_m(const common::OccupancyGrid& grid, const CellStates& states, const Vector2d& place_m,
                       std::span<const common::Disc> discs, std::span<const common::Polygon> zones, Against against) {
  const CellIndex at = grid.cellAt(place_m);
  double least_m = Clearance::kReach_m;
  for (int y = at.y - 60; y <= at.y + 60; ++y)
    for (int x = at.x - 60; x <= at.x + 60; ++x) {
      if (!states.rect().contains({x, y})) continue;
      const Vector2d center_m = grid.centerOf({x, y});
      bool barred = false;
      for (const common::Disc& disc : discs) barred |= (center_m - disc.center_map_m).norm() <= disc.radius_m;
      for (const common::Polygon& zone : zones) barred |= zone.contains(center_m);
      const CellState state = states.at({x, y});
      const bool in_the_way = (counts(Against::kBarred, against) && barred) ||
                              (counts(Against::kObstacles, against) && state == CellState::kOccupied) ||
                              (counts(Against::kUnseen, against) && state == CellState::kUnknown);
      if (in_the_way) least_m = std::min(least_m, grid.resolution_m() * std::hypot(x - at.x, y - at.y));
    }
  if (states.rect().contains(at)) return least_m;
  return counts(Against::kUnseen, against) ? 0.0 : Clearance::kReach_m;
}

RC_GTEST_PROP(Clearance, EqualsASearchOfAllCellsAfterEveryChange, (std::uint64_t seed)) {
  common::RandomStream random(seed, "clearance");
  common::OccupancyGrid grid = test::room(120, 100);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m());
  for (int step = 0; step < 5; ++step) {
    test::clutter(grid, {{0, 0}, {120, step < 3 ? 100 : 140}}, 2, random);  // It grows at last.
    std::vector<common::Disc> discs;
    for (int i = 0; i < step % 3; ++i) discs.push_back({{random.uniform(0, 6), random.uniform(0, 5)}, 0.25});
    std::vector<common::Polygon> zones;
    if (step % 2 == 1) {
      const double x = random.uniform(0, 5), y = random.uniform(0, 4);
      zones.push_back({{{x, y}, {x + 0.7, y}, {x, y + 0.5}}});
    }
    const common::OccupancyGrid snapshot = grid.snapshot();
    clearance.update(snapshot, discs, zones);
    CellStates states(grid.resolution_m());
    states.update(snapshot);
    for (int i = 0; i < 24; ++i) {
      const Vector2d place_m(random.uniform(-5, 8), random.uniform(-5, 8));
      const Against against = kAllSorts[static_cast<std::size_t>(i) % kAllSorts.size()];
      RC_ASSERT(std::abs(clearance.at_m(place_m, against) -
                         slowClearance_m(grid, states, place_m, discs, zones, against)) < 1e-9);
    }
  }
}

/// A room of 4 x 3 x 2.4 m in voxels of 0.1 m, with a wall at x = 2 m that has a window from 0.8 to 1.6 m in height.
common::VoxelMap roomWithWindow() {
  common::VoxelMap map(0.1);
  for (int z = 0; z < 24; ++z)
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        const bool window = z >= 8 && z < 16 && y >= 10 && y < 20;
        map.set({x, y, z}, x == 20 && !window ? std::int8_t{40} : std::int8_t{-40});
      }
  return map;
}

TEST(Clearance, OfASpaceIsThatToTheNearestVoxelThatIsNotFree) {
  Clearance clearance = Clearance::ofSpace(0.1);
  common::VoxelMap map = roomWithWindow();
  clearance.update(map.snapshot());
  EXPECT_NEAR(clearance.at_m(Vector3d(1.05, 1.55, 1.15)), 0.1 * std::sqrt(10 * 10 + 4 * 4), 1e-9);  // Above the sill.
  EXPECT_NEAR(clearance.at_m(Vector3d(2.05, 1.55, 1.25)), 0.4, 1e-9);                               // In the window.
  EXPECT_NEAR(clearance.at_m(Vector3d(1.05, 1.55, 0.35)), 0.4, 1e-9);  // The floor is not known to be free.
  EXPECT_EQ(clearance.at_m(Vector3d(1.05, 1.55, -3.0)), 0.0);
  map.set({10, 15, 11}, 40);
  clearance.update(map.snapshot());
  EXPECT_NEAR(clearance.at_m(Vector3d(1.05, 1.55, 1.35)), 0.2, 1e-9);
  map.set({10, 15, 11}, -40);
  clearance.update(map.snapshot());
  EXPECT_NEAR(clearance.at_m(Vector3d(1.05, 1.55, 1.15)), 0.1 * std::sqrt(10 * 10 + 4 * 4), 1e-9);
}

TEST(Clearance, OfAHullIsThatAtItsOwnHeight) {
  Clearance clearance = Clearance::ofSpace(0.1, 0.25);
  common::VoxelMap map = roomWithWindow();
  clearance.update(map.snapshot());
  // 0.1 m over the floor its bottom would be below it; at 0.15 m it fits.
  EXPECT_EQ(clearance.at_m(Vector3d(1.05, 1.55, 0.05)), 0.0);
  EXPECT_NEAR(clearance.at_m(Vector3d(1.05, 1.55, 0.25)), 1.0, 1e-9);
  // Through the window where top and bottom fit.
  const auto through = [&](double z_m) { return clearance.isFree({1.05, 1.55, z_m}, {3.05, 1.55, z_m}, 0.375); };
  EXPECT_TRUE(through(1.25));
  EXPECT_TRUE(through(0.95));
  EXPECT_FALSE(through(0.85));
  EXPECT_FALSE(through(1.55));
  // Climbing meets the sill.
  EXPECT_FALSE(clearance.isFree({1.05, 1.55, 0.35}, {2.45, 1.55, 1.25}, 0.375));
}

RC_GTEST_PROP(Clearance, OfALineIsTheLeastOfItsPlaces, (std::uint64_t seed)) {
  common::RandomStream random(seed, "lines");
  common::OccupancyGrid grid = test::room(120, 100);
  test::clutter(grid, {{0, 0}, {120, 100}}, 8, random);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m());
  clearance.update(grid.snapshot());
  for (int i = 0; i < 20; ++i) {
    const Vector3d from(random.uniform(0, 6), random.uniform(0, 5), 0),
        to(random.uniform(0, 6), random.uniform(0, 5), 0);
    double least_m = 1e9;
    const int steps = static_cast<int>((to - from).norm() / 0.002);
    for (int step = 0; step <= steps; ++step)
      least_m = std::min(least_m, clearance.at_m(Vector3d(from + (to - from) * step / std::max(1, steps))));
    const double along_m = clearance.along_m(from, to);
    // Between two places a cell may be cut at its corner: of those half a cell apart, and seldom of those 2 mm apart.
    constexpr double kCorner_m = 0.05 * std::numbers::sqrt2 + 1e-9;
    RC_ASSERT(std::abs(along_m - least_m) <= kCorner_m);
    RC_ASSERT(!clearance.isFree(from, to, along_m + 0.08));
    if (least_m > 0.1) RC_ASSERT(clearance.isFree(from, to, least_m - kCorner_m));
  }
}

RC_GTEST_PROP(Clearance, ALineIsFreeUpToWhereAWalkInSmallStepsEnds, (std::uint64_t seed)) {
  common::RandomStream random(seed, "free");
  common::OccupancyGrid grid = test::room(120, 100);
  test::clutter(grid, {{0, 0}, {120, 100}}, 8, random);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m(), {0.9, 0.3});
  clearance.update(grid.snapshot());
  for (int i = 0; i < 20; ++i) {
    const Vector2d from(random.uniform(0, 6), random.uniform(0, 5)), to(random.uniform(0, 6), random.uniform(0, 5));
    const double length_m = (to - from).norm(), radius_m = random.uniform(0.05, 0.5);
    const auto walked_m = [&](double least_m) {
      double at_m = 0.0;
      while (at_m < length_m &&
             clearance.at_m(Vector2d(from + at_m / length_m * (to - from)), Against::kObstacles) >= least_m)
        at_m += 0.002;
      return std::min(at_m, length_m);
    };
    const double free_m = clearance.freeFor_m(from, to, radius_m, Against::kObstacles);
    // It may end half a cell early, which the walk overruns by a step; corners that are cut are seldom looked up.
    constexpr double kCorner_m = 0.05 * std::numbers::sqrt2;
    RC_ASSERT(free_m >= walked_m(radius_m + kCorner_m) - 0.027);
    RC_ASSERT(free_m <= walked_m(radius_m - kCorner_m) + 1e-9);
  }
}

TEST(Clearance, ALineIsOpenWhereAllOfItWasSeenAndNothingStands) {
  common::OccupancyGrid grid = test::room(100, 60);
  test::fill(grid, {{50, 10}, {51, 20}}, test::kWallCell);
  test::fill(grid, {{50, 30}, {56, 36}}, common::occupancy::kUnknown);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m());
  const std::vector<common::Disc> people{{{2.5, 2.25}, 0.25}};
  clearance.update(grid.snapshot(), people);
  EXPECT_FALSE(clearance.isOpen({0.5, 0.75}, {4.5, 0.75})) << "a wall of one cell";
  EXPECT_FALSE(clearance.isOpen({0.5, 1.65}, {4.5, 1.65})) << "what nobody has seen";
  EXPECT_TRUE(clearance.isOpen({0.5, 0.25}, {4.5, 0.25}));
  EXPECT_TRUE(clearance.isOpen({0.5, 2.25}, {4.5, 2.25})) << "a person does not hide what the map has";
  EXPECT_FALSE(clearance.isFree({0.5, 2.25, 0.0}, {4.5, 2.25, 0.0}, 0.275, Against::kThings));
}

TEST(Clearance, ACopyStaysAsItWas) {
  common::OccupancyGrid grid = test::room(100, 60);
  Clearance clearance = Clearance::ofPlane(grid.resolution_m());
  clearance.update(grid.snapshot());
  const Clearance before = clearance;
  grid.set({50, 30}, test::kWallCell);
  const std::vector<common::Disc> people{{{1.0, 1.0}, 0.25}};
  clearance.update(grid.snapshot(), people);
  EXPECT_EQ(clearance.at_m(CellIndex{50, 30}, Against::kObstacles), 0.0);
  EXPECT_GT(before.at_m(CellIndex{50, 30}, Against::kObstacles), 1.0);
  EXPECT_EQ(clearance.at_m(Vector2d(1.0, 1.0), Against::kBarred), 0.0);
  EXPECT_EQ(before.at_m(Vector2d(1.0, 1.0), Against::kBarred), Clearance::kReach_m);
}

}  // namespace
}  // namespace swiftlet::planning
