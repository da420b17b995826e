// The autopilot inside the vehicle: an AHRS with an error of about a degree, and the attitude loop that uses it at 500
// Hz: attitude error -> rate -> torque -> four throttles. It never sees the true attitude.
#pragma once

#include <array>

#include <Eigen/Core>

#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/plant_config.hpp"

namespace swiftlet::simulation {

struct AttitudeMeasurement;

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
