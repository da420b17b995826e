#include "perception/fusion/consistency.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "common/normal_distribution.hpp"

namespace swiftlet::perception {
namespace {

constexpr double kInterval_s = 1.0;  ///< Errors at instants nearer to each other are alike.
constexpr int kFigures = 3;
constexpr const char* kNames[kFigures] = {"horizontal velocity", "climb", "height"};
constexpr int kDegrees[kFigures] = {2, 1, 1};

/// Normalized errors squared, in the order of the figures.
using Sample = std::array<double, kFigures>;

struct Replay {
  std::vector<Sample> samples;
  FusionCounts counts;
  bool diverged = false;
};

Sample sampleOf(const ErrorStateFilter& filter, const TrueVelocity& truth) {
  const common::VehicleState state = filter.state();
  const double yaw_rad = common::yawOf(state.T_odom_body.rotation);
  // In the level body frame, which needs no common heading.
  const Eigen::Rotation2Dd R_level_odom(-yaw_rad), R_level_map(-truth.yaw_map_rad);
  const Eigen::Vector2d error_m_s = R_level_odom * Eigen::Vector2d(state.velocity_odom_m_s.head<2>()) -
                                    R_level_map * Eigen::Vector2d(truth.velocity_map_m_s.head<2>());
  const Eigen::Matrix2d rotation = R_level_odom.toRotationMatrix();
  const Eigen::Matrix2d covariance =
      rotation * state.velocity_covariance_m2_s2.topLeftCorner<2, 2>() * rotation.transpose();
  const double climb_error_m_s = state.velocity_odom_m_s.z() - truth.velocity_map_m_s.z();
  const double height_error_m = state.T_odom_body.position_m.z() - truth.height_m;
  return {error_m_s.dot(covariance.inverse() * error_m_s),
          climb_error_m_s * climb_error_m_s / state.velocity_covariance_m2_s2(2, 2),
          height_error_m * height_error_m / state.position_covariance_m2(2, 2)};
}

Replay replayed(const TapedFlight& flight, const FusionConfig& config) {
  TapedReplay taped(flight, config);
  const ErrorStateFilter& filter = taped.filter();
  Replay replay;
  std::optional<common::Time> last;
  while (const TrueVelocity* truth = taped.next()) {
    if (last && (truth->stamp - *last).seconds() < kInterval_s - 1e-6) continue;
    last = truth->stamp;
    replay.diverged = !filter.initialized() || filter.health().status == FusionStatus::kDiverged;
    if (replay.diverged) return replay;
    replay.samples.push_back(sampleOf(filter, *truth));
  }
  replay.counts = filter.counts();
  return replay;
}

ConsistencyFigure figureOf(int index, const std::vector<Replay>& replays, std::size_t instants) {
  const auto degrees = static_cast<double>(kDegrees[index]);
  const auto flights = static_cast<double>(replays.size());
  ConsistencyFigure figure{kNames[index], kDegrees[index]};
  const ChiSquaredBounds bounds = chiSquaredBounds95(flights * degrees);
  figure.lower = bounds.lower;
  figure.upper = bounds.upper;
  std::size_t inside = 0;
  for (std::size_t instant = 0; instant < instants; ++instant) {
    double sum = 0.0;
    for (const Replay& replay : replays) sum += replay.samples[instant][static_cast<std::size_t>(index)];
    const double mean = sum / (flights * degrees);
    figure.mean += mean / static_cast<double>(instants);
    if (mean >= figure.lower && mean <= figure.upper) ++inside;
  }
  figure.inside_share = static_cast<double>(inside) / static_cast<double>(instants);
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
  InnovationSum poses, heights;
  for (const Replay& replay : replays) {
    result.instants = std::min(result.instants, replay.samples.size());
    poses.sum += replay.counts.relative_poses.sum;
    poses.degrees += replay.counts.relative_poses.degrees;
    heights.sum += replay.counts.heights.sum;
    heights.degrees += replay.counts.heights.degrees;
  }
  for (int i = 0; i < kFigures; ++i) result.errors.push_back(figureOf(i, replays, result.instants));
  result.relative_pose_nis = poses.mean();
  result.height_nis = heights.mean();
  return result;
}

}  // namespace swiftlet::perception
