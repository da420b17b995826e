#include "control/identification/identify.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

/// The pieces of a flight that were flown without a break, as series of one axis.
std::vector<AxisSeries> seriesOf(const std::vector<FlightSamples>& flights,
                                 const std::function<void(const FlightSample&, AxisSeries&)>& add) {
  constexpr double kGap = 1.5;  // Periods.
  std::vector<AxisSeries> all;
  for (const FlightSamples& flight : flights) {
    if (flight.size() < 2) continue;
    const double period_s = periodOf_s(flight);
    AxisSeries series{period_s, {}, {}, {}};
    const auto close = [&] {
      if (!series.command.empty()) all.push_back(std::move(series));
      series = AxisSeries{period_s, {}, {}, {}};
    };
    for (std::size_t i = 0; i < flight.size(); ++i) {
      const bool breaks =
          !flight[i].flying || (i > 0 && (flight[i].stamp - flight[i - 1].stamp).seconds() > kGap * period_s);
      if (breaks) close();
      if (flight[i].flying) add(flight[i], series);
    }
    close();
  }
  return all;
}

/// The velocity along an axis of the level body frame as it would be had the vehicle not turned: the sum of its changes
/// along that axis.
struct LevelVelocity {
  bool left = false;
  Eigen::Vector2d last_m_s = Eigen::Vector2d::Zero();

  void add(const FlightSample& sample, AxisSeries& series) {
    const double c = std::cos(sample.yaw_odom_rad), s = std::sin(sample.yaw_odom_rad);
    const Eigen::Vector2d axis = left ? Eigen::Vector2d(-s, c) : Eigen::Vector2d(c, s);
    const Eigen::Vector2d velocity_m_s = sample.velocity_odom_m_s.head<2>();
    series.velocity.push_back(series.velocity.empty() ? velocity_m_s.dot(axis)
                                                      : series.velocity.back() + (velocity_m_s - last_m_s).dot(axis));
    series.damped.push_back(velocity_m_s.dot(axis));
    series.command.push_back(left ? sample.roll_rad : sample.pitch_rad);
    last_m_s = velocity_m_s;
  }
};

/// C(U), interpolated between the rows and constant beyond them.
double hoverAt(const ThrustPoints& points, double voltage_v) {
  const auto above = std::find_if(points.begin(), points.end(),
                                  [voltage_v](const ThrustPoint& point) { return point.voltage_v >= voltage_v; });
  if (above == points.end()) return points.back().hover_command;
  if (above == points.begin()) return above->hover_command;
  const auto below = std::prev(above);
  return std::lerp(below->hover_command, above->hover_command,
                   (voltage_v - below->voltage_v) / (above->voltage_v - below->voltage_v));
}

/// C(U), or why it has no value that a flight of the vehicle could start from.
tl::expected<ThrustEm, std::string> usableThrust(const std::vector<FlightSamples>& flights,
                                                 const common::VehicleConfig& vehicle) {
  auto thrust = thrustByVoltage(flights, vehicle);
  if (!thrust) return thrust;
  if (const auto problem = problemOfRows(thrust->points, vehicle)) return tl::unexpected(problem->message.text());
  return thrust;
}

}  // namespace

Identification identify(const std::vector<FlightSamples>& flights, const common::VehicleConfig& vehicle,
                        const AxisFitOptions& options) {
  Identification result;
  VehicleModel& model = result.model;
  model.version = VehicleModel::kVersion;
  model.vehicle = vehicle.name;
  model.battery_full_v = vehicle.battery_full_v;
  model.battery_empty_v = vehicle.battery_empty_v;
  model.battery_capacity_ah = vehicle.battery_capacity_ah;

  const auto keep = [&](const char* name, const tl::expected<AxisModel, std::string>& fitted, double longest_lag_s,
                        AxisModel& axis) {
    if (!fitted) return result.problems.push_back(std::string(name) + ": " + fitted.error());
    if (const auto unfit = problemsOfAxis(name, *fitted); !unfit.empty())
      return result.problems.push_back(toString(unfit.front()) + "; no vehicle is like that");
    axis = *fitted;
    if (lagIsAtBound(axis, longest_lag_s, options))
      result.doubts.push_back(
          fmt::format("{}: lag at its bound of {:g} s; fly with quicker changes of the command", name, axis.lag_s));
  };
  const auto both = [&](const char* name, const std::vector<AxisSeries>& series, AxisModel& axis, AxisModel& damped) {
    keep(name, fitAxis(series, false, options), options.longest_lag_s, axis);
    if (const auto fitted = fitAxis(series, true, options)) damped = *fitted;
  };
  LevelVelocity forward, left{.left = true};
  both("forward", seriesOf(flights, [&](const auto& sample, auto& series) { forward.add(sample, series); }),
       model.forward, result.damped_forward);
  both("left", seriesOf(flights, [&](const auto& sample, auto& series) { left.add(sample, series); }), model.left,
       result.damped_left);
  if (const auto thrust = usableThrust(flights, vehicle)) {
    result.thrust = *thrust;
    model.thrust = thrust->points;
    both("up",
         seriesOf(flights,
                  [&](const auto& sample, auto& series) {
                    series.command.push_back(sample.thrust * sample.tilt_cos / hoverAt(model.thrust, sample.battery_v));
                    series.velocity.push_back(sample.velocity_odom_m_s.z());
                  }),
         model.up, result.damped_up);
  } else {
    result.problems.push_back("thrust: " + thrust.error());
    result.problems.push_back("up: needs C(U)");
  }
  keep("yaw",
       fitRate(seriesOf(flights,
                        [](const auto& sample, auto& series) {
                          series.command.push_back(sample.yaw_rate_rad_s);
                          const double last = series.velocity.empty() ? sample.yaw_odom_rad : series.velocity.back();
                          series.velocity.push_back(last + common::wrapAngle(sample.yaw_odom_rad - last));
                        }),
               options),
       options.longest_rate_lag_s, model.yaw);

  return result;
}

}  // namespace swiftlet::control
