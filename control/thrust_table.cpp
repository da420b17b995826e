#include "control/thrust_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/gravity.hpp"
#include "control/battery_span.hpp"

namespace swiftlet::control {
namespace {

using common::Message;

/// After this time near a voltage its hover command follows only half of what is learned at another voltage. See
/// docs/decisions/control.md#033.
constexpr double kFamiliar_s = 10.0;
constexpr double kForget_s = 900.0;  ///< Time constant of flight by which what was learned loses its weight.

}  // namespace

std::vector<common::Problem> problemsOf(const ThrustPoints& points) {
  std::vector<common::Problem> problems;
  const auto add = [&](Message message) { problems.push_back({{}, "", std::move(message), ""}); };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ThrustPoint &below = points[i - 1], &above = points[i];
    if (above.voltage_v <= below.voltage_v)
      add(Message("thrust.voltage-falls", "voltages must rise, but {} follows {}", above.voltage_v, below.voltage_v));
    else if (above.hover_command > below.hover_command)
      add(Message("thrust.command-rises",
                  "hover_command must not rise with the voltage, but it is {} at {} V and {} at {} V",
                  below.hover_command, below.voltage_v, above.hover_command, above.voltage_v));
  }
  return problems;
}

/// A table is learned within the span of the vehicle's battery.
std::optional<common::Problem> otherBatteryProblem(const ThrustPoints& points, const common::VehicleConfig& vehicle) {
  constexpr double kReading = 0.02;  // A voltmeter, or a battery fresh from its charger, may read that much more.
  const VoltageSpan span = batterySpan(vehicle);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double voltage_v = points[i].voltage_v;
    if (voltage_v >= (1.0 - kReading) * span.low_v && voltage_v <= (1.0 + kReading) * span.high_v) continue;
    return common::Problem{
        {},
        fmt::format("thrust[{}].voltage_v", i),
        Message("thrust.other-battery", "{} V is of another battery: that of `{}` has {:.2f} to {:.2f} V in flight",
                voltage_v, vehicle.name, span.low_v, span.high_v),
        ""};
  }
  return std::nullopt;
}

ThrustTable::ThrustTable(const common::VehicleConfig& vehicle) : vehicle_(vehicle) {
  const auto [low_v, high_v] = batterySpan(vehicle);
  for (std::size_t i = 0; i < kKnots; ++i) {
    voltages_v_[i] = low_v + (high_v - low_v) * static_cast<double>(i) / (kKnots - 1);
    log_commands_[i] = std::log(sheetCommand(voltages_v_[i]));
  }
}

double ThrustTable::sheetCommand(double voltage_v) const {
  const double sag = std::pow(voltage_v / vehicle_.battery_full_v, kVoltageExponent);
  return vehicle_.mass_kg * common::kGravity_m_s2 / (vehicle_.max_thrust_n * sag);
}

bool ThrustTable::isWithinBounds(const ThrustPoint& point) const {
  constexpr double kRounding = 1e-3;  // Of the share, in a file with few decimals.
  const double share = point.hover_command / sheetCommand(point.voltage_v);
  return std::abs(share - 1.0) <= kMaxCorrection + kRounding;
}

double ThrustTable::bounded(std::size_t knot, double log_command) const {
  const double sheet = std::log(sheetCommand(voltages_v_[knot]));
  return std::clamp(log_command, sheet + std::log(1.0 - kMaxCorrection), sheet + std::log(1.0 + kMaxCorrection));
}

ThrustTable::Place ThrustTable::placeOf(double voltage_v) const {
  const double low_v = voltages_v_.front(), step_v = voltages_v_[1] - low_v;
  const double at = std::clamp((voltage_v - low_v) / step_v, 0.0, static_cast<double>(kKnots - 1));
  const auto below = std::min(static_cast<std::size_t>(at), kKnots - 2);
  return {below, at - static_cast<double>(below)};
}

double ThrustTable::logAt(double voltage_v) const {
  const Place place = placeOf(voltage_v);
  const double inside_v = std::clamp(voltage_v, voltages_v_.front(), voltages_v_.back());
  const double beyond = -kVoltageExponent * std::log(voltage_v / inside_v);
  return std::lerp(log_commands_[place.below], log_commands_[place.below + 1], place.share) + beyond;
}

double ThrustTable::hoverCommand(double voltage_v) const { return std::exp(logAt(voltage_v)); }

