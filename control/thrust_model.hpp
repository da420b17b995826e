// From a wanted vertical acceleration to the collective command, and the thrust that is left. The command that carries
// the weight is learned in flight, by battery voltage.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "control/thrust_table.hpp"

namespace swiftlet::control {

/// The thrust counts as proportional to the command. Motors whose thrust grows faster than their command have more left
/// than margin() says, never less.
class ThrustModel {
 public:
  struct Config {
    double min_thrust = 0.10;
    double max_thrust = 0.95;

    void describe(common::config::Fields& fields);
    std::vector<common::Problem> validate() const;
  };

  ThrustModel(const Config& config, const common::VehicleConfig& vehicle);

  /// Ignores a voltage that is not finite or not positive.
  void observeVoltage(double voltage_v, double dt_s);
  /// Learns from the integral part: `correction_m_s2` is the constant acceleration that the controller had to add.
  /// Returns how much of it (m/s^2) has moved into the model; the controller subtracts that from its integral.
  double learn(double correction_m_s2, double dt_s);
  /// Near the ground nothing may be learned, because it carries a part of the weight.
  void setLearning(bool learns) { learns_ = learns; }

  /// The command that carries the weight and adds `acceleration_up_m_s2` at the given tilt, clamped to the valid range.
  double commandFor(double acceleration_up_m_s2, double cos_tilt) const;
  /// A command within the valid range.
  double clamped(double command) const;
  /// Whether a command is all of the thrust.
  bool isGreatest(double command) const;
  /// Greatest thrust over the weight at the present voltage, by what was learned.
  double margin() const { return marginAt(voltage_v_); }
  double marginAt(double voltage_v) const { return config_.max_thrust / table_.hoverCommand(voltage_v); }
  /// The present C(U); Grzonka 2012, equation 5.
  double hoverCommand() const;
  /// The present hover command over that of the data sheet.
  double correction() const { return table_.hoverCommand(voltage_v_) / table_.sheetCommand(voltage_v_); }

  ThrustTable& table() { return table_; }
  const ThrustTable& table() const { return table_; }

 private:
  Config config_;
  common::VehicleConfig vehicle_;
  ThrustTable table_;
  double voltage_v_;
  bool voltage_seen_ = false;
  bool learns_ = true;
};

}  // namespace swiftlet::control
