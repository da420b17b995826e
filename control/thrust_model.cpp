#include "control/thrust_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::control {

using common::config::kPositive;

ThrustModel::ThrustModel(const Config& config, const common::VehicleConfig& vehicle)
    : config_(config), vehicle_(vehicle), voltage_v_(vehicle.battery_full_v) {}

void ThrustModel::observeVoltage(double voltage_v, double dt_s) {
  if (!std::isfinite(voltage_v) || voltage_v <= 0.0) return;
  // A voltmeter that is clearly wrong must not double the thrust.
  const double plausible_v = std::clamp(voltage_v, 0.8 * vehicle_.battery_empty_v, 1.05 * vehicle_.battery_full_v);
  const double share = voltage_seen_ ? std::min(1.0, dt_s / config_.voltage_filter_s) : 1.0;
  voltage_v_ += share * (plausible_v - voltage_v_);
  voltage_seen_ = true;
}

double ThrustModel::learn(double correction_m_s2, double dt_s) {
  const double before = correction_;
  const double step_m_s2 = correction_m_s2 * std::min(1.0, dt_s / config_.learning_time_s);
  correction_ = std::clamp(correction_ * (1.0 + step_m_s2 / kGravity_m_s2), 1.0 - config_.max_correction,
                           1.0 + config_.max_correction);
  return (correction_ / before - 1.0) * kGravity_m_s2;
}

double ThrustModel::unclampedCommand(double acceleration_up_m_s2, double cos_tilt) const {
  const double sag = std::pow(voltage_v_ / vehicle_.battery_full_v, config_.voltage_exponent);
  const double force_n = vehicle_.mass_kg * (kGravity_m_s2 + acceleration_up_m_s2) / std::max(0.5, cos_tilt);
  return correction_ * force_n / (vehicle_.max_thrust_n * sag);
}

double ThrustModel::commandFor(double acceleration_up_m_s2, double cos_tilt) const {
  return std::clamp(unclampedCommand(acceleration_up_m_s2, cos_tilt), config_.min_thrust, config_.max_thrust);
}

double ThrustModel::margin() const { return config_.max_thrust / unclampedCommand(0.0, 1.0); }

double ThrustModel::hoverCommand() const { return commandFor(0.0, 1.0); }

void ThrustModel::Config::describe(common::config::Fields& fields) {
  fields("voltage_exponent", voltage_exponent, {0, 4},
         "The thrust of a command goes with (voltage / full voltage) to this power.");
  fields("voltage_filter_s", voltage_filter_s, kPositive, "Time constant that smooths the measured voltage.");
  fields("learning_time_s", learning_time_s, kPositive, "Time constant by which the hover command is learned.");
  fields("max_correction", max_correction, {0, 0.9}, "The learned factor stays within 1 plus or minus this.");
  fields("min_thrust", min_thrust, {0, 1}, "Least thrust in flight, so that the attitude stays controlled.");
  fields("max_thrust", max_thrust, {0, 1}, "Greatest thrust commanded.");
}

std::vector<std::string> ThrustModel::Config::validate() const {
  return common::Validation().atMost("min_thrust", min_thrust, "max_thrust", max_thrust).problems();
}

}  // namespace swiftlet::control
