// The autopilot inside the vehicle: an AHRS with an error of about a degree, and the attitude loop that uses it at 500
// Hz: attitude error -> rate -> torque -> four throttles. It never sees the true attitude.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/config_fwd.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/sensors/inertial_unit.hpp"

namespace swiftlet::simulation {

/// How torques and thrust share the motors where they ask for more than a motor can give.
enum class Mixing {
  kClampEach,      ///< Each motor is clamped by itself, so that thrust and all torques suffer alike.
  kAttitudeFirst,  ///< Roll and pitch are kept, at the expense of the yaw torque, then of the thrust.
};

struct AutopilotConfig {
  double attitude_gain_1_s = 7.0;
  double max_rate_rad_s = 4.0;
  double max_yaw_rate_rad_s = 2.5;
  double rate_gain_1_s = 18.0;
  double yaw_rate_gain_1_s = 7.0;
  double rate_integral_1_s2 = 12.0;
  double link_timeout_s = 0.5;
  double failsafe_thrust_share = 0.93;
  double tilt_share = 1.0;
  double tilt_expo = 0.0;
  Mixing mixing = Mixing::kClampEach;
  double program_share = 0.0;

  void describe(common::config::Fields& fields);
};

class Autopilot {
 public:
  Autopilot(const common::VehicleConfig& vehicle, const QuadrotorConfig& airframe, const AutopilotConfig& config);

  /// Takes a setpoint that came over the link at `arrived`.
  void receive(const common::Setpoint& setpoint, common::Time arrived);
  /// Takes the sticks of a pilot who flies, as a setpoint. With a program_share, the last setpoint of the link moves
  /// each of them by at most that share of its range; a setpoint that is old, not finite, or has the motors off does
  /// not.
  void fly(const common::Setpoint& sticks, common::Time now);

  /// One tick of the attitude loop: the throttles of the motors until the next.
  std::array<double, 4> tick(common::Time now, const AttitudeMeasurement& measured, double step_s);

  bool linkLost(common::Time now) const;

 private:
  /// The motors' throttles; all four arguments are shares of the full throttle.
  std::array<double, 4> mixed(double thrust, double roll, double pitch, double yaw) const;
  void integrate(const Eigen::Vector3d& rate_error, double thrust, double step_s);
  double tiltFor(double command_rad) const;
  common::Setpoint effective(common::Time now, const AttitudeMeasurement& measured) const;

  common::VehicleConfig vehicle_;
  QuadrotorConfig airframe_;
  AutopilotConfig config_;
  common::Setpoint movedByProgram(const common::Setpoint& sticks, common::Time now) const;

  common::Setpoint setpoint_;
  common::Time received_;
  common::Setpoint program_;  ///< The last one that came over the link.
  common::Time program_received_;
  Eigen::Vector3d rate_integral_rad_ = Eigen::Vector3d::Zero();
};

}  // namespace swiftlet::simulation
