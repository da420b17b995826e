// Ground that rises into the plane of the laser's fan: told from walls by end points from several heights.
#include "perception/altitude/fan_ground.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

/// The range at which a level beam at a height ends.
using Ranges = std::function<double(double bearing_rad, double height_m)>;

constexpr double kFoot_m = 3.0;

double acrossRoom_m(double bearing_rad) { return std::min(9.0 / std::cos(bearing_rad), 9.0); }

/// Somebody 0.6 m wide, 2 m ahead, who walks away while the vehicle rises by `gradient` metres a metre.
Ranges walker(double gradient) {
  return [gradient](double bearing_rad, double height_m) {
    const double ahead_m = 2.0 + (height_m - 1.0) / gradient;
    return std::abs(ahead_m * std::tan(bearing_rad)) < 0.3 ? ahead_m / std::cos(bearing_rad)
                                                           : acrossRoom_m(bearing_rad);
  };
}

/// A ramp ahead, 2.4 m wide, that rises by 1 m; behind it a room.
Ranges ramp(double gradient) {
  return [gradient](double bearing_rad, double height_m) {
    const double ahead_m = kFoot_m + height_m / gradient, range_m = ahead_m / std::cos(bearing_rad);
    return height_m < 1.0 && std::abs(ahead_m * std::tan(bearing_rad)) < 1.2 ? range_m : acrossRoom_m(bearing_rad);
  };
}

class ClimbBefore : public testing::Test {
 protected:
  ProjectedScan scanAt(double height_m, const Ranges& ranges_m) {
    ProjectedScan scan;
    scan.stamp = common::Time::fromSeconds(1.0 + height_m / 0.4);
    scan.T_odom_body.position_m.z() = height_m;
    for (double bearing_rad = -0.8; bearing_rad < 0.8; bearing_rad += 0.25 * common::kRadPerDeg) {
      const double range_m = ranges_m(bearing_rad, height_m) + random_.gaussian(0.01);
      scan.points_level_m.emplace_back(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
      scan.heights_level_m.push_back(0.0F);
    }
    scan.counts.hits = static_cast<int>(scan.points_level_m.size());
    return scan;
  }
  void climb(double from_m, double to_m, const Ranges& ranges_m) {
    for (double height_m = from_m; height_m < to_m; height_m += 0.01)
      fan_.add(scanAt(height_m, ranges_m), {}, height_m, 0.0);
  }
  /// End points ahead and nearer than the room behind.
  static int near(const ProjectedScan& scan) {
    int points = 0;
    for (const Eigen::Vector2f& point_m : scan.points_level_m)
      points += point_m.x() < 7.0F && std::abs(point_m.y()) < 1.0F ? 1 : 0;
    return points;
  }

  common::RandomStream random_{5, "fan"};
  FanGround fan_;
};

TEST_F(ClimbBefore, ARampIsGroundAlsoWhereTheFanHasNotMetItYet) {
  climb(0.15, 0.5, ramp(0.268));
  ProjectedScan scan = scanAt(0.55, ramp(0.268));
  const int before = near(scan), hits = scan.counts.hits;
  ASSERT_GT(before, 50);
  fan_.remove(scan);
  EXPECT_LE(near(scan), before / 5) << "at its edges fewer cells know the ramp";
  EXPECT_EQ(scan.counts.hits + scan.counts.floor_hits, hits);
  EXPECT_EQ(scan.points_level_m.size(), scan.heights_level_m.size());
  EXPECT_EQ(static_cast<int>(scan.misses_level_m.size()), scan.counts.floor_hits);
}

TEST_F(ClimbBefore, AWallOrACornerIsNone) {
  const Ranges corner = [](double bearing_rad, double) {
    return bearing_rad > 0.0 ? 4.0 / std::cos(bearing_rad - 0.3) : 4.0 / std::cos(bearing_rad + 0.6);
  };
  climb(0.15, 1.2, corner);
  ProjectedScan scan = scanAt(1.0, corner);
  fan_.remove(scan);
  EXPECT_EQ(scan.counts.floor_hits, 0);
}

TEST_F(ClimbBefore, WhatIsTooSteepForGroundIsNone) {
  climb(0.15, 1.0, ramp(0.8));
  ProjectedScan scan = scanAt(0.5, ramp(0.8));
  fan_.remove(scan);
  EXPECT_EQ(scan.counts.floor_hits, 0);
}

/// Below 27 cm over a ramp of 15 degrees the vehicle must not go on.
TEST_F(ClimbBefore, GroundThatIsNearStaysAnObstacle) {
  climb(0.15, 1.0, ramp(0.268));
  ProjectedScan scan = scanAt(0.2, ramp(0.268));
  for (Eigen::Vector2f& point_m : scan.points_level_m) point_m.x() -= 3.0F;
  scan.T_odom_body.position_m.x() = 3.0;
  const auto close = [&] {
    return std::count_if(scan.points_level_m.begin(), scan.points_level_m.end(),
                         [](const Eigen::Vector2f& point_m) { return point_m.norm() < 1.0F; });
  };
  const auto before = close();
  ASSERT_GT(before, 50);
  fan_.remove(scan);
  EXPECT_EQ(close(), before);
}

TEST_F(ClimbBefore, APersonWhoWalksAwayIsNone) {
  climb(1.0, 1.3, walker(0.25));
  ProjectedScan scan = scanAt(1.15, walker(0.25));
  ASSERT_GT(near(scan), 50);
  fan_.remove(scan);
  EXPECT_EQ(scan.counts.floor_hits, 0);
}

TEST_F(ClimbBefore, WhatMovesTellsNothing) {
  for (double height_m = 0.15; height_m < 0.5; height_m += 0.01) {
    ProjectedScan scan = scanAt(height_m, ramp(0.268));
    scan.moves.assign(scan.points_level_m.size(), true);
    fan_.add(scan, {}, height_m, 0.0);
  }
  ProjectedScan scan = scanAt(0.55, ramp(0.268));
  fan_.remove(scan);
  EXPECT_EQ(scan.counts.floor_hits, 0);
}

TEST_F(ClimbBefore, HoveringTellsNothing) {
  for (int i = 0; i < 200; ++i) fan_.add(scanAt(0.5, ramp(0.268)), {}, 0.5, 0.0);
  ProjectedScan scan = scanAt(0.5, ramp(0.268));
  fan_.remove(scan);
  EXPECT_EQ(scan.counts.floor_hits, 0);
}

}  // namespace
}  // namespace swiftlet::perception
