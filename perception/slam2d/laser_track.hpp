// The motion of a level laser, scan by scan, from its scans and, where there is some, the robot's odometry:
//
//   scan --> predict --> LaserOdometry --> where the robot is in the odometry's frame, and how uncertain the step is
//
// The stamps of logs can be doubtful; ScanClock makes of them a time that grows.
#pragma once

#include <cstdint>
#include <optional>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "perception/scan_matching/laser_odometry.hpp"
#include "perception/slam2d/motion_prediction.hpp"
#include "perception/slam2d/scan_clock.hpp"

namespace swiftlet::perception {

struct LaserTrackStep {
  ProjectedScan scan;          ///< In the level frame of the robot; stamped by the clock that grows.
  common::Pose2 T_odom_robot;  ///< Continuous, except after a break.
  /// Of the errors of the step since the scan before: (x_m, y_m, yaw_rad) with the axes of the robot there.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  bool matched = false;  ///< The odometry was made of this scan, too.
  bool broken = false;   ///< How the robot came here from the scan before is not known.
};

/// Not thread-safe. Deterministic.
class LaserTrack {
 public:
  LaserTrack(const LaserOdometryConfig& odometry, const MotionPredictionConfig& motion)
      : config_(odometry), motion_(motion), odometry_(odometry) {}

  /// Where the robot is expected at the next scan, before it is matched. To be called once before `add`.
  const common::Pose2& predict(const common::Stamps& stamps, const std::optional<common::Pose2>& T_odom_robot);

  /// The scan that was predicted. One that is withheld is not matched: it stands where it was expected. None as long as
  /// no scan has had enough points to begin with.
  std::optional<LaserTrackStep> add(const common::LaserScan& scan, const common::Pose2& T_robot_laser, bool withheld);

  const LaserOdometryCounts& odometryCounts() const { return odometry_.counts(); }
  std::uint64_t doubtfulStamps() const { return clock_.doubtful(); }
  std::uint64_t doubtfulSteps() const { return motion_.doubtfulSteps(); }

 private:
  ProjectedScan levelScan(const common::LaserScan& scan, const common::Pose2& T_robot_laser) const;
  Eigen::Matrix3d follow(const std::optional<RelativePose>& relative, bool lost);

  LaserOdometryConfig config_;
  MotionPrediction motion_;
  LaserOdometry odometry_;
  ScanClock clock_;

  bool begun_ = false;
  common::Time now_;
  common::Pose2 before_;  ///< At the scan before, relative to the odometry's reference.
  Eigen::Matrix3d covariance_before_ = Eigen::Matrix3d::Zero();
  common::Pose2 predicted_T_odom_robot_;
  common::Pose2 T_odom_robot_;
  common::Pose2 T_odom_reference_;
  std::optional<common::Pose2> T_odom_matched_;
};

}  // namespace swiftlet::perception
