// What the next step of a robot will be, before its scan is matched: that of its own odometry, or the last step once
// more, whichever predicted the last steps better. How far it was off tells how wide to search.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"

namespace swiftlet::perception {

struct MotionPredictionConfig {
  double memory_steps = 30;
  double first_error_m = 0.10;
  double first_error_deg = 5.0;
  double least_error_m = 0.01;
  double least_error_deg = 0.5;
  double acceleration_m_s2 = 1.0;
  double max_speed_m_s = 10.0;

  void describe(common::config::Fields& fields);
};

/// A filter of pose and velocity, relative to a scan that others are matched to. Not thread-safe.
class MotionPrediction {
 public:
  explicit MotionPrediction(const MotionPredictionConfig& config);

  /// At a scan before the first step.
  void begin(const std::optional<common::Pose2>& T_odom_robot) { T_odom_robot_ = T_odom_robot; }
  /// Moves on to a scan `elapsed_s` after the last one. `T_odom_robot` is that of the robot's own odometry at the scan.
  void predict(const std::optional<common::Pose2>& T_odom_robot, double elapsed_s);
  /// What the other source predicts, if there are two.
  struct Alternative {
    common::Pose2 T_reference_robot;
    double step_sigma_m = 0.0, step_sigma_rad = 0.0;
  };
  std::optional<Alternative> alternative() const;
  /// It was right: the prediction is made anew from it.
  void takeAlternative();
  /// The scan's pose as it was matched, with the covariance of its errors.
  void correct(const common::Pose2& T_reference_robot, const Eigen::Matrix3d& covariance,
               const std::optional<Eigen::Vector2d>& unseen_direction_reference);
  /// It was not matched, though sought so far around: nothing is known of the speed any more, and of the step only what
  /// the wheels say, where they are the better source.
  void lose(double sought_m, double sought_rad);
  /// From now on, all is relative to where the robot is now.
  void rebase();

  const common::Pose2& T_reference_robot() const { return pose_; }
  /// Of its errors (x_m, y_m, yaw_rad), along the reference's axes.
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  /// By how much the last prediction may be wrong in each direction, as experience has it.
  double stepSigma_m() const;
  double stepSigma_rad() const;
  /// Steps of the odometry that no robot makes.
  std::uint64_t implausibleSteps() const { return implausible_steps_; }

 private:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  struct Source {
    std::optional<common::Pose2> step;  ///< What it says of the step, T_before_now.
    double variance_m2 = 0.0, variance_rad2 = 0.0;
  };
  const Source& best() const;
  const Source* other() const;
  double sigma_m(const Source& source) const;
  double sigma_rad(const Source& source) const;
  void follow(const Source& source);
  void learn(Source& source, const common::Pose2& step, const std::optional<Eigen::Vector2d>& unseen_direction) const;

  MotionPredictionConfig config_;
  Source wheels_, inertia_;
  std::optional<common::Pose2> T_odom_robot_;
  std::uint64_t implausible_steps_ = 0;
  double elapsed_s_ = 0.0;
  common::Pose2 before_;  ///< The pose at the last scan.

  common::Pose2 pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< (m/s, m/s, rad/s) with the axes of the robot.
  Matrix6d covariance_ = Matrix6d::Zero();              ///< Of pose and velocity.
  Eigen::Vector3d velocity_before_ = Eigen::Vector3d::Zero();
  Matrix6d covariance_before_ = Matrix6d::Zero();
};

}  // namespace swiftlet::perception
