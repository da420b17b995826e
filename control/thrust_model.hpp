// From a wanted vertical acceleration to the collective command: the offset C(U) of Grzonka 2012, equation 5. The
// thrust of the same command falls with the battery's voltage; C(U) starts from the data sheet and is learned in
// flight.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::control {

class ThrustModel {
 public:
  struct Config {
    double voltage_exponent = 2.0;
    double voltage_filter_s = 0.5;
    double learning_time_s = 2.0;
    double max_correction = 0.35;
    double min_thrust = 0.10;
    double max_thrust = 0.95;

    void describe(common::config::Fields& fields);
    std::vector<std::string> validate() const;
  };

  ThrustModel(const Config& config, const common::VehicleConfig& vehicle);

  /// A voltage that is not finite or not positive is left out.
  void observeVoltage(double voltage_v, double dt_s);
  /// Learns from the integral part: `correction_m_s2` is the constant acceleration the controller had to add.
  /// Returns how much of it (m/s^2) has now moved into the model, to be taken off the integral.
  double learn(double correction_m_s2, double dt_s);

  /// The command that lifts the weight and adds `acceleration_up_m_s2`, tilted by the given angle; clamped.
  double commandFor(double acceleration_up_m_s2, double cos_tilt) const;
  /// C(U) now.
  double hoverCommand() const;
  double correction() const { return correction_; }

 private:
  Config config_;
  common::VehicleConfig vehicle_;
  double voltage_v_;
  bool voltage_seen_ = false;
  double correction_ = 1.0;
};

}  // namespace swiftlet::control
