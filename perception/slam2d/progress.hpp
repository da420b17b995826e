// Tells whether the vehicle has moved far enough, or enough time has passed, to do something again.
#pragma once

#include <cmath>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::perception {

/// Where and when something was done last.
struct Progress {
  common::Pose2 T_odom_body;
  common::Time stamp;

  /// Whether the distance, the rotation or the time since then exceeds its limit.
  bool exceeds(const common::Pose2& T_odom_body_now, common::Time now, double distance_m, double rotation_deg,
               double time_s) const {
    const common::Pose2 step = between(T_odom_body, T_odom_body_now);
    return step.position_m().norm() > distance_m || std::abs(step.yaw_rad) > rotation_deg * common::kRadPerDeg ||
           (now - stamp).seconds() > time_s;
  }
};

}  // namespace swiftlet::perception
