#include "control/attitude_step.hpp"

#include <algorithm>

#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

/// With attitude gains as autopilots have them, a step of 1 rad takes about the full thrust of a motor up and down.
/// Half as much again is allowed, since a step lasts for less time than it takes to lose height. Measured:
/// docs/decisions/control.md#092 (0.5 and 0.8 were tried too).
constexpr double kStepPerThrust_rad = 1.5;
constexpr double kLeastStep_rad = 0.04;  ///< Enough to stay upright in gusts, at any throttle.

}  // namespace

common::Setpoint withinThrustLeft(common::Setpoint setpoint, const Eigen::Quaterniond& rotation_odom_body) {
  const double step_rad = std::max(kLeastStep_rad, kStepPerThrust_rad * (1.0 - setpoint.thrust));
  const common::RollPitchYaw now = common::rollPitchYaw(rotation_odom_body);
  setpoint.roll_rad = std::clamp(setpoint.roll_rad, now.roll_rad - step_rad, now.roll_rad + step_rad);
  setpoint.pitch_rad = std::clamp(setpoint.pitch_rad, now.pitch_rad - step_rad, now.pitch_rad + step_rad);
  return setpoint;
}

}  // namespace swiftlet::control