double ThrustTable::learn(double voltage_v, double log_step, double dt_s) {
  const double before = logAt(voltage_v);
  const Place place = placeOf(voltage_v);
  // How far each knot follows: fully near the voltage, and elsewhere the less, the better its own value is known.
  std::array<double, kKnots> follow{};
  for (std::size_t i = 0; i < kKnots; ++i) {
    const double familiar = seen_s_[i] / kFamiliar_s;
    follow[i] = 1.0 / (1.0 + familiar * familiar);
  }
  follow[place.below] = std::max(follow[place.below], 1.0 - place.share);
  follow[place.below + 1] = std::max(follow[place.below + 1], place.share);
  const double here = std::lerp(follow[place.below], follow[place.below + 1], place.share);
  for (std::size_t i = 0; i < kKnots; ++i) {
    const bool near = i == place.below || i == place.below + 1;
    log_commands_[i] = bounded(i, log_commands_[i] + log_step * (near ? follow[i] / here : follow[i]));
  }
  keepFalling(place.below);
  remember(place, dt_s);
  return logAt(voltage_v) - before;
}

/// The two knots at the present voltage are right; knots elsewhere that contradict them are corrected.
void ThrustTable::keepFalling(std::size_t from) {
  log_commands_[from + 1] = std::min(log_commands_[from + 1], log_commands_[from]);
  for (std::size_t i = from + 2; i < kKnots; ++i) log_commands_[i] = std::min(log_commands_[i], log_commands_[i - 1]);
  for (std::size_t i = from; i-- > 0;) log_commands_[i] = std::max(log_commands_[i], log_commands_[i + 1]);
}

void ThrustTable::remember(const Place& place, double dt_s) {
  const double kept = std::exp(-dt_s / kForget_s);
  for (double& seen_s : seen_s_) seen_s *= kept;
  seen_s_[place.below] += (1.0 - place.share) * dt_s;
  seen_s_[place.below + 1] += place.share * dt_s;
}

void ThrustTable::recall(const ThrustPoints& points) {
  if (points.empty()) return;
  for (std::size_t i = 0; i < kKnots; ++i) {
    const double voltage_v = voltages_v_[i];
    const auto above = std::find_if(points.begin(), points.end(),
                                    [voltage_v](const ThrustPoint& point) { return point.voltage_v >= voltage_v; });
    const ThrustPoint& high = above == points.end() ? points.back() : *above;
    const ThrustPoint& low = above == points.begin() ? points.front() : *std::prev(above);
    const double span_v = high.voltage_v - low.voltage_v;
    const double share = span_v > 0.0 ? std::clamp((voltage_v - low.voltage_v) / span_v, 0.0, 1.0) : 0.0;
    const double inside_v = std::clamp(voltage_v, points.front().voltage_v, points.back().voltage_v);
    const double beyond = -kVoltageExponent * std::log(voltage_v / inside_v);
    log_commands_[i] = bounded(i, std::lerp(std::log(low.hover_command), std::log(high.hover_command), share) + beyond);
    seen_s_[i] = voltage_v == inside_v ? std::lerp(low.seen_s, high.seen_s, share) : 0.0;
  }
}

ThrustPoints ThrustTable::points() const {
  ThrustPoints points;
  for (std::size_t i = 0; i < kKnots; ++i) points.push_back({voltages_v_[i], std::exp(log_commands_[i]), seen_s_[i]});
  return points;
}

std::optional<common::Problem> problemOfRows(const ThrustPoints& points, const common::VehicleConfig& vehicle) {
  if (auto problem = otherBatteryProblem(points, vehicle)) return problem;
  const ThrustTable table(vehicle);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (table.isWithinBounds(points[i])) continue;
    const double sheet_command = table.sheetCommand(points[i].voltage_v);
    return common::Problem{{},
                           fmt::format("thrust[{}].hover_command", i),
                           Message("thrust.too-far-from-sheet",
                                   "{} at {} V is too far from the {:.3f} of the data sheet of `{}`: {:.3f} to "
                                   "{:.3f} would fit",
                                   points[i].hover_command, points[i].voltage_v, sheet_command, vehicle.name,
                                   (1.0 - ThrustTable::kMaxCorrection) * sheet_command,
                                   (1.0 + ThrustTable::kMaxCorrection) * sheet_command),
                           ""};
  }
  return std::nullopt;
}

void ThrustPoint::describe(common::config::Fields& fields) {
  fields("voltage_v", voltage_v, {1, 100}, "Battery voltage under load.");
  fields("hover_command", hover_command, {0.02, 5}, "Share of the full command that carries the weight there.");
  fields("seen_s", seen_s, {0, 1e6}, "Time of flight near this voltage, less what has been forgotten.");
}

}  // namespace swiftlet::control
