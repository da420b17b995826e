// The errors that a feedback law acts on, with the parts that may not be used set to zero.
#pragma once

#include <Eigen/Core>

#include "control/controller.hpp"

namespace swiftlet::control {

// Bounds of the controllers.
inline constexpr double kMaxPositionError_m = 0.6;  ///< Greatest error of the position that the papers' laws act on.
inline constexpr double kMaxAccelerationUp_m_s2 = 4.0;  ///< Greatest vertical acceleration.
inline constexpr double kMaxIntegral_m_s2 = 2.0;        ///< Greatest integral part of the acceleration.
inline constexpr double kMaxYawRate_deg_s = 90.0;       ///< Greatest yaw rate of the papers' laws.

struct ControlErrors {
  Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();         ///< Reference less state, limited.
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();       ///< Reference less state.
  Eigen::Vector3d acceleration_odom_m_s2 = Eigen::Vector3d::Zero();  ///< Of the reference.
  double yaw_rad = 0.0;                                              ///< Reference less state.
  double heading_rad = 0.0;                                          ///< Yaw of the state.
};

/// By what `input.horizontal` allows: without a position its error is zero, and without a velocity that error is too.
ControlErrors errorsOf(const ControlInput& input);

/// Adds `rate * error * dt` to the integral, within its bound `most`. Anti-windup: not while the vehicle was given less
/// than was wanted and the integral would grow further.
void integrate(Eigen::Vector3d& integral_m_s2, const Eigen::Vector3d& rate, const Eigen::Vector3d& error,
               const Eigen::Vector3d& refused_m_s2, double most_m_s2, double dt_s);

/// Proportional control of the yaw with the reference's rate fed forward; 0 while the position is not held.
double yawRate_rad_s(const ControlInput& input, double error_rad, double gain_1_s, double max_yaw_rate_deg_s);

}  // namespace swiftlet::control
