// Panes of glass in the map: seen once near their normal, they stay, and people who have left do not.
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "perception/slam2d/sliced_map.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;
namespace occupancy = common::occupancy;

constexpr double kPane_m = 2.02, kPaneEnd_m = 3.0, kWallBehind_m = 5.02;
constexpr double kGlassAngle_rad = 15.0 * std::numbers::pi / 180.0;

/// A room with a wall along x = 5 m, before it a pane along x = 2 m if there is one, and a person if there is one.
struct GlassRoom {
  bool pane = true;
  std::optional<Eigen::Vector2d> person_m;
  common::RandomStream random{1, "glass"};

  double range_m(const Eigen::Vector2d& from_m, double angle_rad) {
    const Eigen::Vector2d u(std::cos(angle_rad), std::sin(angle_rad));
    double best_m = u.x() > 0.1 ? (kWallBehind_m - from_m.x()) / u.x() : 30.0;
    if (u.x() < -0.1) best_m = std::min(best_m, (-2.0 - from_m.x()) / u.x());
    if (std::abs(u.y()) > 0.1) best_m = std::min(best_m, (std::copysign(5.0, u.y()) - from_m.y()) / u.y());
    const double to_pane_m = (kPane_m - from_m.x()) / u.x();
    const bool meets = to_pane_m > 0.0 && std::abs(from_m.y() + to_pane_m * u.y()) < kPaneEnd_m;
    if (pane && meets && std::abs(u.x()) > std::cos(kGlassAngle_rad)) best_m = std::min(best_m, to_pane_m);
    if (person_m) {
      constexpr double kRadius_m = 0.25;
      const Eigen::Vector2d to = *person_m - from_m;
      const double ahead_m = to.dot(u), aside2_m2 = to.squaredNorm() - ahead_m * ahead_m;
      if (ahead_m > 0.0 && aside2_m2 < kRadius_m * kRadius_m)
        best_m = std::min(best_m, ahead_m - std::sqrt(kRadius_m * kRadius_m - aside2_m2));
    }
    return best_m + random.gaussian(0.01);
  }
  DrawnScan scan(const Eigen::Vector2d& from_m) {
    ProjectedScan scan;
    for (int beam = 0; beam < 1440; ++beam) {
      const double angle_rad = (0.25 * beam - 180.0) * std::numbers::pi / 180.0, range = range_m(from_m, angle_rad);
      if (range < 20.0)
        scan.points_level_m.push_back(
            (range * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))).cast<float>());
    }
    scan.heights_level_m.assign(scan.points_level_m.size(), 0.0F);
    return thinForDrawing(scan, {});
  }
  void watch(SlicedMap& map, const Eigen::Vector2d& from_m, int scans) {
    for (int i = 0; i < scans; ++i) map.draw(scan(from_m), {from_m.x(), from_m.y(), 0.0});
  }
};

/// Flies along the pane, 1.2 m before it, and then looks at it aslant from its end.
common::OccupancyGrid mapPastThePane(const GridDrawingConfig& config) {
  GlassRoom room;
  SlicedMap map(config);
  for (double y_m = -3.0; y_m <= 3.0; y_m += 0.05) room.watch(map, {0.8, y_m}, 1);
  room.watch(map, {0.8, 3.0}, 60);
  return map.atFlightHeight();
}

/// The length of the pane in the map, in cells, two cells deep, as it may lie at the border of two.
int paneCells(const common::OccupancyGrid& map) {
  int cells = 0;
  for (double y_m = -2.475; y_m < 2.5; y_m += 0.05) {
    const CellIndex cell = map.cellAt(kPane_m, y_m);
    cells += occupancy::isOccupied(map.at(cell)) || occupancy::isOccupied(map.at({cell.x - 1, cell.y})) ? 1 : 0;
  }
  return cells;
}

GridDrawingConfig keepsGlass() {
  GridDrawingConfig config;
  config.glass_fade_scans = 100;
  return config;
}

TEST(Glass, APaneThatWasSeenHeadOnStaysInTheMap) {
  EXPECT_GE(paneCells(mapPastThePane(keepsGlass())), 95) << "of 100";
  EXPECT_LE(paneCells(mapPastThePane({})), 40) << "as without the memory of glass";
}

