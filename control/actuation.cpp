#include "control/actuation.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/gravity.hpp"

namespace swiftlet::control {
namespace {

/// FLU, in the frame of the heading.
void setTilt(common::Setpoint& setpoint, const Eigen::Vector3d& acceleration_odom_m_s2, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const Eigen::Vector3d force(c * acceleration_odom_m_s2.x() + s * acceleration_odom_m_s2.y(),
                              -s * acceleration_odom_m_s2.x() + c * acceleration_odom_m_s2.y(),
                              common::kGravity_m_s2 + acceleration_odom_m_s2.z());
  // Ry(pitch) Rx(roll) e_z = (sin p cos r, -sin r, cos p cos r).
  setpoint.pitch_rad = std::atan2(force.x(), force.z());
  setpoint.roll_rad = std::atan2(-force.y(), std::hypot(force.x(), force.z()));
}

}  // namespace

Eigen::Vector2d limited(const Eigen::Vector2d& vector, double most) {
  const double norm = vector.norm();
  return norm > most ? Eigen::Vector2d(vector * (most / norm)) : vector;
}

/// The least tilt, 3 degrees, accelerates by 0.5 m/s2: enough to hold against a light wind while the vehicle sinks.
double greatestTilt_rad(const common::VehicleConfig& vehicle, const ThrustModel& thrust) {
  constexpr double kLeast_rad = 3.0 * common::kRadPerDeg;
  const double carried_rad = std::acos(std::clamp((1.0 + kKeptForHeight) / thrust.margin(), 0.0, 1.0));
  return std::min(vehicle.max_tilt_deg * common::kRadPerDeg, std::max(kLeast_rad, carried_rad));
}

Actuation actuate(const Eigen::Vector3d& wanted_odom_m_s2, double yaw_rad, double max_up_m_s2, bool on_ground,
                  const common::VehicleConfig& vehicle, const ThrustModel& thrust) {
  Actuation result;
  Eigen::Vector3d& given_m_s2 = result.given_odom_m_s2;
  given_m_s2 = wanted_odom_m_s2;
  // More than the motors can give would only wind up the integral. A standing vehicle may be much weaker than known, so
  // it may use all of its thrust.
  const double available_m_s2 = std::max(0.0, common::kGravity_m_s2 * (thrust.margin() - 1.0));
  const double most_up_m_s2 = on_ground ? available_m_s2 : std::min(available_m_s2, max_up_m_s2);
  given_m_s2.z() = std::clamp(wanted_odom_m_s2.z(), -max_up_m_s2, most_up_m_s2);
  given_m_s2.head<2>() = limited(wanted_odom_m_s2.head<2>(), std::tan(greatestTilt_rad(vehicle, thrust)) *
                                                                 (common::kGravity_m_s2 + given_m_s2.z()));
  if (on_ground) given_m_s2.head<2>().setZero();

  setTilt(result.setpoint, given_m_s2, yaw_rad);
  const double cos_tilt = std::cos(result.setpoint.roll_rad) * std::cos(result.setpoint.pitch_rad);
  result.setpoint.thrust = thrust.commandFor(given_m_s2.z(), cos_tilt);
  return result;
}

}  // namespace swiftlet::control
