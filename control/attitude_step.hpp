// How far ahead of the vehicle roll and pitch may be commanded. Autopilots give the motors to roll and pitch before
// they give them to the thrust; near full throttle a large step of the attitude therefore costs height: 0.5 m/s of it
// in 0.3 s, measured at a thrust of 1.18 times the weight (docs/decisions/control.md#092).
#pragma once

#include <Eigen/Geometry>

#include "common/vehicle.hpp"

namespace swiftlet::control {

/// The setpoint with roll and pitch no farther from the present attitude than its thrust leaves the motors room for. At
/// half throttle the step may be 43 deg, which is no limit in practice.
common::Setpoint withinThrustLeft(common::Setpoint setpoint, const Eigen::Quaterniond& rotation_odom_body);

}  // namespace swiftlet::control
