// A world of upright walls over a floor, cast analytically: the truth against which perception is tested. Walls are
// segments of infinite height, the laser is swept in time along a given motion, with noise.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::test {

struct Wall {
  Eigen::Vector2d a_m, b_m;
};

struct PlanarWorld {
  std::vector<Wall> walls;
  double ceiling_m = 2.5;

  void addPolyline(const std::vector<Eigen::Vector2d>& corners, bool closed) {
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) walls.push_back({corners[i], corners[i + 1]});
    if (closed) walls.push_back({corners.back(), corners.front()});
  }
  void addBox(double x, double y, double width, double depth, double yaw = 0.0) {
    const common::Pose2 pose{x, y, yaw};
    addPolyline({pose * Eigen::Vector2d(-width / 2, -depth / 2), pose * Eigen::Vector2d(width / 2, -depth / 2),
                 pose * Eigen::Vector2d(width / 2, depth / 2), pose * Eigen::Vector2d(-width / 2, depth / 2)},
                true);
  }

  /// Distance along a ray from `origin` in the unit direction; infinity when it hits nothing.
  double cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d edge = wall.b_m - wall.a_m, from = wall.a_m - origin.head<2>();
      const double cross = direction.x() * edge.y() - direction.y() * edge.x();
      if (cross == 0.0) continue;
      const double along = (from.x() * edge.y() - from.y() * edge.x()) / cross;
      const double share = (from.x() * direction.y() - from.y() * direction.x()) / cross;
      if (along > 0.0 && share >= 0.0 && share <= 1.0) nearest = std::min(nearest, along);
    }
    if (direction.z() < 0.0) nearest = std::min(nearest, -origin.z() / direction.z());
    if (direction.z() > 0.0) nearest = std::min(nearest, (ceiling_m - origin.z()) / direction.z());
    return nearest;
  }

  double distanceToWall(const Eigen::Vector2d& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      const Eigen::Vector2d edge = wall.b_m - wall.a_m;
      const double share = std::clamp((p - wall.a_m).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (wall.a_m + share * edge - p).norm());
    }
    return nearest;
  }
};

using Motion = std::function<common::Pose3(common::Time)>;

/// One sweep that begins at `start`, by a laser on a body that moves as `T_world_body` says.
inline common::LaserScan sweep(const PlanarWorld& world, const common::LaserConfig& laser, const Motion& T_world_body,
                               common::Time start, common::RandomStream& random) {
  common::LaserScan scan;
  scan.stamps = {start, start};
  scan.angle_min_rad = laser.angleMin_rad();
  scan.angle_increment_rad = laser.angleIncrement_rad();
  scan.time_increment = common::Duration::fromSeconds(laser.sweep_s / (laser.beams - 1));
  scan.range_min_m = laser.range_min_m;
  scan.range_max_m = laser.range_max_m;
  for (int beam = 0; beam < laser.beams; ++beam) {
    const common::Pose3 mount = laser.isMirrorBeam(beam) ? laser.mirror_mount.pose() : laser.mount.pose();
    const common::Pose3 T_world_sensor = T_world_body(start + scan.time_increment * beam) * mount;
    double range = world.cast(T_world_sensor.position_m, T_world_sensor.rotation * laser.direction(beam));
    range += random.gaussian(laser.range_noise_m);
    if (range > laser.range_max_m || random.chance(laser.dropout_rate)) range = std::numeric_limits<double>::infinity();
    scan.ranges_m.push_back(static_cast<float>(range));
  }
  return scan;
}

/// A flat of 94.7 m2: two rooms joined by a door, a corridor end, two boxes.
inline PlanarWorld flat() {
  PlanarWorld world;
  world.addPolyline({{-2.0, -3.0}, {9.36, -3.0}, {9.36, 5.34}, {-2.0, 5.34}}, true);
  world.addPolyline({{3.5, -3.0}, {3.5, 0.2}}, false);
  world.addPolyline({{3.5, 1.6}, {3.5, 5.34}}, false);
  world.addBox(1.2, 3.6, 0.8, 0.6, 0.3);
  world.addBox(6.6, -1.0, 0.6, 1.1, -0.4);
  world.addBox(7.8, 3.9, 0.5, 0.5, 0.7);
  return world;
}

}  // namespace swiftlet::test
