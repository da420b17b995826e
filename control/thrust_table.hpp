// The command that carries the weight, by battery voltage, learned in flight: the offset C(U) of Grzonka 2012,
// equation 5, as a table.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::control {

/// One row of a learned table.
struct ThrustPoint {
  double voltage_v = 0.0;
  double hover_command = 0.0;  ///< Share of the full command that carries the weight; above 1 it cannot hover.
  double seen_s = 0.0;         ///< Time of flight near this voltage, less what has been forgotten.

  void describe(common::config::Fields& fields);
};
using ThrustPoints = std::vector<ThrustPoint>;

/// What is wrong with rows of a table for one vehicle: voltages that do not rise, or a command that rises with the
/// voltage.
std::vector<common::Problem> problemsOf(const ThrustPoints& points);

/// The first voltage that the vehicle's battery never has in flight, so that the table is of another one. Its element
/// is the key of a list `thrust`: "thrust[3].voltage_v".
std::optional<common::Problem> otherBatteryProblem(const ThrustPoints& points, const common::VehicleConfig& vehicle);

/// Between its knots the logarithm of the command is linear in the voltage; beyond them it follows the data sheet's
/// power law. The command never rises with the voltage. A value: not thread-safe.
class ThrustTable {
 public:
  /// The thrust of a command goes with (voltage / full voltage) to this power where nothing has been learned: that of a
  /// motor whose speed goes with the voltage and whose thrust goes with the square of its speed.
  static constexpr double kVoltageExponent = 2.0;
  /// The learned hover command stays within 1 plus or minus this, times that of the data sheet. See
  /// docs/decisions/control.md#033.
  static constexpr double kMaxCorrection = 0.6;

  explicit ThrustTable(const common::VehicleConfig& vehicle);

  /// Takes over the rows of an earlier flight; the knots between and beyond them follow the law above. Values outside
  /// the bounds about the data sheet are moved to the bound. Without rows it changes nothing.
  void recall(const ThrustPoints& points);
  /// Every knot, also one that only followed the learned ones.
  ThrustPoints points() const;

  /// Moves the command at this voltage by the factor exp(`log_step`), as far as the bounds allow, after `dt_s` near it.
  /// A knot follows the less, the longer the vehicle has flown near its own voltage. Returns the logarithm of the
  /// factor by which the command at this voltage has really changed.
  double learn(double voltage_v, double log_step, double dt_s);

  double hoverCommand(double voltage_v) const;
  /// The hover command of the data sheet.
  double sheetCommand(double voltage_v) const;
  /// Whether that command is within the bounds about the data sheet.
  bool isWithinBounds(const ThrustPoint& point) const;

 private:
  static constexpr std::size_t kKnots = 9;  ///< Evenly over the voltages of the battery.
  struct Place {
    std::size_t below;  ///< The knot below the voltage.
    double share;       ///< How far the voltage is from that knot to the next one, in [0, 1].
  };
  Place placeOf(double voltage_v) const;
  double logAt(double voltage_v) const;
  double bounded(std::size_t knot, double log_command) const;
  void remember(const Place& place, double dt_s);
  void keepFalling(std::size_t from);

  common::VehicleConfig vehicle_;
  std::array<double, kKnots> voltages_v_{};
  std::array<double, kKnots> log_commands_{};
  std::array<double, kKnots> seen_s_{};
};

/// The first row that the table of the vehicle would not recall as it is: of another battery, or a command beyond the
/// bounds about the data sheet.
std::optional<common::Problem> problemOfRows(const ThrustPoints& points, const common::VehicleConfig& vehicle);

}  // namespace swiftlet::control
