// The first stage of SLAM and localization with a laser that is carried level. It orders the scans in time and
// estimates the motion from one to the next, with its uncertainty, from the laser itself. Odometry is used as a hint if
// the input has it.
//
//   scan --> ScanClock --> MotionPrediction --> LaserOdometry --> pose in odom, covariance of the step
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "perception/laser_odometry/laser_odometry.hpp"
#include "perception/laser_odometry/motion_prediction.hpp"
#include "perception/laser_odometry/sweep_motion.hpp"
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// The shipped profile config/systems/laser_log.yaml has the settings for a robot that carries its laser level.
struct LaserFrontEndConfig {
  LaserOdometryConfig odometry;
  MotionPredictionConfig motion;
};

struct LaserSlamInput {
  const common::LaserScan& scan;  ///< Stamped by the log.
  common::Pose2 T_robot_laser;
  std::optional<common::Pose2> T_odom_robot;
  /// During the sweep, which is then undone; the pose is that at the beginning. Null: all beams have the same pose.
  const SweepMotion* motion = nullptr;
};

struct LaserSlamCounts {
  std::uint64_t unreliable_stamps = 0;     ///< Stamps not after the one before, or too soon after it.
  std::uint64_t implausible_odometry = 0;  ///< Odometry steps faster than MotionPredictionConfig::max_speed_m_s.
};

/// A scan and the pose at which it was taken. odom is the frame of the laser odometry: it begins at the first scan and
/// is continuous except after a break.
struct FollowedScan {
  ProjectedScan scan;  ///< Its stamp is later than that of every scan before.
  common::Pose2 T_odom_robot;
  common::Pose2 T_expected_robot;  ///< Relative to where it was predicted, before the match.
  /// Covariance of the step since the previous scan: of the additive errors (x_m, y_m, yaw_rad), axes of the robot at
  /// the previous scan.
  Eigen::Matrix3d covariance_since_last = Eigen::Matrix3d::Zero();
  bool matched = false;  ///< False: the pose is the predicted one.
  bool broken = false;   ///< The odometry restarted: the motion since the previous scan is not known.
};

/// Not thread-safe. Deterministic.
class LaserFrontEnd {
 public:
  explicit LaserFrontEnd(const LaserFrontEndConfig& config);
  ~LaserFrontEnd();

  /// Whether to withhold a scan, predicted at T_odom_robot, from the odometry. The scan then keeps its predicted pose.
  /// This serves evaluations, which must not use the scans that the odometry has used.
  using Withhold = std::function<bool(const common::Pose2& T_odom_robot)>;

  /// Takes in a scan. Returns nothing until a first scan has had enough points to start; until then none is withheld.
  /// `withhold` is called once.
  std::optional<FollowedScan> add(const LaserSlamInput& input, const Withhold& withhold = {});

  const LaserOdometryCounts& odometryCounts() const;
  LaserSlamCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
