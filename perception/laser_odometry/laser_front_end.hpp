// What SLAM and localization with a laser that is carried level begin with: scans put in order of time, and the way
// from one to the next, with its uncertainty, from the laser itself. Odometry is taken as a hint where there is some.
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
#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// For a robot that carries its laser level the shipped profile config/systems/laser_log.yaml sets the odometry.
struct LaserFrontEndConfig {
  LaserOdometryConfig odometry;
  MotionPredictionConfig motion;
};

struct LaserSlamInput {
  const common::LaserScan& scan;  ///< Its stamp is the log's.
  common::Pose2 T_robot_laser;
  std::optional<common::Pose2> T_odom_robot;
};

struct LaserSlamCounts {
  std::uint64_t unreliable_stamps = 0;     ///< Not after the one before, or too soon after it.
  std::uint64_t implausible_odometry = 0;  ///< Steps of the odometry that no robot makes.
};

/// A scan and where it was taken. odom is the frame of the laser odometry: it begins at the first scan and is
/// continuous except after a break.
struct FollowedScan {
  ProjectedScan scan;  ///< Its stamp grows from scan to scan.
  common::Pose2 T_odom_robot;
  /// Of the step since the scan before: of the additive errors (x_m, y_m, yaw_rad) with the axes of the robot there.
  Eigen::Matrix3d covariance_since_last = Eigen::Matrix3d::Zero();
  bool matched = false;  ///< False: it stands where it was expected.
  bool broken = false;   ///< How the robot came here from the scan before is not known.
};

/// Not thread-safe. Deterministic.
class LaserFrontEnd {
 public:
  explicit LaserFrontEnd(const LaserFrontEndConfig& config);
  ~LaserFrontEnd();

  /// Whether a scan that is expected at T_odom_robot is kept from the odometry, for what must not be judged by scans
  /// that made it. It stands where it was expected then.
  using Withhold = std::function<bool(const common::Pose2& T_odom_robot)>;

  /// None as long as no scan has had enough points to begin with; until then none is withheld. `withhold` is asked
  /// once.
  std::optional<FollowedScan> add(const LaserSlamInput& input, const Withhold& withhold = {});

  const LaserOdometryCounts& odometryCounts() const;
  LaserSlamCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
