#include "control/vehicle_model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {

using common::config::atLeast;
using common::config::kFinite;
namespace {

/// A battery whose voltages differ by less is of the same number of cells and chemistry.
constexpr double kSameBattery = 0.02;

bool differs(double a, double b) { return std::abs(a - b) > kSameBattery * std::max(std::abs(a), std::abs(b)); }

std::vector<std::string> problemsOf(const char* name, const std::vector<CommandAngle>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].command_deg <= rows[i - 1].command_deg || rows[i].angle_deg <= rows[i - 1].angle_deg)
      return {fmt::format("{}: commands and angles must rise from row to row", name)};
  return {};
}

}  // namespace

std::vector<std::string> VehicleModel::validate() const {
  std::vector<std::string> problems;
  for (const std::string& problem : control::problemsOf(thrust)) problems.push_back("thrust: " + problem);
  for (const std::string& problem : problemsOf("bench_pitch", bench_pitch)) problems.push_back(problem);
  for (const std::string& problem : problemsOf("bench_roll", bench_roll)) problems.push_back(problem);
  return problems;
}

std::vector<std::string> VehicleModel::problemsFor(const common::VehicleConfig& sheet) const {
  std::vector<std::string> problems;
  if (vehicle != sheet.name)
    problems.push_back(fmt::format("vehicle: the model is of `{}`, but `{}` flies; identify a flight of `{}`", vehicle,
                                   sheet.name, sheet.name));
  const auto check = [&](const char* name, double of_model, double of_sheet, const char* unit) {
    if (differs(of_model, of_sheet))
      problems.push_back(fmt::format("{}: C(U) was learned with a battery of {} {}, but that of `{}` has {} {}", name,
                                     of_model, unit, sheet.name, of_sheet, unit));
  };
  if (thrust.empty()) return problems;
  check("battery_full_v", battery_full_v, sheet.battery_full_v, "V");
  check("battery_empty_v", battery_empty_v, sheet.battery_empty_v, "V");
  check("battery_capacity_ah", battery_capacity_ah, sheet.battery_capacity_ah, "Ah");
  return problems;
}

bool VehicleModel::hasAxes() const {
  return forward.gain != 0.0 && left.gain != 0.0 && up.gain != 0.0 && yaw.gain != 0.0;
}

double commandFor(double angle_rad, const std::vector<CommandAngle>& rows) {
  if (rows.size() < 2) return angle_rad;
  const double angle_deg = angle_rad / common::kRadPerDeg;
  const CommandAngle &first = rows.front(), &last = rows.back();
  double command_deg = 0.0;
  if (angle_deg <= first.angle_deg) {
    command_deg = first.command_deg + (angle_deg - first.angle_deg);
  } else if (angle_deg >= last.angle_deg) {
    command_deg = last.command_deg + (angle_deg - last.angle_deg);
  } else {
    const auto above = std::find_if(rows.begin(), rows.end(),
                                    [angle_deg](const CommandAngle& row) { return row.angle_deg >= angle_deg; });
    const auto below = std::prev(above);
    const double share = (angle_deg - below->angle_deg) / (above->angle_deg - below->angle_deg);
    command_deg = std::lerp(below->command_deg, above->command_deg, share);
  }
  return command_deg * common::kRadPerDeg;
}

void AxisModel::describe(common::config::Fields& fields) {
  fields("gain", gain, kFinite, "Acceleration per command, k; 0 if it was not identified.");
  fields("gain_interval", gain_interval, atLeast(0), "Half of the width of the 95 % interval of the gain.");
  fields("offset", offset, kFinite, "Acceleration without a command, b.");
  fields("offset_interval", offset_interval, atLeast(0), "Half of the width of the 95 % interval of the offset.");
  fields("damping_1_s", damping_1_s, {-20, 20}, "Acceleration per velocity, k2; 0 where there is none.");
  fields("damping_interval_1_s", damping_interval_1_s, atLeast(0),
         "Half of the width of the 95 % interval of the damping.");
  fields("lag_s", lag_s, {0, 2}, "Lag of first order behind which a command takes effect.");
  fields("residual", residual, atLeast(0), "Standard deviation of what the model does not explain.");
}

void CommandAngle::describe(common::config::Fields& fields) {
  fields("command_deg", command_deg, {-180, 180}, "Commanded angle.");
  fields("angle_deg", angle_deg, {-180, 180}, "Angle that the vehicle took.");
}

void VehicleModel::describe(common::config::Fields& fields) {
  fields("version", version, {kVersion, kVersion}, "Version of this file's form.");
  fields("vehicle", vehicle, "Name of the vehicle, as on its data sheet.");
  fields("battery_full_v", battery_full_v, {0, 100}, "Voltage of the full battery that C(U) was learned with.");
  fields("battery_empty_v", battery_empty_v, {0, 100}, "Voltage of the empty battery that C(U) was learned with.");
  fields("battery_capacity_ah", battery_capacity_ah, {0, 1000}, "Charge of the battery that C(U) was learned with.");
  fields.section("forward", forward, "Acceleration along x of the level body frame, in m/s^2, per radian of pitch.");
  fields.section("left", left, "Acceleration along y of the level body frame, in m/s^2, per radian of roll.");
  fields.section("up", up, "Vertical acceleration, in m/s^2, per command over that which carries the weight, C(U).");
  fields.section("yaw", yaw, "Yaw rate per commanded yaw rate.");
  fields.list("thrust", thrust, "The command that carries the weight, C(U), by battery voltage.");
  fields.list("bench_pitch", bench_pitch, "Angle by pitch command, from a bench.");
  fields.list("bench_roll", bench_roll, "Angle by roll command, from a bench.");
}

}  // namespace swiftlet::control
