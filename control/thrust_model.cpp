#include "control/thrust_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/gravity.hpp"
#include "common/validation.hpp"

namespace swiftlet::control {
namespace {

constexpr double kVoltageFilter_s = 0.5;  ///< Time constant that smooths the measured voltage.
/// Time constant by which the hover command is learned. See docs/decisions/control.md#033.
constexpr double kLearning_s = 2.0;
/// A voltmeter that reads beyond these shares of the empty and of the full battery is wrong, and must not double the
/// thrust.
constexpr double kLeastOfEmpty = 0.8, kMostOfFull = 1.05;

}  // namespace

ThrustModel::ThrustModel(const Config& config, const common::VehicleConfig& vehicle)
    : config_(config), vehicle_(vehicle), table_(vehicle), voltage_v_(vehicle.battery_full_v) {}

void ThrustModel::observeVoltage(double voltage_v, double dt_s) {
  if (!std::isfinite(voltage_v) || voltage_v <= 0.0) return;
  const double plausible_v =
      std::clamp(voltage_v, kLeastOfEmpty * vehicle_.battery_empty_v, kMostOfFull * vehicle_.battery_full_v);
  const double share = voltage_seen_ ? std::min(1.0, dt_s / kVoltageFilter_s) : 1.0;
  voltage_v_ += share * (plausible_v - voltage_v_);
  voltage_seen_ = true;
}

double ThrustModel::learn(double correction_m_s2, double dt_s) {
  if (!learns_) return 0.0;
  const double step_m_s2 = correction_m_s2 * std::min(1.0, dt_s / kLearning_s);
  return std::expm1(table_.learn(voltage_v_, std::log1p(step_m_s2 / common::kGravity_m_s2), dt_s)) *
         common::kGravity_m_s2;
}

double ThrustModel::commandFor(double acceleration_up_m_s2, double cos_tilt) const {
  constexpr double kLeastCosine = 0.5;  // Beyond 60 deg more thrust no longer lifts.
  const double command = table_.hoverCommand(voltage_v_) * (1.0 + acceleration_up_m_s2 / common::kGravity_m_s2) /
                         std::max(kLeastCosine, cos_tilt);
  return clamped(command);
}

double ThrustModel::clamped(double command) const {
  return std::clamp(command, config_.min_thrust, config_.max_thrust);
}

bool ThrustModel::isGreatest(double command) const {
  constexpr double kRounding = 1e-6;  // Of a command that was clamped.
  return command >= config_.max_thrust - kRounding;
}

double ThrustModel::hoverCommand() const { return commandFor(0.0, 1.0); }

void ThrustModel::Config::describe(common::config::Fields& fields) {
  fields("min_thrust", min_thrust, {0, 1}, "Least thrust in flight, so that the attitude stays controlled.");
  fields("max_thrust", max_thrust, {0, 1}, "Greatest thrust commanded.");
}

std::vector<common::Problem> ThrustModel::Config::validate() const {
  return common::Validation().atMost("min_thrust", min_thrust, "max_thrust", max_thrust).problems();
}

}  // namespace swiftlet::control
