#pragma once

// What the tests of the airframe begin with: a vehicle in free air whose airframe has no drag.

#include <limits>

#include "simulation/quadrotor.hpp"

namespace swiftlet::simulation {

inline constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

inline const common::VehicleConfig kVehicle;

inline common::Pose3 inTheAir() { return {Eigen::Quaterniond::Identity(), {0, 0, 10}}; }

inline QuadrotorConfig withoutDrag() {
  QuadrotorConfig config;
  config.linear_drag_n_s_m = config.quadratic_drag_n_s2_m2 = config.angular_drag_n_m_s = 0.0;
  return config;
}

}  // namespace swiftlet::simulation
