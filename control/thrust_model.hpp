// From a wanted vertical acceleration to the collective command: the offset C(U) of Grzonka 2012, equation 5. The
// thrust of the same command falls with the battery's voltage; C(U) starts from the data sheet and is learned in
// flight.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::control {

inline constexpr double kGravity_m_s2 = 9.81;

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

  /// Ignores a voltage that is not finite or not positive.
  void observeVoltage(double voltage_v, double dt_s);
  /// Learns from the integral part: `correction_m_s2` is the constant acceleration that the controller had to add.
  /// Returns how much of it (m/s^2) has moved into the model; the controller subtracts that from its integral.
  double learn(double correction_m_s2, double dt_s);

  /// The command that carries the weight and adds `acceleration_up_m_s2` at the given tilt, clamped to the valid range.
  double commandFor(double acceleration_up_m_s2, double cos_tilt) const;
  /// Greatest thrust over the weight at the present voltage, by what was learned.
  double margin() const;
  /// The present C(U).
  double hoverCommand() const;
  double correction() const { return correction_; }

 private:
  double unclampedCommand(double acceleration_up_m_s2, double cos_tilt) const;

  Config config_;
  common::VehicleConfig vehicle_;
  double voltage_v_;
  bool voltage_seen_ = false;
  double correction_ = 1.0;
};

}  // namespace swiftlet::control
