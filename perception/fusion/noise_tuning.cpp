#include "perception/fusion/noise_tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "common/random.hpp"

namespace swiftlet::perception {
namespace {

/// The sum of squared errors and their number.
struct Errors {
  double square = 0.0;
  double count = 0.0;
};

Errors errorsOf(const TapedFlight& flight, const FusionConfig& config) {
  TapedReplay replay(flight, config);
  const ErrorStateFilter& filter = replay.filter();
  Errors errors;
  while (replay.next() != nullptr) {
    if (!filter.initialized() || filter.status() == FusionStatus::kDiverged)
      return {std::numeric_limits<double>::infinity(), 1.0};
    const common::VehicleState state = filter.state();
    const TrueMotion truth = replay.truthOfState();
    const Eigen::Vector3d error = inLevelBody(common::yawOf(state.T_odom_body.rotation), state.velocity_odom_m_s) -
                                  inLevelBody(truth.yaw_map_rad, truth.velocity_map_m_s);
    errors.square += error.squaredNorm();
    errors.count += 1.0;
  }
  return errors;
}

Eigen::VectorXd logsOf(const FusionConfig& config) {
  const auto& parameters = noiseParameters();
  Eigen::VectorXd logs(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index i = 0; i < logs.size(); ++i)
    logs[i] = std::log(config.*parameters[static_cast<std::size_t>(i)].value);
  return logs;
}

FusionConfig withLogs(FusionConfig config, const Eigen::VectorXd& logs) {
  const auto& parameters = noiseParameters();
  for (Eigen::Index i = 0; i < logs.size(); ++i)
    config.*parameters[static_cast<std::size_t>(i)].value = std::exp(logs[i]);
  return config;
}

/// Some of the flights, in a random order.
std::vector<const TapedFlight*> drawn(std::vector<const TapedFlight*> flights, std::size_t count,
                                      common::RandomStream& random) {
  for (std::size_t i = 0; i + 1 < flights.size(); ++i) {
    const auto other = i + static_cast<std::size_t>(random.uniform(0.0, 1.0) * static_cast<double>(flights.size() - i));
    std::swap(flights[i], flights[std::min(other, flights.size() - 1)]);
  }
  flights.resize(std::min(flights.size(), count));
  return flights;
}

}  // namespace

const std::vector<NoiseParameter>& noiseParameters() {
  static const std::vector<NoiseParameter> parameters = {
      {"accelerometer_noise_m_s2_rthz", &FusionConfig::accelerometer_noise_m_s2_rthz},
      {"gyroscope_noise_rad_s_rthz", &FusionConfig::gyroscope_noise_rad_s_rthz},
      {"accelerometer_bias_walk_m_s3_rthz", &FusionConfig::accelerometer_bias_walk_m_s3_rthz},
      {"gyroscope_bias_walk_rad_s2_rthz", &FusionConfig::gyroscope_bias_walk_rad_s2_rthz},
      {"ahrs_sigma_deg", &FusionConfig::ahrs_sigma_deg},
      {"drag_noise_m_s2_rthz", &FusionConfig::drag_noise_m_s2_rthz}};
  return parameters;
}

double velocityError_m_s(const std::vector<const TapedFlight*>& flights, const FusionConfig& config) {
  Errors all;
  for (const TapedFlight* flight : flights) {
    const Errors errors = errorsOf(*flight, config);
    all.square += errors.square;
    all.count += errors.count;
  }
  return all.count > 0.0 ? std::sqrt(all.square / all.count) : std::numeric_limits<double>::infinity();
}

Tuning tuneNoise(const std::vector<const TapedFlight*>& flights, const FusionConfig& start,
                 const TuningOptions& options, const std::function<void(int, double)>& progress) {
  const Eigen::VectorXd begin = logsOf(start);
  const double most = std::log(30.0);
  Eigen::VectorXd logs = begin;
  Tuning tuning{start, velocityError_m_s(flights, start), 0.0};
  tuning.after_m_s = tuning.before_m_s;
  common::RandomStream random(options.seed, "tune");
  for (int step = 0; step < options.steps; ++step) {
    const auto some = drawn(flights, static_cast<std::size_t>(options.flights_a_step), random);
    Eigen::VectorXd direction(logs.size());
    for (double& sign : direction) sign = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    const double up = velocityError_m_s(some, withLogs(start, logs + options.perturbation * direction));
    const double down = velocityError_m_s(some, withLogs(start, logs - options.perturbation * direction));
    // The relative slope along the direction; where one side diverges, away from it.
    const double slope = std::isinf(up) || std::isinf(down) ? (std::isinf(up) ? 1.0 : -1.0)
                                                            : (up - down) / (up + down) / options.perturbation;
    constexpr double kGain = 8.0;  // A relative slope of an eighth makes the greatest step.
    const double rate = options.rate / std::sqrt(1.0 + 0.2 * step);
    logs -= std::clamp(kGain * slope, -1.0, 1.0) * rate * direction;
    const Eigen::VectorXd reach = Eigen::VectorXd::Constant(logs.size(), most);
    logs = logs.cwiseMax(begin - reach).cwiseMin(begin + reach);
    const double error = velocityError_m_s(flights, withLogs(start, logs));
    if (error < tuning.after_m_s) {
      tuning.after_m_s = error;
      tuning.config = withLogs(start, logs);
    }
    if (progress) progress(step + 1, tuning.after_m_s);
  }
  return tuning;
}

}  // namespace swiftlet::perception
