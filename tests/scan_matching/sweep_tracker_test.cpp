// Sweeps of a slow laser whose motion cannot be found.
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "perception/laser_odometry/sweep_tracker.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::perception {
namespace {

constexpr double kSweep_s = 0.15;

/// What a laser with a full turn sees from a pose that turns at a constant rate.
std::vector<SweptPoint> sweepFrom(const test::PlanarWorld& world, const common::Pose2& start, double rate_rad_s) {
  constexpr int kBeams = 360;
  std::vector<SweptPoint> points;
  for (int i = 0; i < kBeams; ++i) {
    const double share = static_cast<double>(i) / (kBeams - 1);
    const double bearing_rad = 2.0 * std::numbers::pi * i / kBeams;
    const double angle_rad = start.yaw_rad + rate_rad_s * share * kSweep_s + bearing_rad;
    const double range_m = world.cast({start.x_m, start.y_m, 1.0}, {std::cos(angle_rad), std::sin(angle_rad), 0.0});
    points.push_back({{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)}, share});
  }
  return points;
}

TEST(SweepTracker, BeginsAnewAfterASweepThatFitsNoneBefore) {
  test::PlanarWorld room, hall;
  room.addBox(0.0, 0.0, 6.0, 4.0);
  room.addBox(4.0, 3.0, 0.5, 0.5);
  hall.addBox(-9.0, -11.0, 24.0, 19.0);
  hall.addBox(2.0, -4.0, 1.0, 2.5);
  constexpr int kEach = 8;
  constexpr double kRate_rad_s = 0.8;
  SweepTracker tracker;
  std::vector<std::optional<SweepMotion>> motions;
  const auto takeAll = [&] {
    while (tracker.hasNext()) motions.push_back(tracker.take());
  };
  for (int k = 0; k < 2 * kEach; ++k) {
    const double t = k * kSweep_s;
    tracker.add(sweepFrom(k < kEach ? room : hall, {2.0, 1.5, kRate_rad_s * t}, kRate_rad_s),
                common::Time::fromSeconds(t), kSweep_s);
    takeAll();
  }
  tracker.finish();
  takeAll();
  ASSERT_EQ(motions.size(), 2U * kEach) << "each sweep is taken once, in order";
  EXPECT_FALSE(motions[kEach].has_value());
  int lost = 0;
  for (const auto& motion : motions) {
    lost += motion ? 0 : 1;
    if (!motion) continue;
    EXPECT_NEAR((motion->at(1.0).yaw_rad - motion->at(0.0).yaw_rad) / kSweep_s, kRate_rad_s, 0.1);
  }
  EXPECT_LE(lost, 3);
  EXPECT_TRUE(motions.back().has_value());
}

}  // namespace
}  // namespace swiftlet::perception
