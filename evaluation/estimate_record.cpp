#include "evaluation/estimate_record.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace swiftlet::evaluation {
namespace {

using common::Duration;
using common::Pose3;

/// The truth is kept for as long as an estimate may come late.
constexpr Duration kHistory = Duration::fromMilliseconds(1000);
/// 20 Hz: at 1 m/s a pose every 5 cm.
constexpr Duration kTrajectoryPeriod = Duration::fromMilliseconds(50);

/// nullopt where the covariance is none, as before a filter has started.
std::optional<double> mahalanobisDistance(const Eigen::Vector2d& error_m, const Eigen::Matrix3d& covariance_m2) {
  const Eigen::LLT<Eigen::Matrix2d> factor(covariance_m2.topLeftCorner<2, 2>());
  if (factor.info() != Eigen::Success) return std::nullopt;
  return std::sqrt(error_m.dot(factor.solve(error_m)));
}

}  // namespace

void EstimateRecord::tick(const simulation::Truth& truth, const common::VehicleState& estimate) {
  history_.push_back({truth.stamp, truth.T_world_body});
  while (truth.stamp - history_.front().stamp > kHistory) history_.pop_front();
  if (!last_estimate_ || estimate.stamp > *last_estimate_) pending_.push_back(estimate);
  last_estimate_ = std::max(estimate.stamp, last_estimate_.value_or(estimate.stamp));
  for (; !pending_.empty() && pending_.front().stamp <= truth.stamp; pending_.pop_front()) {
    const auto T_world_body = truthAt(pending_.front().stamp);
    if (!T_world_body) continue;
    newest_ = {common::planar(pending_.front().T_map_body()), common::planar(pending_.front().T_odom_body),
               common::planar(truthInMap(*T_world_body))};
    if (truth.airborne) compare(pending_.front(), *T_world_body);
  }
}

Pose3 EstimateRecord::truthInMap(const Pose3& T_world_body) const {
  const Pose3 T_body_axes = T_world_start_.inverse() * T_world_map_;
  return T_world_map_.inverse() * T_world_body * T_body_axes;
}

void EstimateRecord::compare(const common::VehicleState& estimate, const Pose3& T_world_body) {
  const Pose3 T_map_body = estimate.T_map_body();
  const Pose3 T_map_truth = truthInMap(T_world_body);
  const Pose3 T_start_truth = T_world_start_.inverse() * T_world_body;
  const Eigen::Vector3d error_m = T_map_body.position_m - T_map_truth.position_m;
  horizontal_errors_m.push_back(error_m.head<2>().norm());
  const Eigen::Vector2d error_raw_m = (T_map_body.position_m - T_start_truth.position_m).head<2>();
  horizontal_errors_raw_m.push_back(error_raw_m.norm());
  const Eigen::Vector2d error_odom_m = Eigen::Rotation2Dd(-estimate.T_map_odom.yaw_rad) * error_raw_m;
  if (const auto distance = mahalanobisDistance(error_odom_m, estimate.position_covariance_m2))
    mahalanobis_distances.push_back(*distance);
  spatial_errors_m.push_back(error_m.norm());
  if (estimate.vertical_valid) greatest_height_error_m = std::max(greatest_height_error_m, std::abs(error_m.z()));
  yaw_errors_rad.push_back(
      std::abs(common::wrapAngle(common::yawOf(T_map_body.rotation) - common::yawOf(T_map_truth.rotation))));
  if (next_trajectory_ && estimate.stamp < *next_trajectory_) return;
  next_trajectory_ = estimate.stamp + kTrajectoryPeriod;
  truth_map.push_back({estimate.stamp, T_map_truth});
}

}  // namespace swiftlet::evaluation
