#include "control/vehicle_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"

namespace swiftlet::control {

using common::Message;
using common::Problem;
using common::config::atLeast;
using common::config::kFinite;
namespace {

/// A battery whose voltages differ by less is of the same number of cells and chemistry.
constexpr double kSameBattery = 0.02;

bool differs(double a, double b) { return std::abs(a - b) > kSameBattery * std::max(std::abs(a), std::abs(b)); }

/// What an axis of a multirotor can be. A tilt accelerates by g per radian, less what the attitude loop leaves of it;
/// thrust by g per command over that which carries the weight, so that gain and offset cancel at a hover.
struct AxisBounds {
  const char* name;
  double low_gain, high_gain;
  double low_offset, high_offset;
};
constexpr std::array<AxisBounds, 4> kAxisBounds{{{"forward", 3.0, 30.0, -5.0, 5.0},
                                                 {"left", -30.0, -3.0, -5.0, 5.0},
                                                 {"up", 2.0, 30.0, -30.0, -2.0},
                                                 {"yaw", 0.2, 5.0, -1.0, 1.0}}};
/// The sum of gain and offset at a hover, where the command is the one that carries the weight.
constexpr double kMostAtHover_m_s2 = 5.0;

/// The angle at the command 0, which the rows hold.
double angleAtLevel_deg(const std::vector<CommandAngle>& rows) {
  const auto above =
      std::find_if(std::next(rows.begin()), rows.end(), [](const CommandAngle& row) { return row.command_deg >= 0.0; });
  const auto below = std::prev(above);
  return std::lerp(below->angle_deg, above->angle_deg, -below->command_deg / (above->command_deg - below->command_deg));
}

// A command is about the angle that it asks for.
constexpr double kLeastSlope = 0.5, kGreatestSlope = 2.0;
constexpr double kMostAtLevel_deg = 10.0;

std::vector<Problem> problemsOfBench(const std::string& name, const std::vector<CommandAngle>& rows) {
  if (rows.empty()) return {};
  const auto problem = [](const std::string& element, Message message) {
    return std::vector<Problem>{{{}, element, std::move(message), ""}};
  };
  if (rows.size() == 1)
    return problem(name, Message("bench.one-row", "one row is no mapping, give two and more, or none"));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double command_deg = rows[i].command_deg - rows[i - 1].command_deg;
    const double angle_deg = rows[i].angle_deg - rows[i - 1].angle_deg;
    if (command_deg <= 0.0 || angle_deg <= 0.0)
      return problem(fmt::format("{}[{}]", name, i),
                     Message("bench.falls", "commands and angles must rise from row to row"));
    if (const double slope = angle_deg / command_deg; slope < kLeastSlope || slope > kGreatestSlope)
      return problem(fmt::format("{}[{}].angle_deg", name, i),
                     Message("bench.slope", "changes by {:.2g} deg for each deg of command, {} to {} would fit", slope,
                             kLeastSlope, kGreatestSlope));
  }
  if (rows.front().command_deg > 0.0 || rows.back().command_deg < 0.0)
    return problem(name, Message("bench.one-side", "the commands must reach from below 0 to above 0"));
  if (const double level_deg = angleAtLevel_deg(rows); std::abs(level_deg) > kMostAtLevel_deg)
    return problem(name, Message("bench.not-level", "the command 0 gives {:.1f} deg, at most {} would fit", level_deg,
                                 kMostAtLevel_deg));
  return {};
}

/// The controllers command up to the greatest tilt.
void addShortBench(const char* name, const std::vector<CommandAngle>& rows, double max_tilt_deg,
                   std::vector<Problem>& problems) {
  constexpr double kRounding_deg = 0.5;
  if (rows.empty()) return;
  const double low_deg = rows.front().command_deg, high_deg = rows.back().command_deg;
  if (low_deg <= kRounding_deg - max_tilt_deg && high_deg >= max_tilt_deg - kRounding_deg) return;
  problems.push_back(
      {{},
       name,
       Message("bench.too-short", "the commands reach from {} to {} deg, but the vehicle tilts by up to {} deg",
               low_deg, high_deg, max_tilt_deg),
       "put the vehicle on the bench again"});
}

}  // namespace

