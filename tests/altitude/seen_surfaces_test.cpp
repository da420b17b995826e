// What the beams below met, cell by cell.
#include "perception/altitude/seen_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

TEST(SeenSurfaces, ACellOverAnEdgeHasBothSurfacesAndNoMixedBeam) {
  SeenSurfaces seen;
  common::RandomStream random(1, "beams");
  for (int i = 0; i < 200; ++i) {
    seen.add({random.uniform(1.0, 1.1), 0.05}, random.gaussian(0.012));
    seen.add({random.uniform(1.0, 1.1), 0.05}, 0.2 + random.gaussian(0.012));
  }
  seen.add({1.05, 0.05}, 0.1);  // It hit the edge.
  seen.add({1.05, 0.05}, std::numeric_limits<double>::quiet_NaN());
  bool floor = false, platform = false;
  for (const common::Level& level : seen.surfaces().levels) {
    ASSERT_EQ(level.cells, std::vector<common::CellIndex>({{10, 0}}));
    floor = floor || std::abs(level.height_m) < 0.03;
    platform = platform || std::abs(level.height_m - 0.2) < 0.03;
    EXPECT_GT(std::abs(level.height_m - 0.1), 0.04);
  }
  EXPECT_TRUE(floor && platform);
}

TEST(SeenSurfaces, AFlatFloorIsOneSurface) {
  SeenSurfaces seen;
  common::RandomStream random(1, "beams");
  for (int i = 0; i < 5000; ++i) seen.add({random.uniform(0.0, 1.0), random.uniform(0.0, 0.2)}, random.gaussian(0.015));
  for (const common::Level& level : seen.surfaces().levels) EXPECT_LT(std::abs(level.height_m), 0.065);
}

common::KeyPoses keysAt(std::uint64_t version, const std::vector<common::Pose2>& poses) {
  common::KeyPoses keys{version, {}};
  for (const common::Pose2& pose : poses) keys.keys.push_back({{}, pose});
  return keys;
}

bool isSeen(const SeenSurfaces& seen, const Eigen::Vector2d& place_map_m, double height_m) {
  const common::LevelMap map = seen.surfaces();
  const common::CellIndex cell{static_cast<int>(std::floor(place_map_m.x() / map.resolution_m)),
                               static_cast<int>(std::floor(place_map_m.y() / map.resolution_m))};
  for (const common::Level& level : map.levels)
    if (std::abs(level.height_m - height_m) < 0.03 &&
        std::find(level.cells.begin(), level.cells.end(), cell) != level.cells.end())
      return true;
  return false;
}

/// A step of 0.2 m that was seen from the second key scan; a loop closure moves and turns that.
TEST(SeenSurfaces, MoveWithTheKeyScansOfTheMap) {
  const common::Pose2 before{4.0, 0.0, 0.0}, after{4.3, -0.2, 0.1};
  SeenSurfaces seen;
  seen.stood({0.0, 0.0}, 0.2, 0.0);
  seen.follow(keysAt(1, {{}, before}), 1);
  seen.stood({5.0, 1.0}, 0.2, 0.2);
  const Eigen::Vector2d corrected_m = after * (before.inverse() * Eigen::Vector2d(5.0, 1.0));
  ASSERT_TRUE(isSeen(seen, {5.0, 1.0}, 0.2));
  seen.follow(keysAt(2, {{}, after}), 1);
  EXPECT_TRUE(isSeen(seen, corrected_m, 0.2));
  EXPECT_FALSE(isSeen(seen, {4.85, 1.0}, 0.2)) << "nothing stays behind";
  EXPECT_TRUE(isSeen(seen, {0.0, 0.0}, 0.0)) << "the take-off place does not move";
  // What is seen of it now belongs to the same surface.
  for (int i = 0; i < 20; ++i) seen.add(corrected_m, 0.2);
  seen.follow(keysAt(3, {{}, before}), 1);
  EXPECT_TRUE(isSeen(seen, {5.0, 1.0}, 0.2)) << "and back";
}

TEST(KeyedCells, ATurnedPatchHasNoHolesAndManyCorrectionsDoNotWearItOff) {
  KeyedCells<int> cells(0.1);
  std::vector<common::Pose2> poses{{}};
  cells.follow(keysAt(1, poses), 0);
  for (int y = -10; y <= 10; ++y)
    for (int x = -10; x <= 10; ++x) cells.at({x, y}).content = 1;
  common::RandomStream random(3, "corrections");
  for (std::uint64_t version = 2; version < 30; ++version) {
    poses[0] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)};
    cells.follow(keysAt(version, poses), 0);
    for (double y_m = -0.9; y_m < 0.95; y_m += 0.05)
      for (double x_m = -0.9; x_m < 0.95; x_m += 0.05) {
        int found = 0;
        cells.visit(cells.cellAt(poses[0] * Eigen::Vector2d(x_m, y_m)), [&](const auto&) { ++found; });
        ASSERT_GE(found, 1) << version << ": " << x_m << " " << y_m;
      }
  }
}

}  // namespace
}  // namespace swiftlet::perception
