// The free space of a building, its surface and the places to stand in it.
#include "mapping3d/voxels/free_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "mapping3d/voxels/floor_growth.hpp"
#include "mapping3d/voxels/free_surface.hpp"
#include "mapping3d/voxels/standing_place.hpp"

namespace swiftlet::mapping3d {
namespace {

constexpr std::size_t kMostQuads = 1'000'000;

BitVolume randomVolume(int width, int depth, int height, double share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution set(share);
  BitVolume volume(width, depth, height);
  for (int z = 0; z < height; ++z)
    for (int y = 0; y < depth; ++y)
      for (int x = 0; x < width; ++x)
        if (set(random)) volume.set(x, y, z);
  return volume;
}

template <typename Take>
void forEachVoxel(const BitVolume& volume, Take&& take) {
  for (int z = 0; z < volume.height(); ++z)
    for (int y = 0; y < volume.depth(); ++y)
      for (int x = 0; x < volume.width(); ++x) take(x, y, z);
}

TEST(BitVolume, DilatesAsTheSlowWay) {
  for (const int radius : {0, 1, 3}) {
    const BitVolume before = randomVolume(131, 9, 7, 0.005, 3);
    BitVolume after = before;
    after.dilate(radius);
    forEachVoxel(before, [&](int x, int y, int z) {
      bool expected = false;
      for (int i = -radius; i <= radius; ++i)
        for (int j = -radius; j <= radius; ++j)
          for (int k = -radius; k <= radius; ++k) expected = expected || before.at(x + i, y + j, z + k);
      ASSERT_EQ(after.at(x, y, z), expected) << x << ' ' << y << ' ' << z << " radius " << radius;
    });
  }
}

TEST(BitVolume, InvertedAndTransposedHasEachVoxel) {
  const BitVolume volume = randomVolume(70, 65, 3, 0.4, 5);
  BitVolume turned = volume.transposed();
  turned.invert();
  EXPECT_EQ(turned.count(), 70u * 65u * 3u - volume.count());
  forEachVoxel(volume, [&](int x, int y, int z) { ASSERT_NE(turned.at(y, x, z), volume.at(x, y, z)); });
}

/// A face of a voxel: its lower corner, the axis of its normal, and whether free space is on the greater side.
using Face = std::tuple<int, int, int, int, bool>;

std::map<Face, int> facesOfQuads(const FreeSpace& space, const std::vector<Quad>& quads) {
  std::map<Face, int> faces;
  for (const Quad& quad : quads) {
    const Eigen::Vector3d normal = (quad[1] - quad[0]).cross(quad[2] - quad[0]).cast<double>();
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    Eigen::Vector3i low, high;
    for (int i = 0; i < 3; ++i) {
      const auto index = [&](float at) {
        return static_cast<int>(std::lround((static_cast<double>(at) - space.corner_m[i]) / space.voxel_m[i]));
      };
      low[i] = index(std::min(quad[0][i], quad[2][i]));
      high[i] = index(std::max(quad[0][i], quad[2][i]));
    }
    high[axis] = low[axis] + 1;
    for (int x = low.x(); x < high.x(); ++x)
      for (int y = low.y(); y < high.y(); ++y)
        for (int z = low.z(); z < high.z(); ++z) ++faces[{x, y, z, axis, normal[axis] > 0.0}];
  }
  return faces;
}

TEST(FreeSurface, HasEachFaceOfFreeVoxelsOnce) {
  for (const double share : {0.05, 0.5, 0.95}) {
    FreeSpace space;
    space.free = randomVolume(70, 11, 6, share, 7);
    space.corner_m = {-3.0, 2.0, 0.5};
    space.voxel_m = {0.1, 0.1, 0.2};
    std::map<Face, int> expected;
    forEachVoxel(space.free, [&](int x, int y, int z) {
      if (!space.free.at(x, y, z)) return;
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3i step = Eigen::Vector3i::Zero();
        step[axis] = 1;
        if (!space.free.at(x - step.x(), y - step.y(), z - step.z())) expected[{x, y, z, axis, true}] = 1;
        if (!space.free.at(x + step.x(), y + step.y(), z + step.z()))
          expected[{x + step.x(), y + step.y(), z + step.z(), axis, false}] = 1;
      }
    });
    EXPECT_EQ(facesOfQuads(space, surfaceOf(space, kMostQuads)), expected) << share;
  }
}

TEST(FreeSurface, OfABoxIsSixRectangles) {
  FreeSpace space;
  space.free = BitVolume(100, 40, 20);
  space.free.invert();
  EXPECT_EQ(surfaceOf(space, kMostQuads).size(), 6u);
}

TEST(FreeSpace, UnknownPartsAreFreeWhereNothingWasMeasured) {
  common::OccupancyGrid plan = common::makeOccupancyGrid(0.1);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) plan.set({x, y}, -50);
  for (const auto& [x, y] : {std::pair{2, 2}, {6, 6}, {6, 7}, {7, 6}, {7, 7}})
    plan.set({x, y}, common::occupancy::kUnknown);
  for (const auto& [x, y] : {std::pair{2, 9}, {2, 10}, {3, 9}, {3, 10}}) plan.set({x, y}, common::occupancy::kUnknown);
  plan.set({4, 9}, 50);
  plan.set({9, 2}, 50);
  const FreeSpace space = freeSpaceOf(plan, 2.0);
  EXPECT_TRUE(space.free.at(2, 2, 0)) << "a speck";
  EXPECT_TRUE(space.free.at(6, 6, 0)) << "a wall in it would have been measured";
  EXPECT_FALSE(space.free.at(2, 9, 0)) << "what is behind a wall may be matter";
  EXPECT_FALSE(space.free.at(9, 2, 0)) << "matter of the size of a speck";
  EXPECT_EQ(space.free.count(), 144u - 6u);
}

