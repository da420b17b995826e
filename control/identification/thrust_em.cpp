#include "control/identification/thrust_em.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "common/gravity.hpp"

namespace swiftlet::control {
namespace {

struct HoverSample {
  double voltage_v;
  double command;  ///< Brought to a hover.
  double period_s;
};

/// The commands of one flight, each divided by its effect: u cos(tilt) / (1 + a / g).
void addHovers(const FlightSamples& flight, const ThrustEmOptions& options, std::vector<HoverSample>& hovers) {
  if (flight.size() < 2) return;
  const double period_s = periodOf_s(flight);
  if (!(period_s > 0.0)) return;
  const auto half = static_cast<std::size_t>(std::max(1L, std::lround(0.5 * options.smooth_s / period_s)));
  for (std::size_t i = half; i + half < flight.size(); ++i) {
    const FlightSample &before = flight[i - half], &now = flight[i], &after = flight[i + half];
    if (!before.flying || !now.flying || !after.flying || now.battery_v <= 0.0) continue;
    const double up_m_s2 =
        (after.velocity_odom_m_s.z() - before.velocity_odom_m_s.z()) / (after.stamp - before.stamp).seconds();
    double mean = 0.0;
    for (std::size_t j = i - half; j < i + half; ++j) mean += flight[j].thrust * flight[j].tilt_cos;
    const double command = mean / static_cast<double>(2 * half) / (1.0 + up_m_s2 / common::kGravity_m_s2);
    if (std::isfinite(command) && command > 0.0) hovers.push_back({now.battery_v, command, period_s});
  }
}

class Table {
 public:
  Table(double low_v, double high_v, int knots)
      : low_v_(low_v), step_v_((high_v - low_v) / (knots - 1)), commands_(static_cast<std::size_t>(knots), 0.0) {}

  double at(double voltage_v) const {
    const auto [below, share] = placeOf(voltage_v);
    return std::lerp(commands_[below], commands_[below + 1], share);
  }
  double voltage_v(std::size_t knot) const { return low_v_ + step_v_ * static_cast<double>(knot); }
  const std::vector<double>& commands() const { return commands_; }

  /// Weighted least squares over all knots, with a slight bend penalty that carries the table over voltages that were
  /// not flown; then falling. Returns the greatest change.
  double fit(const std::vector<HoverSample>& hovers, const std::vector<double>& weights) {
    const auto n = static_cast<Eigen::Index>(commands_.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (std::size_t i = 0; i < hovers.size(); ++i) {
      const auto [below, share] = placeOf(hovers[i].voltage_v);
      const auto at = static_cast<Eigen::Index>(below);
      const Eigen::Vector2d hat(1.0 - share, share);
      normal.block<2, 2>(at, at) += weights[i] * hat * hat.transpose();
      right.segment<2>(at) += weights[i] * hovers[i].command * hat;
    }
    constexpr double kBend = 0.02;  // Of the weight of a mean knot.
    const double bend = kBend * normal.trace() / static_cast<double>(n);
    for (Eigen::Index knot = 1; knot + 1 < n; ++knot) {
      const Eigen::Vector3d second(1.0, -2.0, 1.0);
      normal.block<3, 3>(knot - 1, knot - 1) += bend * second * second.transpose();
    }
    const Eigen::VectorXd fitted = normal.ldlt().solve(right);
    double moved = 0.0;
    for (Eigen::Index knot = 0; knot < n; ++knot) {
      auto& command = commands_[static_cast<std::size_t>(knot)];
      const double most = knot == 0 ? fitted[knot] : commands_[static_cast<std::size_t>(knot - 1)];
      const double next = std::min(fitted[knot], most);
      moved = std::max(moved, std::abs(next - command));
      command = next;
    }
    return moved;
  }

  std::pair<std::size_t, double> placeOf(double voltage_v) const {
    const double at = std::clamp((voltage_v - low_v_) / step_v_, 0.0, static_cast<double>(commands_.size() - 1));
    const auto below = std::min(static_cast<std::size_t>(at), commands_.size() - 2);
    return {below, at - static_cast<double>(below)};
  }

 private:
  double low_v_, step_v_;
  std::vector<double> commands_;
};

/// The mixture of the two kinds of samples.
struct Mixture {
  double sigma = 0.05;
  double keeping = 0.9;
  static constexpr double kOutside = 1.0;  // Density of the other samples: any command between 0 and 1.

  double probability(double residual) const {
    const double normal =
        keeping / (sigma * std::sqrt(2.0 * std::numbers::pi)) * std::exp(-0.5 * residual * residual / (sigma * sigma));
    return normal / (normal + (1.0 - keeping) * kOutside);
  }
  void fit(const std::vector<double>& residuals, const std::vector<double>& weights) {
    double sum = 0.0, square = 0.0;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      sum += weights[i];
      square += weights[i] * residuals[i] * residuals[i];
    }
    constexpr double kLeastSigma = 1e-4;  // Keeps the mixture from closing in on single samples.
    sigma = std::max(kLeastSigma, std::sqrt(square / std::max(sum, 1e-9)));
    keeping = std::clamp(sum / static_cast<double>(residuals.size()), 0.01, 0.999);
  }
};

ThrustPoints pointsOf(const Table& table, const std::vector<HoverSample>& hovers) {
  std::vector<double> seen_s(table.commands().size(), 0.0);
  for (const HoverSample& hover : hovers) {
    const auto [below, share] = table.placeOf(hover.voltage_v);
    seen_s[below] += (1.0 - share) * hover.period_s;
    seen_s[below + 1] += share * hover.period_s;
  }
  ThrustPoints points;
  for (std::size_t knot = 0; knot < seen_s.size(); ++knot)
    points.push_back({table.voltage_v(knot), table.commands()[knot], seen_s[knot]});
  return points;
}

}  // namespace

tl::expected<ThrustEm, std::string> thrustByVoltage(const std::vector<FlightSamples>& flights,
                                                    const common::VehicleConfig& vehicle,
                                                    const ThrustEmOptions& options) {
  std::vector<HoverSample> hovers;
  for (const FlightSamples& flight : flights) addHovers(flight, options, hovers);
  double flown_s = 0.0, low_v = vehicle.battery_full_v, high_v = 0.0;
  for (const HoverSample& hover : hovers) {
    flown_s += hover.period_s;
    low_v = std::min(low_v, hover.voltage_v);
    high_v = std::max(high_v, hover.voltage_v);
  }
  if (flown_s < options.shortest_s)
    return tl::unexpected(fmt::format("{:.1f} s of flight with a known voltage are too few, at least {:g} s are needed",
                                      flown_s, options.shortest_s));
  constexpr double kLeastSpan_v = 0.05;  // A table needs some width where the voltage did not change.
  Table table(low_v, std::max(high_v, low_v + kLeastSpan_v), options.knots);
  Mixture mixture;
  ThrustEm result;
  std::vector<double> weights(hovers.size(), 1.0), residuals(hovers.size());
  for (; result.rounds < options.most_rounds; ++result.rounds) {
    const double moved = table.fit(hovers, weights);  // M-step, at first with every sample.
    for (std::size_t i = 0; i < hovers.size(); ++i) residuals[i] = hovers[i].command - table.at(hovers[i].voltage_v);
    mixture.fit(residuals, weights);
    for (std::size_t i = 0; i < hovers.size(); ++i) weights[i] = mixture.probability(residuals[i]);  // E-step.
    if (moved < options.settled) break;
  }
  result.points = pointsOf(table, hovers);
  result.sigma = mixture.sigma;
  result.keeping = mixture.keeping;
  return result;
}

}  // namespace swiftlet::control
