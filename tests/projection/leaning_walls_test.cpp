#include "perception/projection/leaning_walls.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose3;
using Eigen::Vector3d;

/// Half the width of the room at a height.
using HalfWidth = std::function<double(double height_m)>;

constexpr double kNoise_m = 0.01;

/// Scan of a passage along x between two walls, with the laser in the middle of a body that is rolled.
ProjectedScan scanOf(const HalfWidth& half_width_m, const Pose3& T_odom_body, common::RandomStream& random) {
  ProjectedScan scan;
  scan.T_odom_body = T_odom_body;
  const common::Pose2 level = common::planar(T_odom_body);
  for (int degrees = -135; degrees <= 135; ++degrees) {
    const double bearing_rad = degrees * common::kRadPerDeg;
    const Vector3d beam = T_odom_body.rotation * Vector3d(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
    // The first of the small steps along the beam that is in a wall.
    for (double range_m = 0.3; range_m < 6.0; range_m += 0.002) {
      const Vector3d end = T_odom_body.position_m + range_m * beam;
      if (std::abs(end.y()) < half_width_m(end.z())) continue;
      const Vector3d noisy = T_odom_body.position_m + (range_m + kNoise_m * random.gaussian()) * beam;
      scan.points_level_m.push_back((level.inverse() * Eigen::Vector2d(noisy.head<2>())).cast<float>());
      scan.heights_level_m.push_back(static_cast<float>(noisy.z() - T_odom_body.position_m.z()));
      break;
    }
  }
  scan.counts.hits = static_cast<int>(scan.points_level_m.size());
  return scan;
}

Pose3 rolled(double height_m, double roll_deg) {
  return {common::quaternionFrom({roll_deg * common::kRadPerDeg, 0.0, 0.4}), {0.2, 0.3, height_m}};
}

/// What has been learned in a climb to 1 m while the vehicle rolls to and fro.
LeaningWalls climbedIn(const HalfWidth& half_width_m) {
  LeaningWalls walls;
  common::RandomStream random(7, "leaning walls");
  for (int i = 0; i < 120; ++i) {
    const Pose3 pose = rolled(0.4 + 0.005 * i, 4.0 * std::sin(0.3 * i));
    walls.add(scanOf(half_width_m, pose, random), pose);
  }
  return walls;
}

/// The greatest of the smallest 95 % of the distances of the ends from the walls at a height.
double errorAt_m(const ProjectedScan& scan, const HalfWidth& half_width_m, double height_m) {
  std::vector<double> errors_m;
  for (const Eigen::Vector2f& point : scan.points_level_m) {
    const Eigen::Vector2d place = common::planar(scan.T_odom_body) * Eigen::Vector2d(point.cast<double>());
    errors_m.push_back(std::abs(std::abs(place.y()) - half_width_m(height_m)));
  }
  std::sort(errors_m.begin(), errors_m.end());
  return errors_m.at(errors_m.size() * 95 / 100);
}

TEST(LeaningWalls, AScanUnderARoofBecomesASection) {
  for (const double slope : {0.5, 1.0, 1.5}) {
    const HalfWidth roof = [&](double height_m) { return 2.5 - slope * (height_m - 1.0); };
    const LeaningWalls walls = climbedIn(roof);
    ASSERT_TRUE(walls.any());
    common::RandomStream random(8, "leaning walls");
    const ProjectedScan tilted = scanOf(roof, rolled(1.0, 5.0), random);
    EXPECT_GT(errorAt_m(tilted, roof, 1.0), 0.1 * slope);
    const ProjectedScan section = walls.atHeight(tilted, 1.0);
    EXPECT_LT(errorAt_m(section, roof, 1.0), 0.05) << "slope " << slope;
    EXPECT_GT(section.points_level_m.size(), tilted.points_level_m.size() * 9 / 10);
  }
}

TEST(LeaningWalls, WallsThatStandUprightStayAsTheyWereMeasured) {
  const HalfWidth upright = [](double) { return 1.5; };
  const LeaningWalls walls = climbedIn(upright);
  EXPECT_FALSE(walls.any());
}

TEST(LeaningWalls, AShelfIsNotALeaningWall) {
  const HalfWidth shelf = [](double height_m) { return height_m < 0.8 ? 1.2 : 1.5; };
  const LeaningWalls walls = climbedIn(shelf);
  common::RandomStream random(9, "leaning walls");
  const ProjectedScan tilted = scanOf(shelf, rolled(1.0, 5.0), random);
  const ProjectedScan same = walls.atHeight(tilted, 1.0);
  ASSERT_EQ(same.points_level_m.size(), tilted.points_level_m.size());
  for (std::size_t i = 0; i < same.points_level_m.size(); ++i)
    EXPECT_LT((same.points_level_m[i] - tilted.points_level_m[i]).norm(), 1e-4F);
}

TEST(LeaningWalls, SomebodyBeforeALeaningWallStaysWhereTheyAre) {
  const HalfWidth roof = [](double height_m) { return 2.5 - (height_m - 1.0); };
  const LeaningWalls walls = climbedIn(roof);
  ProjectedScan scan;
  scan.T_odom_body = rolled(1.0, 5.0);
  const common::Pose2 level = common::planar(scan.T_odom_body);
  const Eigen::Vector2d person(0.5, 1.6);
  scan.points_level_m.push_back((level.inverse() * person).cast<float>());
  scan.heights_level_m.push_back(0.3F);
  const ProjectedScan section = walls.atHeight(scan, 1.0);
  ASSERT_EQ(section.points_level_m.size(), 1U);
  EXPECT_EQ(section.points_level_m[0], scan.points_level_m[0]);
}

/// The post of a door with a person in it: in one cell, what is met higher is farther away.
TEST(LeaningWalls, WhatLeansInOnePlaceOnlyIsNoWall) {
  for (const double length_m : {0.28, 1.2}) {
    LeaningWalls walls;
    common::RandomStream random(10, "leaning walls");
    for (int i = 0; i < 200; ++i) {
      ProjectedScan scan;
      scan.T_odom_body.position_m.z() = 0.8 + 0.002 * i;
      for (double along_m = 0.01; along_m < length_m; along_m += 0.02) {
        const double beside_m = 1.05 + 0.5 * (scan.T_odom_body.position_m.z() - 1.0) + kNoise_m * random.gaussian();
        scan.points_level_m.push_back(Eigen::Vector2d(along_m, beside_m).cast<float>());
        scan.heights_level_m.push_back(0.0F);
      }
      walls.add(scan, scan.T_odom_body);
    }
    EXPECT_EQ(walls.any(), length_m > 1.0) << length_m;
  }
}

}  // namespace
}  // namespace swiftlet::perception
