// Consumption and what it means: how long the battery lasts, and how much of it the path home takes.
#pragma once

#include <optional>

#include "autonomy/battery_curve.hpp"
#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/world/energy_layer.hpp"

namespace swiftlet::autonomy {

struct EnergyConfig {
  double power_filter_s = 20.0;
  double home_speed_m_s = 0.5;
  double home_speed_filter_s = 30.0;
  double home_stops_s = 8.0;

  void describe(common::config::Fields& fields);
};

/// One thread. A multirotor needs about the same power whether it flies or hovers, so the charge for a path is its
/// duration times the consumption. The duration is predicted by the speed at which paths have been flown so far.
class EnergyMonitor {
 public:
  /// The capacity is the battery's as its owner believes; it is corrected by what the fuel gauge says in flight. The
  /// thrust goes with the voltage to the power of `voltage_exponent`.
  EnergyMonitor(const EnergyConfig& config, const common::VehicleConfig& vehicle, double voltage_exponent);

  /// A plausible sample, with the thrust margin at its time.
  void add(const common::BatterySample& sample, bool airborne, double thrust_margin);
  /// Once a tick: the estimated horizontal speed while the vehicle follows a path whose end is not near.
  void followed(double speed_m_s, double dt_s);

  /// The vehicle lands when the charge falls to `land_share` or the thrust margin to `least_margin`.
  common::EnergyLayer layer(const std::optional<double>& home_m, double land_share, double least_margin) const;

 private:
  double consumption_1_s() const;

  EnergyConfig config_;
  double capacity_as_;
  double home_speed_m_s_;
  std::optional<common::BatterySample> last_;
  BatteryCurve curve_;
  double voltage_exponent_;
  double thrust_margin_ = 0.0;
  /// Smoothed.
  double voltage_v_ = 0.0, margin_ = 0.0;
  double current_a_ = 0.0;
  double power_w_ = 0.0;
  bool flown_ = false;  ///< The smoothed values are those of a flight.
  double remaining_at_take_off_ = 0.0;
  double drawn_as_ = 0.0;  ///< By the measured current, since the take-off.
};

}  // namespace swiftlet::autonomy
