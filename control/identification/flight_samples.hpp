// What an identification reads of a flight: commands, the motion that followed, and the battery, in the order of time.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::control {

/// One instant. Motion is that of the estimate, or of an outside measurement such as a motion capture system.
struct FlightSample {
  common::Time stamp;
  // The command sent at that time.
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
  double thrust = 0.0;
  // The motion.
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  double yaw_odom_rad = 0.0;
  double tilt_cos = 1.0;  ///< Cosine of the angle between the body's z axis and the vertical.
  double battery_v = 0.0;
  bool flying = false;  ///< In the air, neither taking off nor landing.
};

/// One flight; its samples come at one rate.
using FlightSamples = std::vector<FlightSample>;

/// The median step between samples: the first one alone may be another. 0 for fewer than two samples.
double periodOf_s(const FlightSamples& flight);

}  // namespace swiftlet::control
