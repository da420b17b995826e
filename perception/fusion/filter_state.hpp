// The estimate of the fusion filter at one instant: direct state, clones, and the covariance of their errors. Plain
// data, copied into the history at each IMU sample.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "perception/fusion/fusion_types.hpp"

namespace swiftlet::perception::fusion {

// Indices of the errors in the covariance. The clones (position, attitude) follow the core.
inline constexpr int kPosition = 0;
inline constexpr int kVelocity = 3;
inline constexpr int kAttitude = 6;
inline constexpr int kAccelerometerBias = 9;
inline constexpr int kGyroscopeBias = 12;
inline constexpr int kDrag = 15;
inline constexpr int kWind = 16;
inline constexpr int kAhrsOffset = 18;  ///< The yaw of the AHRS less that in odom.
inline constexpr int kAhrsDrift = 19;   ///< The rate at which that offset grows.
inline constexpr int kCore = 20;
inline constexpr int kCloneSize = 6;
inline constexpr int kMaxClones = 4;
/// Those that a sensor keeps while the other asks for more: the laser's last reference, and the key frames of visual
/// odometry.
inline constexpr std::array<int, kOdometrySources> kClonesOf{1, 3};
inline constexpr int kMaxDimension = kCore + kCloneSize * kMaxClones;
/// Standard deviation of a yaw that may be any: pi / sqrt(3), that of the uniform distribution.
inline constexpr double kUnknownYaw_rad = 1.8;
/// What is not known of the laser: yaw, x and y of its mount in the body, and its clock.
inline constexpr int kLaserSize = 4;

/// Sized for the present clones, without heap use.
using ErrorCovariance =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxDimension, kMaxDimension>;
using ErrorVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxDimension, 1>;

/// How the errors of the state follow from those of the laser.
using LaserSensitivity = Eigen::Matrix<double, Eigen::Dynamic, kLaserSize, Eigen::ColMajor, kMaxDimension, kLaserSize>;

struct ClonedPose {
  common::Time stamp;
  OdometrySource source = OdometrySource::kLaser;
  common::Pose3 T_odom_body;
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  double yaw_rate_odom_rad_s = 0.0;
};

/// The memory of a gate. It is part of the state, so that a replay makes the same decisions.
struct GateMemory {
  bool closed = false;
  common::Time closed_since;
  common::Time last_accepted;
  std::uint64_t rejected = 0;
  InnovationSum innovations;
};

/// Sums since the last drag measurement: integrals over time of the specific force and of the estimated velocity, along
/// the body's x and y.
struct DragStretch {
  double seconds = 0.0;
  Eigen::Vector2d force_sum_m_s = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_sum_m = Eigen::Vector2d::Zero();
};

/// Gates that were opened by force.
struct Recoveries {
  std::uint64_t all = 0;
  int recent = 0;
  common::Time last;
};

/// When the tilt last agreed with that of the AHRS, and what upDirection() was off by then.
struct TiltAgreement {
  common::Time at;
  Eigen::Vector2d off = Eigen::Vector2d::Zero();
};

struct FilterState {
  common::Time stamp;
  Eigen::Vector3d position_odom_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_odom_m_s = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation_odom_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d accelerometer_bias_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope_bias_rad_s = Eigen::Vector3d::Zero();
  double drag_1_s = 0.0;  ///< Deceleration per airspeed, along the body's x and y.
  Eigen::Vector2d wind_odom_m_s = Eigen::Vector2d::Zero();
  Eigen::Vector2d ahrs_yaw_off = Eigen::Vector2d::Zero();  ///< rad, rad/s: offset of the AHRS's yaw, and its drift.

  TiltAgreement tilt_by_ahrs;
  DragStretch drag_stretch;
  /// The mean of what drag measurements were off by lately, without outliers, along the body's x and y.
  Eigen::Vector2d drag_excess_m_s2 = Eigen::Vector2d::Zero();
  std::array<ClonedPose, kMaxClones> clones;
  int clone_count = 0;
  /// As if the laser were known exactly; the gains are those of this covariance.
  ErrorCovariance covariance = ErrorCovariance::Zero(kCore, kCore);
  LaserSensitivity by_laser = LaserSensitivity::Zero(kCore, kLaserSize);
  double yaw_rate_odom_rad_s = 0.0;  ///< Of the last step.

  GateMemory relative_gate;
  GateMemory height_gate;
  GateMemory spatial_gate;  ///< Of relative poses in space.
  Recoveries recoveries;
  bool diverged = false;

  int dimension() const { return kCore + kCloneSize * clone_count; }
  /// Index of the clone taken at `time`, or -1.
  int cloneAt(common::Time time) const;
  /// Appends a clone of the present pose as a reference of that sensor. See poseClone for what it replaces.
  void clonePose(OdometrySource source);
  void dropClone(int index);
  /// The oldest clone of the sensor, or -1.
  int oldestClone(OdometrySource source) const;
  /// Adds an estimated error to the direct state and the clones.
  void inject(const ErrorVector& error);
  bool finite() const;
};

}  // namespace swiftlet::perception::fusion
