// Where the camera is mounted and how late its clock is, estimated in flight.
//
// The camera's motion between two key frames and the body's motion between the same times are the same motion, seen in
// two frames (hand-eye calibration): B X = X C, with the mount X = T_body_camera. A wrong mount turns and shifts X C
// X^-1 against B; a clock that is late by tau gives the body's poses of another time. A Kalman filter of these seven
// unknowns takes each pair of key frames once. Turns about the vertical determine roll, pitch, x and y of the mount,
// and, where they begin and end, the clock. Straight flight determines its yaw. What no motion has observed keeps the
// spread of the prior.
//
// Sources: R. Tsai, R. Lenz, "A new technique for fully autonomous and efficient 3D robotics hand/eye calibration", TRA
// 1989 (rotation about its axis); M. Li, A. Mourikis, "Online temporal calibration for camera-IMU systems", IJRR 2014
// (the clock as a state).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "mapping3d/odometry/alignment.hpp"

namespace swiftlet::mapping3d {

struct CameraCalibrationConfig {
  bool enabled =
      true;  ///< Whether mount and clock of the camera are estimated; otherwise they are those of the data sheet.
  double gate_sigma =
      4.0;  ///< Motions farther off than this many standard deviations, for each degree of freedom, are left out.
};

/// How the body moves at the time of a frame, by the other sensors.
struct MovingBody {
  common::Time time;
  Eigen::Vector3d velocity_body_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_body_rad_s = Eigen::Vector3d::Zero();
  /// The offset of the camera's clock that was taken off the frame's stamp to get this time.
  double clock_offset_s = 0.0;
};

/// The motion from one frame to another.
struct CameraMotion {
  common::Pose3 T_from_to_camera;  ///< As the camera measured it.
  /// Of its error (position, rotation vector), in the axes of the camera at `to`.
  Matrix6d covariance = Matrix6d::Zero();
  common::Pose3 T_from_to_body;  ///< As the other sensors measured it, between the times of `from` and `to`.
  MovingBody from, to;
};

/// How a camera differs from its data sheet.
struct CameraErrors {
  using Vector7d = Eigen::Matrix<double, 7, 1>;
  using Matrix7d = Eigen::Matrix<double, 7, 7>;

  /// Position of the mount in the body (m), its rotation vector in the body (rad), and how much later than the flight's
  /// clock its own is (s).
  Vector7d mean = Vector7d::Zero();
  Matrix7d covariance = Matrix7d::Zero();
};

/// One thread. The same motions in the same order give the same bits.
class CameraCalibration {
 public:
  /// Standard deviation of the mount's attitude at the start, about each axis.
  static constexpr double kMountSigma_rad = 0.015;
  /// Greatest correction that is used, in standard deviations of the start.
  static constexpr double kLimitSigma = 4.0;

  CameraCalibration(const CameraCalibrationConfig& config, const common::Pose3& T_body_camera_sheet);

  void add(const CameraMotion& motion);

  const CameraErrors& errors() const { return errors_; }
  /// Whether a component of the errors is known well enough.
  bool isKnown(int component) const;
  /// The mount with those components of its attitude that are known.
  common::Pose3 T_body_camera() const;
  /// How much later than the flight's clock that of the camera is; 0 while it is not known well enough.
  double clockOffset_s() const;

  /// The motion of the body that the camera measured, by the mount that is used.
  common::Pose3 bodyMotion(const common::Pose3& T_from_to_camera) const;
  /// The covariance of its error (position, rotation vector) in the axes of the body at `to`: that of the camera's
  /// measurement, and what the uncertain mount and clock add to it.
  Matrix6d bodyCovariance(const CameraMotion& motion) const;

 private:
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  using Jacobian = Eigen::Matrix<double, 6, 7>;
  void letClockDrift(common::Time now);
  common::Pose3 mountWith(const CameraErrors::Vector7d& errors) const;
  CameraErrors::Vector7d used() const;
  Vector6d residual(const CameraMotion& motion, const CameraErrors::Vector7d& errors) const;
  Jacobian jacobian(const CameraMotion& motion, const CameraErrors::Vector7d& at) const;

  CameraCalibrationConfig config_;
  common::Pose3 T_body_camera_sheet_;
  CameraErrors errors_;
  CameraErrors::Vector7d prior_sigma_;
  std::optional<common::Time> newest_;  ///< End of the newest motion.
};

}  // namespace swiftlet::mapping3d
