// Openings where no camera shows depths: in the scan of the level laser, in the axes of whoever asks.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "perception/recognition/known_objects.hpp"

namespace swiftlet::perception {
namespace {

/// A wall of 6 m at x = 4 m with an opening of 1 m in its middle, and a room of 4 m behind it.
common::LaserScan wallWithADoor() {
  common::LaserScan scan;
  scan.angle_min_rad = -0.75 * std::numbers::pi;
  scan.angle_increment_rad = std::numbers::pi / 720.0;
  scan.range_min_m = 0.1;
  scan.range_max_m = 30.0;
  for (int i = 0; i < 1081; ++i) {
    const double angle_rad = scan.angle_min_rad + i * scan.angle_increment_rad;
    const double to_wall_m = 4.0 / std::cos(angle_rad), y_m = to_wall_m * std::sin(angle_rad);
    const bool hits = std::cos(angle_rad) > 0.05 && std::abs(y_m) < 3.0;
    const double hit_m = std::abs(y_m) < 0.5 ? 2.0 * to_wall_m : to_wall_m;
    scan.ranges_m.push_back(static_cast<float>(hits ? hit_m : std::numeric_limits<double>::infinity()));
  }
  return scan;
}

KnownObjects onlyOpenings() {
  KnownObjectConfig config;
  config.name = kOpenings;
  return *KnownObjects::create({config}, OpeningConfig{});
}

TEST(ScanOpenings, AnOpeningIsInTheAxesOfTheCamera) {
  const common::LaserScan scan = wallWithADoor();
  Observation observation;
  observation.scan = &scan;
  observation.T_camera_laser = {common::quaternionFrom({0.0, 0.0, 0.5 * std::numbers::pi}), {0.1, 0.0, 0.2}};
  const auto found = onlyOpenings().recognize(observation);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what, "opening");
  EXPECT_EQ(found[0].passage, Passage::kOpen);
  EXPECT_NEAR(found[0].size_m.x(), 1.0, 0.08);
  EXPECT_LT((found[0].T_sensor_object.position_m - Eigen::Vector3d(0.1, 4.0, 0.2)).norm(), 0.06);
  EXPECT_LT((found[0].T_sensor_object.rotation * Eigen::Vector3d::UnitX()).y(), -0.99)
      << "its normal points to the laser";
  EXPECT_GT(found[0].covariance(3, 3), found[0].covariance(4, 4)) << "it is known worse along the wall";
}

TEST(ScanOpenings, ATiltedScanIsLeftOut) {
  const common::LaserScan scan = wallWithADoor();
  Observation observation;
  observation.scan = &scan;
  observation.R_level_camera = common::quaternionFrom({0.0, 0.15, 0.0});
  EXPECT_TRUE(onlyOpenings().recognize(observation).empty());
}

}  // namespace
}  // namespace swiftlet::perception