std::vector<Problem> problemsOfAxis(const std::string& axis, const AxisModel& model) {
  if (model.gain == 0.0) return {};
  const auto bounds = std::find_if(kAxisBounds.begin(), kAxisBounds.end(),
                                   [&](const AxisBounds& candidate) { return axis == candidate.name; });
  std::vector<Problem> problems;
  const auto add = [&](const std::string& key, Message message) {
    problems.push_back({{}, axis + "." + key, std::move(message), ""});
  };
  const auto within = [&](const char* key, double value, double low, double high) {
    if (value < low || value > high)
      add(key, Message("config.not-within", "{} is not within {} and {}", fmt::format("{:g}", value), low, high));
  };
  within("gain", model.gain, bounds->low_gain, bounds->high_gain);
  within("offset", model.offset, bounds->low_offset, bounds->high_offset);
  if (problems.empty() && axis == "up" && std::abs(model.gain + model.offset) > kMostAtHover_m_s2)
    add("offset", Message("axis.offset", "{:g} is not about the negative gain, {:g}", model.offset, -model.gain));
  if (problems.empty() && model.gain_interval >= std::abs(model.gain))
    add("gain_interval",
        Message("axis.interval", "{:g} leaves nothing of the gain, {:g}", model.gain_interval, model.gain));
  return problems;
}

std::vector<Problem> VehicleModel::validate() const {
  std::vector<Problem> problems;
  const auto add = [&](const std::vector<Problem>& more) { problems.insert(problems.end(), more.begin(), more.end()); };
  add(problemsOfAxis("forward", forward));
  add(problemsOfAxis("left", left));
  add(problemsOfAxis("up", up));
  add(problemsOfAxis("yaw", yaw));
  for (const Problem& problem : control::problemsOf(thrust)) problems.push_back({{}, "thrust", problem.message, ""});
  add(problemsOfBench("bench_pitch", bench_pitch));
  add(problemsOfBench("bench_roll", bench_roll));
  return problems;
}

std::vector<Problem> VehicleModel::problemsFor(const common::VehicleConfig& sheet) const {
  std::vector<Problem> problems;
  if (vehicle != sheet.name)
    problems.push_back(
        {{},
         "vehicle",
         Message("vehicle-model.other-vehicle", "the model is of `{}`, but `{}` flies", vehicle, sheet.name),
         fmt::format("identify a flight of `{}`", sheet.name)});
  addShortBench("bench_pitch", bench_pitch, sheet.max_tilt_deg, problems);
  addShortBench("bench_roll", bench_roll, sheet.max_tilt_deg, problems);
  if (thrust.empty()) return problems;
  const std::size_t before = problems.size();
  const auto check = [&](const char* name, double of_model, double of_sheet, const char* unit) {
    if (differs(of_model, of_sheet))
      problems.push_back({{},
                          name,
                          Message("vehicle-model.other-battery",
                                  "C(U) was learned with a battery of {} {}, but that of `{}` has {} {}", of_model,
                                  unit, sheet.name, of_sheet, unit),
                          ""});
  };
  check("battery_full_v", battery_full_v, sheet.battery_full_v, "V");
  check("battery_empty_v", battery_empty_v, sheet.battery_empty_v, "V");
  check("battery_capacity_ah", battery_capacity_ah, sheet.battery_capacity_ah, "Ah");
  // A table of another battery or vehicle has another C(U); no problem is reported for that.
  if (problems.size() > before || vehicle != sheet.name) return problems;
  if (auto problem = problemOfRows(thrust, sheet)) problems.push_back(std::move(*problem));
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
