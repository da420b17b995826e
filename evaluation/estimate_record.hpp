// The estimates of a flight against the truth at their own stamps.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/trajectory.hpp"
#include "common/vehicle_state.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::evaluation {

/// An estimate with the truth at its own stamp, in the plane.
struct ComparedEstimate {
  common::Pose2 T_map_body;   ///< The estimate in the corrected map.
  common::Pose2 T_odom_body;  ///< The estimate before the correction by the map.
  common::Pose2 T_map_truth;  ///< The true pose in the vehicle's `map` frame.
};

/// Errors at the times of the estimates, while airborne.
class EstimateRecord {
 public:
  EstimateRecord() = default;
  EstimateRecord(const common::Pose3& T_world_start, const common::Pose3& T_world_map)
      : T_world_start_(T_world_start), T_world_map_(T_world_map) {}

  /// At every control tick, in the order of time.
  void tick(const simulation::Truth& truth, const common::VehicleState& estimate);

  /// The body has the axes of the mounted laser here, as the estimate has: at the take-off it is the identity.
  common::Pose3 truthInMap(const common::Pose3& T_world_body) const;
  /// The true pose of the body in `world`, within the last second; nullopt before and after.
  std::optional<common::Pose3> truthAt(common::Time stamp) const { return common::poseAt(history_, stamp); }
  /// The last estimate that was compared, on the ground too.
  const ComparedEstimate& newest() const { return newest_; }

  std::vector<double> horizontal_errors_m, spatial_errors_m, yaw_errors_rad;
  double greatest_height_error_m = 0.0;         ///< While the height was said to be known.
  std::vector<double> horizontal_errors_raw_m;  ///< In FlightRecord::T_world_start.
  /// Mahalanobis distance of that error, by the covariance of the estimate: with two degrees of freedom, the mean of
  /// its square is 2 if the covariance is right. An unknown mount of the laser is part of both.
  std::vector<double> mahalanobis_distances;
  common::Trajectory truth_map;  ///< In the `map` frame, at 20 Hz, for pictures.

 private:
  void compare(const common::VehicleState& estimate, const common::Pose3& T_world_body);

  common::Pose3 T_world_start_, T_world_map_;
  std::deque<common::StampedPose> history_;   ///< The last true poses of the body in `world`.
  std::deque<common::VehicleState> pending_;  ///< Estimates whose stamp is newer than the truth so far.
  ComparedEstimate newest_;
  std::optional<common::Time> last_estimate_, next_trajectory_;
};

/// Visual odometry alone, flown beside the estimate that the vehicle uses, without laser, inertial unit and height
/// (Saeedi, Fig. 1: maps by visual odometry alone fail where those with the poses of the laser do not). As in the
/// paper, loops are closed, and the poses are optimized.
struct VisualOdometryRecord {
  common::Trajectory body;  ///< In a frame of its own; frames that were lost are missing.
  std::size_t frames = 0;   ///< Frames that came.
  std::size_t lost = 0;
};

}  // namespace swiftlet::evaluation
