// Consumption and what it means: how long the battery lasts, and how much of it the path home takes.
#pragma once

#include <optional>
#include <string>

#include "autonomy/energy/battery_curve.hpp"
#include "autonomy/energy/charge_counter.hpp"
#include "autonomy/energy/current_model.hpp"
#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/world/energy_layer.hpp"

namespace swiftlet::autonomy {

struct EnergyConfig {
  double home_speed_m_s = 0.75;

  void describe(common::config::Fields& fields);
};

/// What a flight home takes.
struct FlightHome {
  std::optional<double> planned_m;  ///< Length of the planned path; nullopt without a path.
  double trail_m = 0.0;             ///< Along the trail, without its loops.
  double landing_s = 0.0;           ///< From the height of the flight to the ground.
};

/// One thread. A vehicle may land, be charged and take off again. The current is measured as that of hovering plus some
/// for each metre a second, by least squares over the last minutes; the duration of a path is predicted by the speed at
/// which paths have been flown so far.
class EnergyMonitor {
 public:
  /// The capacity is that of the data sheet; it is corrected by what the fuel gauge says in flight. The
  /// thrust goes with the voltage to the power of `voltage_exponent`.
  EnergyMonitor(const EnergyConfig& config, const common::VehicleConfig& vehicle, double voltage_exponent);

  /// A plausible sample, with the thrust margin and the estimated horizontal speed at its time. A current that is not
  /// finite or not positive is not measured: that of the sinking charge takes its place.
  void add(const common::BatterySample& sample, bool airborne, double thrust_margin, double speed_m_s);
  /// Once a tick: the estimated horizontal speed while the vehicle follows a path whose end is not near.
  void followed(double speed_m_s, double dt_s);

  /// The vehicle lands when the charge falls to `land_share` or `thrust_margin`, the present one, to `least_margin`.
  common::EnergyLayer layer(common::Time now, const FlightHome& home, double thrust_margin, double land_share,
                            double least_margin) const;
  /// Why the charge is not that of the gauge but extrapolated by the current; empty if it is the gauge's.
  std::string gaugeFault(common::Time now) const;

 private:
  double currentOf_a(const common::BatterySample& sample) const;
  double unheard_s(common::Time now) const;
  double remaining(common::Time now) const;
  void tellHome(const FlightHome& home, common::EnergyLayer& layer) const;

  ChargeCounter charge_;
  double home_speed_m_s_;
  std::optional<common::BatterySample> last_;
  BatteryCurve curve_;
  CurrentModel current_model_;
  double voltage_exponent_;
  /// Smoothed.
  double voltage_v_ = 0.0, margin_ = 0.0;
  double current_a_ = 0.0;
  double power_w_ = 0.0;
  bool flown_ = false;  ///< The smoothed values are those of a flight.
  bool airborne_ = false;
  bool settled_ = false;  ///< The smoothed current is that of the flight, and predicts how long the charge lasts.
  common::Time taken_off_;
};

}  // namespace swiftlet::autonomy
