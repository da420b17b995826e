// How the voltage of a lithium-polymer battery, and with it the greatest thrust, falls with the charge.
#pragma once

#include "common/vehicle_config.hpp"

namespace swiftlet::autonomy {

/// A pure function of its arguments. The curve is that of common cells at rest: steep near full, flat in the middle,
/// steep again below a tenth. The sag under load is taken as constant: it is what the measured voltage lacks.
class BatteryCurve {
 public:
  /// Takes the voltages of the full and the empty battery from the vehicle's sheet.
  explicit BatteryCurve(const common::VehicleConfig& vehicle)
      : full_v_(vehicle.battery_full_v), empty_v_(vehicle.battery_empty_v) {}

  /// The voltage without load at a charge from 0 to 1.
  double openCircuit_v(double remaining) const;

  /// What is known of the battery under load.
  struct Now {
    double remaining = 1.0;
    double voltage_v = 0.0;
    double thrust_margin = 0.0;  ///< Greatest thrust over the weight.
  };
  /// The charge at which the thrust margin will have fallen to `least_margin`, if the thrust goes with the voltage to
  /// the power of `exponent`; 0 if it never does, the present charge if it has.
  double chargeAtMargin(const Now& now, double least_margin, double exponent) const;

 private:
  double full_v_;
  double empty_v_;
};

}  // namespace swiftlet::autonomy