/// A hollow box of points with this spacing, 4 x 3 x 2 m, its floor at 0.
std::vector<common::SurfacePoint> hollowBox(double spacing_m, bool with_floor = true) {
  std::vector<common::SurfacePoint> points;
  const Eigen::Vector3i last = (Eigen::Vector3d(4.0, 3.0, 2.0) / spacing_m).array().round().cast<int>();
  for (int x = 0; x <= last.x(); ++x)
    for (int y = 0; y <= last.y(); ++y)
      for (int z = 0; z <= last.z(); ++z) {
        const bool side = x == 0 || y == 0 || x == last.x() || y == last.y() || z == last.z();
        if (side || (z == 0 && with_floor))
          points.emplace_back().position_m = (Eigen::Vector3d(x, y, z) * spacing_m).cast<float>();
      }
  return points;
}

TEST(FreeSpace, TheSpacingOfALatticeIsFound) { EXPECT_NEAR(spacingOf_m(hollowBox(0.1), 0.5), 0.1, 1e-3); }

TEST(FreeSpace, AHoleIsOpenUntilItIsClosed) {
  std::vector<common::SurfacePoint> points = hollowBox(0.1);
  std::erase_if(points, [](const common::SurfacePoint& point) {
    return point.position_m.x() == 0.0F && (point.position_m.tail<2>() - Eigen::Vector2f(1.5F, 1.0F)).norm() < 0.16F;
  });
  for (const auto& [radius, open] : {std::pair{0, true}, {1, true}, {2, false}}) {
    FreeSpace space = spaceAround(points, 0.1, 4);
    closeHoles(space, radius);
    const Eigen::Vector3d middle = (Eigen::Vector3d(2.0, 1.5, 1.0) - space.corner_m) / 0.1;
    EXPECT_EQ(keepConnected(space,
                            {static_cast<int>(middle.x()), static_cast<int>(middle.y()), static_cast<int>(middle.z())}),
              open)
        << radius;
  }
}

TEST(StandingPlace, IsOnTheFloorThatIsMeantAndHasRoom) {
  FreeSpace space = spaceAround(hollowBox(0.1), 0.1, 4);
  closeHoles(space, 1);  // Rounding leaves a voxel without a point here and there.
  const StandingRoom room;
  const auto inside = floorAt(space, {1.25, 1.05}, room, std::nullopt);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->floor_m.z(), 0.1, 0.051) << "the top of the voxel";
  EXPECT_NEAR(inside->ceiling_m, 2.0, 0.051);
  EXPECT_TRUE(inside->floor_measured && inside->ceiling_measured);
  const auto beside_wall = nearestStandingPlace(space, {0.1, 1.5}, room);
  ASSERT_TRUE(beside_wall);
  EXPECT_GT(beside_wall->floor_m.x(), room.radius_m);
  EXPECT_LT(beside_wall->floor_m.x(), room.radius_m + 0.35);
  EXPECT_FALSE(nearestStandingPlace(space, {2.0, 1.5}, {.radius_m = 1.6, .height_m = 1.0, .feet_radius_m = 0.2}));
}