TEST(Glass, BehindItIsFreeSpaceWithASoundWall) {
  const common::OccupancyGrid map = mapPastThePane(keepsGlass());
  for (double y_m = -2.0; y_m < 2.0; y_m += 0.1) {
    EXPECT_TRUE(occupancy::isFree(map.at(map.cellAt(3.5, y_m)))) << y_m;
    EXPECT_TRUE(occupancy::isOccupied(map.at(map.cellAt(kWallBehind_m, y_m)))) << y_m;
  }
}

int occupiedAround(SlicedMap& map, const Eigen::Vector2d& place_m) {
  const common::OccupancyGrid grid = map.atFlightHeight();
  int occupied = 0;
  grid.forEachCell([&](CellIndex cell, occupancy::Cell value) {
    occupied += occupancy::isOccupied(value) && (grid.centerOf(cell) - place_m).norm() < 0.45 ? 1 : 0;
  });
  return occupied;
}

TEST(Glass, AnObstacleThatWasTakenAwayIsClearedFromAnotherSideInTheEnd) {
  GlassRoom room;
  room.pane = false;
  GridDrawingConfig config;
  config.glass_fade_scans = 10;
  SlicedMap map(config);
  room.person_m = {2.0, 0.0};
  room.watch(map, {0.0, 0.0}, 20);
  room.watch(map, {1.0, -2.0}, 20);  // A second side. What was head on from the first is aslant from here.
  const int before = occupiedAround(map, {2.0, 0.0});
  room.person_m.reset();
  room.watch(map, {2.5, 2.5}, 20);
  EXPECT_LE(occupiedAround(map, {2.0, 0.0}), before / 2) << "of " << before;
  room.watch(map, {2.5, 2.5}, 150);
  EXPECT_EQ(occupiedAround(map, {2.0, 0.0}), 0);
}

TEST(Glass, APersonWhoLeftIsClearedWhereTheyWereSeenFromAndSoonElsewhere) {
  for (const double side_m : {0.0, 2.0}) {
    GlassRoom room;
    room.pane = false;
    GridDrawingConfig config;
    config.glass_fade_scans = 10;
    SlicedMap map(config);
    room.person_m = {2.0, 0.0};
    room.watch(map, {0.0, 0.0}, 100);
    EXPECT_GE(occupiedAround(map, {2.0, 0.0}), 8);
    room.person_m.reset();
    room.watch(map, {0.3, side_m}, 13);
    EXPECT_LE(occupiedAround(map, {2.0, 0.0}), side_m == 0.0 ? 0 : 4) << "the few cells that were met head on";
    room.watch(map, {0.3, side_m}, 150);
    EXPECT_EQ(occupiedAround(map, {2.0, 0.0}), 0) << side_m;
  }
}

TEST(GlassMemory, KeepsOnlyWhatWasHitSeveralTimesAlongOneNormal) {
  const CellIndex cell{3, -4};
  const auto beam = [](double deg) {
    return Eigen::Vector2d(std::cos(deg * std::numbers::pi / 180.0), std::sin(deg * std::numbers::pi / 180.0));
  };
  GlassMemory memory(0.05);
  for (int i = 0; i < 3; ++i) memory.hit(cell, beam(10), Incidence::kAlongNormal);
  EXPECT_FALSE(memory.passesThrough(cell, beam(80))) << "not often enough";
  memory.hit(cell, beam(-5), Incidence::kAlongNormal);
  EXPECT_TRUE(memory.passesThrough(cell, beam(80)));
  EXPECT_TRUE(memory.passesThrough(cell, beam(-100)));
  EXPECT_FALSE(memory.passesThrough(cell, beam(15))) << "near the normal it would return";
  EXPECT_FALSE(memory.passesThrough(cell, beam(185))) << "from behind as well";
  memory.hit(cell, beam(190), Incidence::kAlongNormal);
  EXPECT_TRUE(memory.passesThrough(cell, beam(80))) << "the other side of the pane";
  GlassMemory copy = memory.snapshot();
  memory.hit(cell, beam(50), Incidence::kAslant);
  EXPECT_FALSE(memory.passesThrough(cell, beam(80))) << "hit aslant: no glass";
  EXPECT_TRUE(copy.passesThrough(cell, beam(80)));
  for (int i = 0; i < 9; ++i) memory.hit(cell, beam(10), Incidence::kAlongNormal);
  EXPECT_FALSE(memory.passesThrough(cell, beam(80))) << "for good";
}

}  // namespace
}  // namespace swiftlet::perception
