// Clearance against the slow, obvious way: every voxel of a dense box.
#include "mapping3d/voxels/clearance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "mapping3d/voxels/voxel_mapper.hpp"
#include "tests/mapping3d/rooms.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::UnknownSpace;
using common::UprightHull;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector3d;

constexpr UprightHull kHull{0.275, 0.25};
constexpr double kGreatest_m = 0.6;

double number(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

/// A room as some frames show it.
VoxelMapper seenRoom(unsigned seed) {
  std::mt19937 random(seed);
  const Room room = randomRoom(random);
  VoxelMapper mapper(VoxelConfig{});
  for (int frame = 0; frame < 4; ++frame) {
    const common::Pose3 T_map_camera = randomView(room, random);
    mapper.insert(depthImage(room, smallCamera(), T_map_camera, random), smallCamera(), T_map_camera);
  }
  return mapper;
}

/// The nearest point of each voxel to the axis of the hull, without blocks, bits or bounds. `ignores_height` is a
/// mistake.
double bruteForce_m(const VoxelMap& map, const Vector3d& center_m, UnknownSpace unknown, bool ignores_height = false) {
  const double reach_m = kGreatest_m + kHull.radius_m + 0.1;
  const VoxelIndex low = map.voxelAt(center_m.array() - reach_m), high = map.voxelAt(center_m.array() + reach_m);
  double least_m = kGreatest_m;
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const VoxelIndex voxel{x, y, z};
        if (!map.isOccupied(voxel) && (unknown == UnknownSpace::kFree || map.isKnown(voxel))) continue;
        const Vector3d first_m = Vector3d(x, y, z) * map.resolution_m();
        const Vector3d nearest_m = center_m.cwiseMax(first_m).cwiseMin((first_m.array() + map.resolution_m()).matrix());
        const Vector3d away_m = nearest_m - center_m;
        const double beside_m = std::max(0.0, away_m.head<2>().norm() - kHull.radius_m);
        const double half_m = ignores_height ? 0.0 : 0.5 * kHull.height_m;
        const double above_m = std::max(0.0, std::abs(away_m.z()) - half_m);
        least_m = std::min(least_m, std::hypot(beside_m, above_m));
      }
  return least_m;
}

/// The greatest difference at random places.
double differenceAt(unsigned seed, int places, UnknownSpace unknown, bool ignores_height = false) {
  VoxelMapper mapper = seenRoom(seed);
  const auto map = std::make_shared<const VoxelMap>(mapper.snapshot());
  ClearanceField field(map, kGreatest_m);
  std::mt19937 random(seed + 1000);
  double greatest_m = 0.0;
  for (int i = 0; i < places; ++i) {
    const Vector3d center_m(number(random, -3.5, 4.5), number(random, -2.5, 3.5), number(random, -0.2, 2.7));
    greatest_m = std::max(greatest_m, std::abs(field.clearance_m(center_m, kHull, unknown) -
                                               bruteForce_m(*map, center_m, unknown, ignores_height)));
  }
  return greatest_m;
}

class ClearanceOf : public testing::TestWithParam<UnknownSpace> {};
INSTANTIATE_TEST_SUITE_P(Unknown, ClearanceOf, testing::Values(UnknownSpace::kFree, UnknownSpace::kOccupied));

TEST_P(ClearanceOf, AHullEqualsBruteForce) {
  for (unsigned seed = 1; seed <= 3; ++seed) EXPECT_LT(differenceAt(seed, 150, GetParam()), 1e-9) << seed;
}

TEST(ClearanceField, TheComparisonFindsAPlantedMistake) {
  EXPECT_GT(differenceAt(1, 150, UnknownSpace::kFree, true), 0.05);
}

TEST_P(ClearanceOf, ASweptHullIsAtMostTheToleranceBelowTheLeastOfManyPlaces) {
  VoxelMapper mapper = seenRoom(5);
  ClearanceField field(std::make_shared<const VoxelMap>(mapper.snapshot()), kGreatest_m);
  std::mt19937 random(6);
  constexpr double kTolerance_m = 0.02;
  constexpr int kPlaces = 2000;
  int clear = 0;
  for (int i = 0; i < 30; ++i) {
    const Vector3d from_m(number(random, -2.5, 3.5), number(random, -1.5, 2.5), number(random, 0.5, 2.0));
    const Vector3d to_m = from_m + Vector3d(number(random, -1, 1), number(random, -1, 1), number(random, -0.3, 0.3));
    const double swept_m = field.sweptClearance_m(from_m, to_m, kHull, GetParam(), kTolerance_m);
    double least_m = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kPlaces; ++k)
      least_m = std::min(least_m, field.clearance_m(from_m + (to_m - from_m) * k / kPlaces, kHull, GetParam()));
    EXPECT_LE(swept_m, least_m + 1e-9);
    EXPECT_GE(swept_m, least_m - kTolerance_m - (to_m - from_m).norm() / kPlaces);
    clear += least_m > 0.0;
  }
  if (GetParam() == UnknownSpace::kFree) {
    EXPECT_GT(clear, 3) << "or nothing was tested";
  }
}

TEST(ClearanceField, FollowsTheMapWhereItChanged) {
  VoxelMap map(0.05);
  for (int x = 0; x < 40; ++x) map.set({x, 0, 0}, -20);
  ClearanceField field(std::make_shared<const VoxelMap>(map.snapshot()), 1.0);
  const Vector3d center_m(0.5, 0.0, 0.0);
  const UprightHull ball{0.0, 0.0};
  EXPECT_DOUBLE_EQ(field.clearance_m(center_m, ball, UnknownSpace::kFree), 1.0);
  map.set({20, 0, 0}, 30);
  field.update(std::make_shared<const VoxelMap>(map.snapshot()));
  EXPECT_NEAR(field.clearance_m(center_m, ball, UnknownSpace::kFree), 0.5, 1e-12);
  map.set({20, 0, 0}, -20);
  field.update(std::make_shared<const VoxelMap>(map.snapshot()));
  EXPECT_DOUBLE_EQ(field.clearance_m(center_m, ball, UnknownSpace::kFree), 1.0);
}

TEST(ClearanceField, PlacesThatAreNoneHaveNoRoom) {
  VoxelMap map(0.05);
  map.set({0, 0, 0}, -20);
  ClearanceField field(std::make_shared<const VoxelMap>(map.snapshot()), 1.0);
  EXPECT_EQ(field.clearance_m({NAN, 0, 0}, kHull, UnknownSpace::kFree), 0.0);
  EXPECT_EQ(field.clearance_m({1e30, 0, 0}, kHull, UnknownSpace::kOccupied), 0.0);
  EXPECT_EQ(field.clearance_m({1e30, 0, 0}, kHull, UnknownSpace::kFree), 1.0);
  field.update(nullptr);
  EXPECT_EQ(field.clearance_m({0, 0, 0}, kHull, UnknownSpace::kOccupied), 0.0);
}

}  // namespace
}  // namespace swiftlet::mapping3d
