// Errors of the laser beyond its data sheet: mount, clock, edges, dark surfaces, sun and glass.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "laser_fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::kRadPerDeg;
using common::Time;

const common::Pose3 kMiddle{Eigen::Quaterniond::Identity(), {0, 0, 1}};

common::LaserScan scanOf(const LaserErrorsConfig& errors, const WorldModel& world,
                         const std::vector<Actor>& actors = {}) {
  LaserScanner laser(quietLaser(), errors, world, 1);
  return laser.scan(0, Time(), still(kMiddle, actors), RayCaster(world));
}

double angleOf(const common::LaserScan& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.angle_increment_rad;
}

/// The room with a wall of another colour.
WorldModel roomWith(const std::string& wall, float grey) {
  WorldModel world = boxRoom();
  for (Shape& shape : world.shapes)
    if (shape.model == wall) shape.color = Color::Constant(grey);
  return world;
}

/// The room with a pane of glass 2 m ahead, 4 m wide.
WorldModel roomWithPane() {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("pane", {2.0, -2.0, 0.0}, {2.006, 2.0, 3.0}));
  world.shapes.back().glass = true;
  return world;
}

TEST(LaserErrors, NoneByDefault) {
  const WorldModel world = roomWithPane();
  LaserScanner sheet(quietLaser(), 1);
  EXPECT_EQ(scanOf({}, world).ranges_m, sheet.scan(0, Time(), still(kMiddle), RayCaster(world)).ranges_m);
}

TEST(LaserErrors, AMountErrorMovesAndTurnsTheBeamsButNotTheirNumbers) {
  const common::LaserScan scan = scanOf({.mount_error = {.x_m = 0.1, .yaw_deg = 2.0}}, boxRoom());
  EXPECT_EQ(scan.angle_min_rad, quietLaser().angleMin_rad());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
    EXPECT_NEAR(scan.ranges_m[i], rangeInRoom({0.1, 0.0}, angleOf(scan, i) + 2.0 * kRadPerDeg), 0.0007) << i;
}

TEST(LaserErrors, TheClockIsAheadAndGains) {
  const WorldModel world = boxRoom();
  LaserScanner laser(quietLaser(), {.mount_error = {}, .clock_offset_s = 0.004, .clock_drift_ppm = 20.0}, world, 1);
  const Time start = Time::fromSeconds(100.0);
  const std::vector<Moment> track = {{start, kMiddle, {}}, {Time::fromSeconds(100.1), kMiddle, {}}};
  const common::LaserScan scan = laser.scan(0, start, track, RayCaster(world));
  EXPECT_NEAR(scan.stamps.measured.seconds(), 100.0 + 0.004 + 20e-6 * 100.0, 1e-9);
}

TEST(LaserErrors, BiasGrowsWithTheAngleOfIncidence) {
  const common::LaserScan scan = scanOf({.mount_error = {}, .incidence_bias_m = 0.01}, boxRoom());
  for (const double angle_deg : {0.0, 20.0, 35.0}) {  // On the wall ahead.
    const auto beam = static_cast<std::size_t>(std::lround((135.0 + angle_deg) / 0.25));
    const double angle_rad = angleOf(scan, beam), bias_m = 0.01 * (1.0 / std::cos(angle_rad) - 1.0);
    EXPECT_NEAR(scan.ranges_m[beam] - rangeInRoom({0, 0}, angle_rad), bias_m, 0.0007) << angle_deg;
  }
}

TEST(LaserErrors, SomeBeamsAtAnEdgeReadBetweenTheTwoSurfaces) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("pillar", {2.0, -0.3, 0.0}, {2.6, 0.3, 3.0}));
  const RayCaster rays(world);
  const auto between = [&](double rate) {  // Beams of 100 scans that read no surface.
    LaserScanner laser(quietLaser(), {.mount_error = {}, .mixed_pixel_rate = rate}, world, 1);
    int count = 0;
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
      const common::LaserScan scan = laser.scan(frame, Time(), still(kMiddle), rays);
      for (std::size_t i = 480; i <= 600; ++i) count += scan.ranges_m[i] > 2.05F && scan.ranges_m[i] < 4.95F ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(between(0.0), 0);
  EXPECT_NEAR(between(1.0), 200, 15) << "one at each edge of the pillar; few of them beside a surface";
  EXPECT_NEAR(between(0.3), 60, 20);
}

