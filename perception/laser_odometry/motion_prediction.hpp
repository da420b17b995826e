// Predicts the next step of a robot before its scan is matched. Two sources compete: the robot's own odometry, and
// constant velocity. The one that predicted the last steps better is used, and its errors tell how wide to search.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/unobservable_motion.hpp"

namespace swiftlet::perception {

struct MotionPredictionConfig {
  double max_speed_m_s = 10.0;

  void describe(common::config::Fields& fields);
};

/// Pose and velocity of the robot at a scan, with their covariance.
struct MotionState {
  common::Pose2 pose;                                  ///< In the frame of the reference.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< (m/s, m/s, rad/s), axes of the robot.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// A filter of pose and velocity relative to a reference scan, to which the other scans are matched. Not thread-safe.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionPredictionConfig& config);

  /// Starts at a scan, before the first step.
  void begin(const std::optional<common::Pose2>& T_odom_robot) { T_odom_robot_ = T_odom_robot; }
  /// Predicts the pose at a scan `elapsed_s` after the last one. `T_odom_robot`: the robot's own odometry at that scan.
  void predict(const std::optional<common::Pose2>& T_odom_robot, double elapsed_s);
  /// The prediction of the other source.
  struct Alternative {
    common::Pose2 T_reference_robot;
    double step_sigma_m = 0.0, step_sigma_rad = 0.0;
  };
  /// nullopt when there is only one source.
  std::optional<Alternative> alternative() const;
  /// Repeats the prediction with the other source, because it was right. There must be an alternative.
  void takeAlternative();
  /// Corrects the pose and the velocity by a match. `covariance` is that of the additive errors (x_m, y_m, yaw_rad) of
  /// the matched pose, axes of the reference. `unobservable_motion_reference`: the change of that pose, along the same
  /// axes, that the match does not show.
  void correct(const common::Pose2& T_reference_robot, const Eigen::Matrix3d& covariance,
               const std::optional<common::UnobservableMotion>& unobservable_motion_reference);
  /// Call when the scan did not match within this distance and rotation of the prediction. The velocity becomes
  /// uncertain. The pose becomes uncertain by the searched range, unless the wheels are the better source.
  void lose(double sought_m, double sought_rad);
  /// Makes the robot's present pose the reference of all poses.
  void rebase();

  const common::Pose2& T_reference_robot() const { return now_.pose; }
  /// The covariance of the additive errors (x_m, y_m, yaw_rad) of the pose, axes of the reference.
  Eigen::Matrix3d covariance() const { return now_.covariance.topLeftCorner<3, 3>(); }
  /// Standard deviation of the last prediction in each direction, from the errors of earlier ones.
  double stepSigma_m() const;
  double stepSigma_rad() const;
  /// Odometry steps that were ignored because they were faster than `max_speed_m_s`.
  std::uint64_t implausibleSteps() const { return implausible_steps_; }

 private:
  struct Source {
    std::optional<common::Pose2> step;  ///< The predicted step, T_before_now; nullopt if not available.
    double variance_m2 = 0.0, variance_rad2 = 0.0;
  };
  const Source& best() const;
  const Source* other() const;
  double sigma_m(const Source& source) const;
  double sigma_rad(const Source& source) const;
  void follow(const Source& source);
  void learn(Source& source, const common::Pose2& step,
             const std::optional<common::UnobservableMotion>& unobservable) const;

  MotionPredictionConfig config_;
  Source wheels_, inertia_;
  std::optional<common::Pose2> T_odom_robot_;
  std::uint64_t implausible_steps_ = 0;
  double elapsed_s_ = 0.0;
  MotionState now_, before_;  ///< At the present scan, and at the previous one.
};

}  // namespace swiftlet::perception
