#include "control/control_errors.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "control/actuation.hpp"

namespace swiftlet::control {

ControlErrors errorsOf(const ControlInput& input) {
  ControlErrors errors;
  const common::VehicleState& state = input.state;
  const Reference& reference = input.reference;
  errors.heading_rad = common::yawOf(state.T_odom_body.rotation);
  errors.yaw_rad = common::wrapAngle(reference.yaw_odom_rad - errors.heading_rad);
  const double height_error_m = reference.position_odom_m.z() - state.T_odom_body.position_m.z();
  errors.position_odom_m.z() = std::clamp(height_error_m, -kMaxPositionError_m, kMaxPositionError_m);
  errors.velocity_odom_m_s.z() = reference.velocity_odom_m_s.z() - state.velocity_odom_m_s.z();
  errors.acceleration_odom_m_s2.z() = reference.acceleration_odom_m_s2.z();
  if (input.horizontal == Horizontal::kLevel) return errors;
  errors.velocity_odom_m_s.head<2>() = (reference.velocity_odom_m_s - state.velocity_odom_m_s).head<2>();
  if (input.horizontal == Horizontal::kVelocity) return errors;
  errors.position_odom_m.head<2>() =
      limited(reference.position_odom_m.head<2>() - state.T_odom_body.position_m.head<2>(), kMaxPositionError_m);
  errors.acceleration_odom_m_s2.head<2>() = reference.acceleration_odom_m_s2.head<2>();
  return errors;
}

void integrate(Eigen::Vector3d& integral_m_s2, const Eigen::Vector3d& rate, const Eigen::Vector3d& error,
               const Eigen::Vector3d& refused_m_s2, double most_m_s2, double dt_s) {
  for (int axis = 0; axis < 3; ++axis) {
    if (refused_m_s2[axis] * error[axis] > 1e-9) continue;
    integral_m_s2[axis] = std::clamp(integral_m_s2[axis] + dt_s * rate[axis] * error[axis], -most_m_s2, most_m_s2);
  }
}

double yawRate_rad_s(const ControlInput& input, double error_rad, double gain_1_s, double max_yaw_rate_deg_s) {
  if (input.horizontal != Horizontal::kPosition) return 0.0;
  const double most_rad_s = max_yaw_rate_deg_s * common::kRadPerDeg;
  return std::clamp(input.reference.yaw_rate_rad_s + gain_1_s * error_rad, -most_rad_s, most_rad_s);
}

}  // namespace swiftlet::control