/// A hall of 8 x 4 m, its floor at 0.5 m with a hole of a metre, a table, and a wall at x = 6 m with a gap on the
/// floor.
std::vector<common::SurfacePoint> hall() {
  std::vector<common::SurfacePoint> points;
  const auto add = [&](int x, int y, int z) {
    points.emplace_back().position_m = (Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5) * 0.1).cast<float>();
  };
  for (int x = 0; x < 80; ++x) {
    for (int y = 0; y < 40; ++y) {
      const bool hole = x >= 15 && x < 25 && y >= 15 && y < 25;
      if (!hole) add(x, y, (x + y) % 7 == 0 ? 5 : 4);  // With the noise of a scan.
      if (x >= 40 && x < 45 && y >= 15 && y < 25) add(x, y, 12);
      add(x, y, 30);
      for (int z = 5; z < 30; ++z)
        if (x == 0 || y == 0 || x == 79 || y == 39 || (x == 60 && z > 8)) add(x, y, z);
    }
  }
  return points;
}

TEST(FloorGrowth, FillsAHoleLevelsNoiseAndKeepsWhatStandsOnTheFloor) {
  FreeSpace space = spaceAround(hall(), 0.1, 4);
  ASSERT_TRUE(growFloor(space, {2.0, 2.0}, {}, 0.25, std::nullopt));
  const auto voxel = [&](double x_m, double y_m, double z_m) {
    const Eigen::Vector3d at = (Eigen::Vector3d(x_m, y_m, z_m) - space.corner_m) / 0.1;
    return space.free.at(static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z()));
  };
  for (double x_m = 0.45; x_m < 5.6; x_m += 0.1) {
    for (double y_m = 0.45; y_m < 3.6; y_m += 0.1) {
      const bool below_table = x_m > 3.9 && x_m < 4.6 && y_m > 1.4 && y_m < 2.6;
      EXPECT_TRUE(below_table || voxel(x_m, y_m, 0.55)) << x_m << ' ' << y_m;
      EXPECT_FALSE(voxel(x_m, y_m, 0.45)) << x_m << ' ' << y_m;
    }
  }
  EXPECT_FALSE(voxel(4.25, 2.05, 1.25)) << "the table";
  EXPECT_TRUE(voxel(4.25, 2.05, 1.35));
  EXPECT_FALSE(keepConnected(space, {15, 15, 15}));
  EXPECT_FALSE(growFloor(space, {50.0, 2.0}, {}, 0.25, std::nullopt)) << "no floor there";
}

TEST(FloorGrowth, IsFreeBelowWhatAnOctreeKnowsToBeFree) {
  common::VoxelMap map(0.1);
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      for (int z = 0; z < 25; ++z) {
        // A scanner at a height of 1 m sees nothing of a cone below it.
        const bool seen = std::hypot(x - 30, y - 30) >= 10 - z;
        if (seen) map.set({x, y, z}, static_cast<std::int8_t>(z == 0 || z == 24 ? 70 : -40));
      }
  FreeSpace space = freeSpaceOf(map);
  const auto floor_m = [&] { return floorAt(space, {3.0, 3.0}, {}, std::nullopt)->floor_m.z(); };
  EXPECT_GT(floor_m(), 0.8);
  ASSERT_TRUE(growFloor(space, {3.0, 3.0}, {}, 0.25, std::nullopt));
  EXPECT_NEAR(floor_m(), 0.1, 1e-9);
}

TEST(StandingPlace, IsNowhereWithoutAFloor) {
  FreeSpace space = spaceAround(hollowBox(0.1, false), 0.1, 4);
  closeHoles(space, 1);
  EXPECT_FALSE(floorAt(space, {2.0, 1.5}, {}, std::nullopt));
  EXPECT_FALSE(nearestStandingPlace(space, {2.0, 1.5}, {}));
  EXPECT_NEAR(raiseFloor(space, 0.3), 0.3, 0.051);
  EXPECT_TRUE(floorAt(space, {2.0, 1.5}, {}, std::nullopt));
}

}  // namespace
}  // namespace swiftlet::mapping3d
