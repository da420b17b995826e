#include "perception/fusion/consistency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "common/normal_distribution.hpp"

namespace swiftlet::perception {
namespace {

constexpr double kInterval_s = 1.0;  ///< Errors at instants nearer to each other are alike.

/// An error of one or two dimensions with the covariance that the filter gave it; the second of one is certain.
struct Error {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();

  double nees() const { return value.dot(covariance.inverse() * value); }
};
Error error1(double value, double variance) {
  Error error;
  error.value.x() = value;
  error.covariance(0, 0) = variance;
  return error;
}

enum Figure { kOfVelocity, kOfClimb, kOfPlace, kOfHeading, kOfHeight, kFigures };
constexpr const char* kNames[kFigures] = {"horizontal velocity", "climb", "place", "heading", "height"};
constexpr int kDegrees[kFigures] = {2, 1, 2, 1, 1};

/// At one instant: the errors, and the innovations since the last one.
struct Sample {
  std::array<Error, kFigures> errors;
  std::array<InnovationSum, 2> innovations;
};
constexpr const char* kInnovationNames[2] = {"relative poses", "heights"};

struct Replay {
  std::vector<Sample> samples;
  bool diverged = false;
};

std::array<Error, kFigures> errorsOf(const ErrorStateFilter& filter, const TrueMotion& truth) {
  const common::VehicleState state = filter.state();
  const double yaw_rad = common::yawOf(state.T_odom_body.rotation);
  const Eigen::Vector3d off_m = state.T_odom_body.position_m - truth.position_map_m;
  std::array<Error, kFigures> errors;
  // In the level body frame, which needs no common heading.
  const Eigen::Matrix2d R_level_odom = Eigen::Rotation2Dd(-yaw_rad).toRotationMatrix();
  errors[kOfVelocity] = {
      R_level_odom * state.velocity_odom_m_s.head<2>() -
          Eigen::Rotation2Dd(-truth.yaw_map_rad) * Eigen::Vector2d(truth.velocity_map_m_s.head<2>()),
      R_level_odom * state.velocity_covariance_m2_s2.topLeftCorner<2, 2>() * R_level_odom.transpose()};
  errors[kOfClimb] =
      error1(state.velocity_odom_m_s.z() - truth.velocity_map_m_s.z(), state.velocity_covariance_m2_s2(2, 2));
  errors[kOfPlace] = {off_m.head<2>(), state.position_covariance_m2.topLeftCorner<2, 2>()};
  // The error of the heading is that of the attitude about z, up to the tilt.
  errors[kOfHeading] = error1(common::wrapAngle(yaw_rad - truth.yaw_map_rad), filter.estimate().covariance(8, 8));
  errors[kOfHeight] = error1(off_m.z(), state.position_covariance_m2(2, 2));
  return errors;
}

InnovationSum between(const InnovationSum& before, const InnovationSum& now) {
  return {now.sum - before.sum, now.degrees - before.degrees};
}

Replay replayed(const TapedFlight& flight, const FusionConfig& config) {
  TapedReplay taped(flight, config);
  const ErrorStateFilter& filter = taped.filter();
  Replay replay;
  std::optional<common::Time> last;
  std::optional<FusionCounts> before;
  while (const TrueMotion* truth = taped.next()) {
    if (last && (truth->stamp - *last).seconds() < kInterval_s - 1e-6) continue;
    last = truth->stamp;
    replay.diverged = !filter.initialized() || filter.status() == FusionStatus::kDiverged;
    if (replay.diverged) return replay;
    const FusionCounts now = filter.counts();
    const FusionCounts since = before.value_or(now);
    replay.samples.push_back(
        {errorsOf(filter, taped.truthOfState()),
         {between(since.relative_poses, now.relative_poses), between(since.heights, now.heights)}});
    before = now;
  }
  return replay;
}

/// The sum over the flights at one instant, and its degrees of freedom.
struct Summed {
  double sum = 0.0, degrees = 0.0;
};

/// Over all instants, of what `at` sums over the flights at each.
template <typename At>
ConsistencyFigure figureOf(std::string name, std::size_t instants, At&& at) {
  ConsistencyFigure figure;
  figure.name = std::move(name);
  std::size_t inside = 0, counted = 0;
  Summed all;
  for (std::size_t instant = 0; instant < instants; ++instant) {
    const Summed one = at(instant);
    if (!(one.degrees > 0.0)) continue;
    const ChiSquaredBounds bounds = chiSquaredBounds95(one.degrees);
    const double mean = one.sum / one.degrees;
    inside += mean >= bounds.lower && mean <= bounds.upper ? 1 : 0;
    ++counted;
    all.sum += one.sum;
    all.degrees += one.degrees;
  }
  if (counted == 0) return figure;
  const auto n = static_cast<double>(counted);
  const ChiSquaredBounds bounds = chiSquaredBounds95(all.degrees / n);
  figure.lower = bounds.lower;
  figure.upper = bounds.upper;
  figure.mean = all.sum / all.degrees;
  figure.inside_share = static_cast<double>(inside) / n;
  return figure;
}

/// The constant covariance that makes the errors likeliest is their second moment.
double sigmaRatio(Figure index, const std::vector<Replay>& replays, std::size_t instants) {
  Eigen::Matrix2d believed = Eigen::Matrix2d::Zero(), made = Eigen::Matrix2d::Zero();
  for (const Replay& replay : replays)
    for (std::size_t instant = 0; instant < instants; ++instant) {
      const Error& error = replay.samples[instant].errors[index];
      believed += error.covariance;
      made += error.value * error.value.transpose();
    }
  if (kDegrees[index] == 1) return std::sqrt(believed(0, 0) / made(0, 0));
  return std::pow(believed.determinant() / made.determinant(), 0.25);
}

ConsistencyFigure errorFigure(Figure index, const std::vector<Replay>& replays, std::size_t instants) {
  ConsistencyFigure figure = figureOf(kNames[index], instants, [&](std::size_t instant) {
    Summed summed;
    for (const Replay& replay : replays) summed.sum += replay.samples[instant].errors[index].nees();
    summed.degrees = static_cast<double>(replays.size()) * kDegrees[index];
    return summed;
  });
  figure.degrees = kDegrees[index];
  figure.sigma_ratio = sigmaRatio(index, replays, instants);
  return figure;
}

ConsistencyFigure innovationFigure(std::size_t kind, const std::vector<Replay>& replays, std::size_t instants) {
  double degrees = 0.0;
  ConsistencyFigure figure = figureOf(kInnovationNames[kind], instants, [&](std::size_t instant) {
    Summed summed;
    for (const Replay& replay : replays) {
      const InnovationSum& one = replay.samples[instant].innovations[kind];
      summed.sum += one.sum;
      summed.degrees += static_cast<double>(one.degrees);
    }
    degrees += summed.degrees;
    return summed;
  });
  figure.degrees = static_cast<int>(
      std::lround(degrees / static_cast<double>(replays.size() * std::max<std::size_t>(instants - 1, 1))));
  return figure;
}

}  // namespace

ChiSquaredBounds chiSquaredBounds95(double degrees) {
  const double spread = 2.0 / (9.0 * degrees);
  const auto quantile = [&](double normal) { return std::pow(1.0 - spread + normal * std::sqrt(spread), 3.0); };
  return {quantile(-common::kNormal95), quantile(common::kNormal95)};
}

Consistency consistencyOf(const std::vector<TapedFlight>& flights, const FusionConfig& config) {
  std::vector<Replay> replays;
  Consistency result;
  for (const TapedFlight& flight : flights) {
    Replay replay = replayed(flight, config);
    if (replay.diverged || replay.samples.empty())
      ++result.diverged;
    else
      replays.push_back(std::move(replay));
  }
  result.flights = replays.size();
  if (replays.empty()) return result;
  result.instants = replays.front().samples.size();
  for (const Replay& replay : replays) result.instants = std::min(result.instants, replay.samples.size());
  for (int i = 0; i < kFigures; ++i)
    result.errors.push_back(errorFigure(static_cast<Figure>(i), replays, result.instants));
  for (std::size_t kind = 0; kind < 2; ++kind)
    result.innovations.push_back(innovationFigure(kind, replays, result.instants));
  return result;
}

}  // namespace swiftlet::perception