TEST(LaserErrors, ABlackSurfaceReturnsNothingFromFarAway) {
  const LaserErrorsConfig errors{.mount_error = {}, .dark_range_m = 3.0};
  EXPECT_TRUE(std::isinf(scanOf(errors, roomWith("east", 0.0F)).ranges_m[540])) << "5 m ahead";
  EXPECT_NEAR(scanOf(errors, roomWith("east", 0.8F)).ranges_m[540], 5.0, 0.001) << "a white one is seen";
  WorldModel near = boxRoom();
  near.shapes.push_back(boxShape("cabinet", {2.0, -1.0, 0.0}, {3.0, 1.0, 2.0}));
  near.shapes.back().color = Color::Zero();
  const common::LaserScan scan = scanOf(errors, near);
  EXPECT_NEAR(scan.ranges_m[540], 2.0, 0.001) << "a black one is seen from near";
  Actor person;
  person.position_world_m = {3.0, 0.0};
  EXPECT_NEAR(scanOf(errors, boxRoom(), {person}).ranges_m[540], 2.75, 0.002) << "and so are people";
}

TEST(LaserErrors, TheSunTakesReturnsAwayAroundItsDirection) {
  const common::LaserScan scan =
      scanOf({.mount_error = {}, .sun_dropout_rate = 1.0, .sun_direction_deg = 90.0, .sun_width_deg = 10.0}, boxRoom());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double off_deg = std::abs(angleOf(scan, i) / kRadPerDeg - 90.0);
    if (off_deg < 9.9) {
      EXPECT_TRUE(std::isinf(scan.ranges_m[i])) << i;
    } else if (off_deg > 10.1) {
      EXPECT_TRUE(std::isfinite(scan.ranges_m[i])) << i;
    }
  }
}

/// A wall of grey 0.64 at x = 2 and one at x = -2; over the second one is a roof.
WorldModel yardAndPorch() {
  WorldModel world;
  world.shapes = {boxShape("ahead", {2.0, -6.0, 0.0}, {2.2, 6.0, 3.0}),
                  boxShape("behind", {-2.2, -6.0, 0.0}, {-2.0, 6.0, 3.0}),
                  boxShape("roof", {-6.0, -6.0, 2.0}, {0.0, 6.0, 2.1})};
  for (Shape& shape : world.shapes) shape.color = Color::Constant(0.64F);
  return world;
}

TEST(LaserErrors, DaylightShortensTheRangeWhereItFalls) {
  // A grey of 0.64 is seen four times as far as black, 0.04: to 3 m across in the sun.
  const common::LaserScan scan =
      scanOf({.mount_error = {}, .dark_range_m = 15.0, .daylight_range_share = 0.05}, yardAndPorch());
  int ahead = 0, behind = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad = angleOf(scan, i), across_m = 2.0 / std::abs(std::cos(angle_rad));
    const double reach_m = 3.0 * std::sqrt(std::abs(std::cos(angle_rad)));
    if (across_m > 5.0 || std::abs(across_m - reach_m) < 0.01) continue;
    const bool lit = std::cos(angle_rad) > 0.0;
    EXPECT_EQ(std::isfinite(scan.ranges_m[i]), !lit || across_m < reach_m) << angle_rad;
    ++(lit ? ahead : behind);
  }
  EXPECT_GT(ahead, 100);
  EXPECT_GT(behind, 10);
}

TEST(LaserErrors, GlassIsSeenNearItsNormalAndSeenThroughElsewhere) {
  const common::LaserScan scan = scanOf({.mount_error = {}, .glass_angle_deg = 15.0}, roomWithPane());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad = angleOf(scan, i), off_deg = std::abs(angle_rad) / kRadPerDeg;
    if (std::abs(off_deg - 15.0) < 0.1) continue;
    const double expected = off_deg < 15.0 ? 2.0 / std::cos(angle_rad) : rangeInRoom({0, 0}, angle_rad);
    EXPECT_NEAR(scan.ranges_m[i], expected, 0.001) << off_deg;
  }
  const common::LaserScan wall = scanOf({.mount_error = {}, .incidence_bias_m = 1e-9}, roomWithPane());
  EXPECT_NEAR(wall.ranges_m[640], 2.0 / std::cos(angleOf(wall, 640)), 0.001) << "off by default: it is a wall";
}

TEST(LaserErrors, APersonBehindGlassIsSeenAndOneBehindNothingIsNot) {
  Actor person;
  person.position_world_m = Eigen::Rotation2Dd(25.0 * kRadPerDeg) * Eigen::Vector2d(3.5, 0.0);
  const auto beam = static_cast<std::size_t>(std::lround((135.0 + 25.0) / 0.25));
  EXPECT_NEAR(scanOf({.mount_error = {}, .glass_angle_deg = 15.0}, roomWithPane(), {person}).ranges_m[beam], 3.25,
              0.002);
  WorldModel open = roomWithPane();
  std::erase_if(open.shapes, [](const Shape& shape) { return shape.model == "east"; });
  EXPECT_TRUE(std::isinf(scanOf({.mount_error = {}, .glass_angle_deg = 15.0}, open).ranges_m[beam]))
      << "there is nothing behind";
}

}  // namespace
}  // namespace swiftlet::simulation
