#include "control/identification/axis_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "common/first_order_lag.hpp"
#include "common/normal_distribution.hpp"

namespace swiftlet::control {
namespace {

/// Which terms are fitted besides k int(u).
struct Terms {
  bool offset = true;   ///< b T.
  bool damped = false;  ///< k2 int(v).
};

/// The equations of all windows: rows of (int u, T, int v), as far as they are fitted, and the changes of velocity.
struct Equations {
  Eigen::MatrixXd left;
  Eigen::VectorXd right;
};

std::size_t windowOf(const AxisSeries& series, const AxisFitOptions& options) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(options.window_s / series.period_s)));
}

std::vector<double> lagged(const AxisSeries& series, double lag_s) {
  std::vector<double> taken(series.command.size());
  const double share = common::followedShare(series.period_s, lag_s);
  double value = series.command.empty() ? 0.0 : series.command.front();
  for (std::size_t i = 0; i < taken.size(); ++i) {
    value += share * (series.command[i] - value);
    taken[i] = value;
  }
  return taken;
}

Equations equationsOf(const std::vector<AxisSeries>& flights, double lag_s, Terms terms,
                      const AxisFitOptions& options) {
  std::vector<std::array<double, 4>> rows;
  for (const AxisSeries& series : flights) {
    const std::vector<double> command = lagged(series, lag_s);
    const std::size_t window = windowOf(series, options);
    for (std::size_t begin = 0; begin + window < command.size(); begin += window) {
      std::array<double, 4> row{0.0, static_cast<double>(window) * series.period_s, 0.0,
                                series.velocity[begin + window] - series.velocity[begin]};
      for (std::size_t i = begin; i < begin + window; ++i) {
        row[0] += series.period_s * command[i];
        row[2] += series.period_s * (series.damped.empty() ? series.velocity[i] : series.damped[i]);
      }
      rows.push_back(row);
    }
  }
  Equations equations;
  const Eigen::Index damping_column = terms.offset ? 2 : 1;
  equations.left.resize(static_cast<Eigen::Index>(rows.size()), damping_column + (terms.damped ? 1 : 0));
  equations.right.resize(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    equations.left(at, 0) = rows[i][0];
    if (terms.offset) equations.left(at, 1) = rows[i][1];
    if (terms.damped) equations.left(at, damping_column) = rows[i][2];
    equations.right(at) = rows[i][3];
  }
  return equations;
}

struct Solution {
  Eigen::VectorXd parameters;
  Eigen::VectorXd intervals;
  double residual_square = std::numeric_limits<double>::infinity();
};

/// Factor by which windows count less if their residuals are correlated with their neighbours' (a first-order process).
double inflation(const Eigen::VectorXd& residuals) {
  double product = 0.0;
  for (Eigen::Index i = 1; i < residuals.size(); ++i) product += residuals[i] * residuals[i - 1];
  const double correlation = std::clamp(product / std::max(residuals.squaredNorm(), 1e-300), 0.0, 0.95);
  return (1.0 + correlation) / (1.0 - correlation);
}

Solution solved(const Equations& equations) {
  Solution solution;
  const Eigen::MatrixXd normal = equations.left.transpose() * equations.left;
  const Eigen::LDLT<Eigen::MatrixXd> factored(normal);
  solution.parameters = factored.solve(equations.left.transpose() * equations.right);
  const Eigen::VectorXd residuals = equations.right - equations.left * solution.parameters;
  const auto free = static_cast<double>(equations.right.size() - equations.left.cols());
  solution.residual_square = residuals.squaredNorm() / std::max(free, 1.0);
  const Eigen::MatrixXd covariance = solution.residual_square * inflation(residuals) *
                                     factored.solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  solution.intervals = common::kNormal95 * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return solution;
}

double deviation(const std::vector<AxisSeries>& flights) {
  double sum = 0.0, square = 0.0, n = 0.0;
  for (const AxisSeries& series : flights)
    for (const double u : series.command) {
      sum += u;
      square += u * u;
      n += 1.0;
    }
  return n > 0.0 ? std::sqrt(std::max(0.0, square / n - sum / n * sum / n)) : 0.0;
}

double duration_s(const std::vector<AxisSeries>& flights) {
  double seconds = 0.0;
  for (const AxisSeries& series : flights) seconds += series.period_s * static_cast<double>(series.command.size());
  return seconds;
}

/// The model of the lag with the least residual.
AxisModel fitted(const std::vector<AxisSeries>& flights, Terms terms, const AxisFitOptions& options) {
  Solution best;
  AxisModel axis;
  for (double lag_s = 0.0; lag_s <= options.longest_lag_s + 1e-9; lag_s += options.lag_step_s) {
    const Solution solution = solved(equationsOf(flights, lag_s, terms, options));
    if (!(solution.residual_square < best.residual_square)) continue;
    best = solution;
    axis.lag_s = lag_s;
  }
  if (best.parameters.size() == 0 || !best.parameters.allFinite()) return {};
  axis.gain = best.parameters[0];
  axis.gain_interval = best.intervals[0];
  if (terms.offset) {
    axis.offset = best.parameters[1];
    axis.offset_interval = best.intervals[1];
  }
  if (terms.damped) {
    axis.damping_1_s = best.parameters.tail<1>()(0);
    axis.damping_interval_1_s = best.intervals.tail<1>()(0);
  }
  axis.residual = std::sqrt(best.residual_square) / options.window_s;
  return axis;
}

}  // namespace

bool lagIsAtBound(const AxisModel& axis, double longest_lag_s, const AxisFitOptions& options) {
  return axis.lag_s > longest_lag_s - 0.5 * options.lag_step_s;
}

tl::expected<AxisModel, std::string> fitAxis(const std::vector<AxisSeries>& flights, bool damped,
                                             const AxisFitOptions& options) {
  const double flown_s = duration_s(flights);
  if (flown_s < options.shortest_s)
    return tl::unexpected(
        fmt::format("{:.1f} s of flight are too few, at least {:g} s are needed", flown_s, options.shortest_s));
  AxisModel axis = fitted(flights, {true, damped}, options);
  if (std::abs(axis.offset) < axis.offset_interval) {
    // A b that does not differ from 0 would only pull at the other values, and at the vehicle.
    const double offset_interval = axis.offset_interval;
    axis = fitted(flights, {false, damped}, options);
    axis.offset_interval = offset_interval;
  }
  if (!(axis.gain_interval < options.widest_interval * std::abs(axis.gain)))
    return tl::unexpected(
        fmt::format("the command moved too little to tell its gain: {:.3g} +- {:.2g}, with a command "
                    "that varies by {:.3g}; fly with more turns and stops",
                    axis.gain, axis.gain_interval, deviation(flights)));
  return axis;
}

tl::expected<AxisModel, std::string> fitRate(const std::vector<AxisSeries>& flights, const AxisFitOptions& options) {
  AxisFitOptions of_rate = options;
  of_rate.longest_lag_s = options.longest_rate_lag_s;
  return fitAxis(flights, false, of_rate);
}

}  // namespace swiftlet::control
