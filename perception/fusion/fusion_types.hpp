// The status and counters of the fusion filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace swiftlet::perception {

/// What measures relative poses.
enum class OdometrySource : std::uint8_t { kLaser, kVision };
inline constexpr std::size_t kOdometrySources = 2;

enum class FusionStatus { kNotInitialized, kOk, kDegraded, kDiverged };
const char* toString(FusionStatus status);

struct FusionHealth {
  FusionStatus status = FusionStatus::kNotInitialized;
  std::string reason;  ///< Empty when ok.
};

/// The result of adding a measurement. Measurements rejected by the gate appear only in the counts.
enum class Insertion {
  kTaken,
  kInvalid,  ///< Not finite, covariance not positive definite, or time not after the reference.
  kTooOld,   ///< Older than the history, or the history is full.
  kTooNew,   ///< So far ahead of the IMU that the clocks must disagree.
  /// The reference was never cloned, or its clone was dropped for newer ones and is older than the history. A relative
  /// pose to a clone dropped within the history is kTaken, but has no effect.
  kUnknownReference,
};

/// Normalized innovations squared (NIS) of one kind of measurement, before its gate: their mean for each degree of
/// freedom is 1 if the filter's covariance and the measurements' are right.
struct InnovationSum {
  double sum = 0.0;
  std::uint64_t degrees = 0;  ///< Degrees of freedom.

  double mean() const { return degrees > 0 ? sum / static_cast<double>(degrees) : 0.0; }
};

struct FusionCounts {
  std::uint64_t imu_dropped = 0;  ///< Non-finite, repeated or out of order.
  std::uint64_t measurements = 0;
  std::uint64_t refused = 0;  ///< Measurements that were not kTaken.
  std::uint64_t replays = 0;  ///< IMU steps computed again.
  /// Counted along the present history: each measurement counts once, however often it is replayed.
  std::uint64_t relative_poses_gated = 0;
  std::uint64_t heights_gated = 0;
  std::uint64_t recoveries = 0;
  InnovationSum relative_poses, heights;
};

struct FusionEstimate {
  /// In odom, gravity and bias removed.
  Eigen::Vector3d acceleration_odom_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_bias_m_s2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope_bias_rad_s = Eigen::Vector3d::Zero();
  double drag_1_s = 0.0;
  /// Of the errors (position, velocity, attitude, accelerometer bias, gyroscope bias).
  Eigen::Matrix<double, 15, 15> covariance = Eigen::Matrix<double, 15, 15>::Zero();
};

/// The vertical part of the vehicle's state, in odom.
struct VerticalState {
  double height_m = 0.0;
  double velocity_m_s = 0.0;
  double bias_m_s2 = 0.0;  ///< Of the accelerometer, along the body's z axis.
  /// Of (height_m, velocity_m_s, bias_m_s2).
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  Eigen::Vector3d mean() const { return {height_m, velocity_m_s, bias_m_s2}; }
};

/// What the accelerometer says of the vertical motion over a time, for a vehicle that was at rest at its beginning. The
/// bias along the body's z is in it, those across it, which a tilted body feels, are not.
struct InertialClimb {
  double height_m = 0.0;
  double velocity_m_s = 0.0;
  double noise_m_s2_rthz = 0.0;  ///< Noise density of the samples.
};

struct VerticalMotion : VerticalState {
  std::optional<InertialClimb> climb;  ///< nullopt: not asked for, or outside of the history.
};

}  // namespace swiftlet::perception
