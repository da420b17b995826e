// From a wanted acceleration to the tilt and the thrust that the vehicle can give. Used by every controller whose law
// yields accelerations.
#pragma once

#include <Eigen/Core>

#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "control/thrust_model.hpp"

namespace swiftlet::control {

/// Share of the weight that is kept for the height: a tilt that the thrust could not carry would cost height.
inline constexpr double kKeptForHeight = 0.03;

/// Roll, pitch and thrust of the setpoint are set.
struct Actuation {
  common::Setpoint setpoint;
  Eigen::Vector3d given_odom_m_s2 = Eigen::Vector3d::Zero();  ///< The wanted acceleration within the limits.
};

/// The attitude whose thrust points along the wanted force, within the tilt that the thrust can carry. While
/// `on_ground` the tilt is zero, and the thrust may be all there is. `max_up_m_s2` bounds the vertical acceleration in
/// both directions.
Actuation actuate(const Eigen::Vector3d& wanted_odom_m_s2, double yaw_rad, double max_up_m_s2, bool on_ground,
                  const common::VehicleConfig& vehicle, const ThrustModel& thrust);

/// The greatest tilt at which the thrust still carries the weight, at most that of the data sheet.
double greatestTilt_rad(const common::VehicleConfig& vehicle, const ThrustModel& thrust);

/// A vector with its length limited.
Eigen::Vector2d limited(const Eigen::Vector2d& vector, double most);

}  // namespace swiftlet::control
