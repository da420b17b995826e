// Scans of still scenes, for the tests of matching.
#pragma once

#include "perception/projection/scan_projection.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::test {

inline perception::ProjectedScan scanAt(const PlanarWorld& world, const common::Pose2& pose, std::uint64_t frame,
                                        double height_m = 1.0, common::LaserConfig laser = {}) {
  common::RandomStream random(7, "scene", frame);
  laser.sweep_s = 0.0;
  const auto still = [&](common::Time) { return common::lifted(pose, height_m); };
  const auto start = common::Time::fromSeconds(static_cast<double>(frame) / laser.rate_hz);
  return perception::project(sweep(world, laser, still, start, random), laser, still, {});
}

/// Somewhere in the first room of the flat, away from the walls.
inline common::Pose2 poseInFlat(common::RandomStream& random) {
  return {random.uniform(-1.0, 2.5), random.uniform(-2.0, 2.0), random.uniform(-3.1, 3.1)};
}

inline PlanarWorld corridor() {
  PlanarWorld world;
  world.addPolyline({{-60.0, -1.0}, {60.0, -1.0}}, false);
  world.addPolyline({{-60.0, 1.0}, {60.0, 1.0}}, false);
  return world;
}

/// A round room about the origin, of 72 walls as a builder would make it.
inline PlanarWorld roundRoom(double radius_m) {
  constexpr int kWalls = 72;
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kWalls; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kWalls;
    corners.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad));
  }
  PlanarWorld world;
  world.addPolyline(corners, true);
  return world;
}

/// A corridor with doors set back in their frames; behind each frame is a surface that the reference has not seen.
inline PlanarWorld corridorWithDoors() {
  PlanarWorld world;
  world.addPolyline({{-3.0, -1.0}, {-3.0, 1.0}}, false);
  world.addPolyline({{33.0, -1.0}, {33.0, 1.0}}, false);
  for (const double side : {-1.0, 1.0}) {
    const double back = 1.13 * side;
    double x = -3.0;
    for (double door = side > 0.0 ? -1.0 : -2.2; door<31.0; door += side> 0.0 ? 2.6 : 3.1) {
      world.addPolyline({{x, side}, {door, side}, {door, back}, {door + 0.95, back}, {door + 0.95, side}}, false);
      x = door + 0.95;
    }
    world.addPolyline({{x, side}, {33.0, side}}, false);
  }
  return world;
}

inline Eigen::Vector3d errorOf(const common::Pose2& estimate, const common::Pose2& truth) {
  return {estimate.x_m - truth.x_m, estimate.y_m - truth.y_m, common::wrapAngle(estimate.yaw_rad - truth.yaw_rad)};
}

}  // namespace swiftlet::test
