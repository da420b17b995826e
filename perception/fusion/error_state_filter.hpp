// Fuses inertial measurements with delayed measurements of relative pose and height in an error-state Kalman filter
// (Tomic 2012, "Data Fusion"; Bachrach 2009, 5.2). Direct state 19: position, velocity, attitude quaternion,
// accelerometer and gyroscope bias, drag, wind; error state 18. Attitude errors are in the odom frame: R = exp(error) *
// R_estimated.
//
// Laser odometry measures the pose of a scan relative to a reference scan that stays the same for many scans. The pose
// at the reference is cloned into the state (stochastic cloning), so that its error and all correlations are kept.
//
// Every measurement is applied at the time it was measured: the filter keeps a ring of IMU samples, states and
// measurements, goes back to that time, and replays everything after it. The state depends on when something was
// measured, not on when it arrived: the same measurements late, on time or in another order give the same bits.
//
// In the body's x and y axes, a multirotor's accelerometer measures only the drag of the rotors, which is proportional
// to the airspeed. The velocity is therefore observable even where no scan constrains it, although only as well as
// bias, drag and wind are known.
//
// Outliers are gated by their Mahalanobis distance. A gate that stays closed for too long is forced open: the
// covariance is widened by the size of the residual. Too many of these recoveries are a divergence, which lasts until
// initialize().
//
// Single-threaded. No heap use after construction, except in motion(), in health() when it is not ok, and in
// initialize() when it fails. Non-finite or impossible input is counted and left out.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <tl/expected.hpp>

#include "common/sensor_event.hpp"
#include "common/vehicle_state.hpp"
#include "perception/fusion/fusion_config.hpp"
#include "perception/fusion/fusion_types.hpp"
#include "perception/fusion/measurement.hpp"
#include "perception/fusion/pose_history.hpp"

namespace swiftlet::perception {

class ErrorStateFilter {
 public:
  using Config = FusionConfig;

  explicit ErrorStateFilter(const Config& config);
  ~ErrorStateFilter();
  ErrorStateFilter(ErrorStateFilter&&) noexcept;
  ErrorStateFilter& operator=(ErrorStateFilter&&) noexcept;

  /// The strapdown step to the sample's time. Before initialize() the samples are only collected. The attitude of the
  /// AHRS may be missing (not finite) if FusionConfig::use_ahrs is false and the sample was measured.
  void predict(const common::ImuSample& sample);

  /// Starts at the newest IMU sample, at x = y = yaw = 0 and the given height. Roll, pitch and the gyroscope bias come
  /// from the samples of the last half second. Fails, with the reason, if there are too few samples or if the vehicle
  /// moved. Discards all earlier states and measurements.
  tl::expected<void, std::string> initialize(double height_m);
  bool initialized() const;
  /// Roll and pitch by gravity over the last half second of samples, with the yaw zero; none while the vehicle moves.
  std::optional<Eigen::Quaterniond> attitudeAtRest() const;

  /// While true, the vehicle is known to stand still: zero velocity and zero rotation are measured, from the next
  /// attitude update on.
  void setAtRest(bool at_rest);
  bool atRest() const;
  /// While true, the samples are not measured but predicted from the vehicle's commands: they count as uncertain as
  /// FusionConfig says, and do not measure the drag.
  void setPredicted(bool predicted);
  bool predicted() const;

  /// Measurements may come late and in any order, within the history.
  Insertion add(const Measurement& measurement);
  bool hasClone(common::Time time) const;
  /// Whether the last relative pose was refused as an outlier.
  bool refusesRelativePoses() const;

  /// The state at the newest IMU sample. T_map_odom is the identity, and height_above_ground_m is the height above the
  /// take-off floor; a caller that knows them better must replace them.
  common::VehicleState state() const;
  common::Time newest() const;
  /// What state() does not say of the estimate at the newest sample; zero before initialize(), but for the drag.
  FusionEstimate estimate() const;

  /// The pose at `time`: interpolated within the history, and extrapolated up to 20 ms past the newest sample. nullopt
  /// outside.
  std::optional<common::Pose3> poseAt(common::Time time) const;
  /// Height and vertical speed of the body origin along z of odom; nullopt where poseAt() has no pose. The height is
  /// interpolated; the speed and the covariance are those of the last IMU sample at or before `time`.
  /// With what the accelerometer alone says of the motion since an earlier time, by the attitudes of the filter.
  std::optional<VerticalMotion> verticalAt(common::Time time, std::optional<common::Time> since = {}) const;
  /// The poses that cover [from, to], as far as the history goes, for many queries, as when a scan is deskewed. The
  /// positions follow from the last one by the velocity: a correction of the position in between is no motion, and
  /// where the position is unknown to a metre the drag alone corrects it by centimetres.
  PoseHistory motion(common::Time from, common::Time to) const;

  /// The status alone allocates nothing.
  FusionStatus status() const;
  FusionHealth health() const;
  FusionCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
