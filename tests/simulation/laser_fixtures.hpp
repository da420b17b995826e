// A laser without noise, and what it measures in boxRoom().
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "fixtures.hpp"
#include "simulation/sensors/laser_scanner.hpp"

namespace swiftlet::simulation {

inline common::LaserConfig quietLaser() {
  common::LaserConfig laser;
  laser.range_noise_m = 0.0;
  laser.dropout_rate = 0.0;
  return laser;
}

inline std::vector<Moment> still(const common::Pose3& pose, const std::vector<Actor>& actors = {}) {
  return {{common::Time(), pose, actors}, {common::Time::fromSeconds(0.2), pose, actors}};
}

/// Where a level ray meets the walls of boxRoom().
inline double rangeInRoom(const Eigen::Vector2d& from, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double to_x = c > 0 ? (5.0 - from.x()) / c : c < 0 ? (-5.0 - from.x()) / c : INFINITY;
  const double to_y = s > 0 ? (4.0 - from.y()) / s : s < 0 ? (-4.0 - from.y()) / s : INFINITY;
  return std::min(to_x, to_y);
}

}  // namespace swiftlet::simulation
