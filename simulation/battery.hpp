// A lithium-polymer pack: open-circuit voltage over charge, sag over its inner resistance, charge drawn by the motors.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::simulation {

class Battery {
 public:
  struct Config {
    double capacity_ah = 0.0;  ///< 0: that of the data sheet.
    double resistance_ohm = 0.025;
    double electronics_w = 15.0;
    double power_w_per_n15 = 6.0;
    double voltage_exponent = 2.0;

    void describe(common::config::Fields& fields);
  };

  Battery(const common::VehicleConfig& vehicle, const Config& config, double remaining);

  /// From now on `count` cells are short: voltage and inner resistance are those of the others. All cells of a pack are
  /// in series, so that its charge in Ah stays what it is. The data sheet's full voltage is 4.2 V a cell.
  void loseCells(int count);

  /// Draws `power_w` for one step.
  void draw(double power_w, double step_s);

  /// Voltage at the terminals under the present load.
  double voltage_v() const { return voltage_v_; }
  double openCircuit_v() const;
  /// Current in the present step; 0 before the first.
  double current_a() const { return current_a_; }
  /// Share of the charge, in [0, 1].
  double remaining() const { return remaining_; }
  /// (voltage / full voltage) to the power of `voltage_exponent`, the factor by which the thrust falls.
  double thrustShare() const;

 private:
  Config config_;
  double full_v_;
  double empty_v_;
  double remaining_;
  double voltage_v_;
  double sound_share_ = 1.0;  ///< Of the cells.
  double current_a_ = 0.0;
};

}  // namespace swiftlet::simulation
