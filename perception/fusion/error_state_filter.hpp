// Inertial measurements fused with late measurements of relative pose and height: an error-state Kalman filter
// (Tomic 2012, "Data Fusion"; Bachrach 2009, 5.2). Direct state 19: position, velocity, attitude quaternion,
// accelerometer and gyroscope bias, drag, wind; error state 18. Attitude errors are in the odom frame: R = exp(error) *
// R_estimated.
//
// A laser odometry measures the pose of a scan relative to a reference scan that stays the same over many scans. The
// pose at the reference is cloned into the state (stochastic cloning), so that its error and all correlations are kept.
//
// Every measurement is applied at the time it was measured: the filter keeps a ring of IMU samples, states and
// measurements, steps back, and replays everything after. The state is a function of what was measured when, not of
// when it arrived: the same measurements late, on time or in another order give the same bits.
//
// A multirotor's accelerometer feels in the body's x and y the drag of its rotors alone, which goes with the speed
// through the air. So the velocity is known, if only as well as bias, drag and wind are, also where no scan holds it.
//
// Outliers are gated by their Mahalanobis distance. A gate that stays closed for `recovery_s` is opened by force, the
// covariance widened by what the measurement says; doing so too often is a divergence. A divergence stays until
// initialize().
//
// One thread. No heap use after construction, except in poses(), in health() when it is not ok, and in initialize()
// when it refuses. Non-finite or impossible input is counted and left out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_state.hpp"
#include "perception/fusion/pose_history.hpp"

namespace swiftlet::perception {

enum class FusionStatus { kNotInitialized, kOk, kDegraded, kDiverged };
const char* toString(FusionStatus status);

struct FusionHealth {
  FusionStatus status = FusionStatus::kNotInitialized;
  std::string reason;  ///< Empty when ok.
};

/// What became of a measurement that was handed in. Whether the gate lets it pass shows in the counts.
enum class Insertion {
  kTaken,
  kInvalid,           ///< Not finite, covariance not positive, time before the reference.
  kTooOld,            ///< Older than the history.
  kTooNew,            ///< So far ahead of the IMU that clocks must be wrong.
  kUnknownReference,  ///< The reference was never cloned, or was dropped for newer ones.
};

struct FusionCounts {
  std::uint64_t imu_dropped = 0;  ///< Non-finite, repeated or out of order.
  std::uint64_t measurements = 0;
  std::uint64_t refused = 0;  ///< Not kTaken.
  std::uint64_t replays = 0;  ///< IMU steps computed again.
  /// Along the present history: each measurement counts once however often it is replayed.
  std::uint64_t relative_poses_gated = 0;
  std::uint64_t heights_gated = 0;
  std::uint64_t recoveries = 0;
};

struct VerticalState {
  double height_m = 0.0;
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of (height_m, velocity_m_s).
};

class ErrorStateFilter {
 public:
  struct Config {
    double history_s = 1.0;
    double gravity_m_s2 = 9.81;
    double accelerometer_noise_m_s2_rthz = 0.02;
    double gyroscope_noise_rad_s_rthz = 0.002;
    double accelerometer_bias_walk_m_s3_rthz = 0.003;
    double gyroscope_bias_walk_rad_s2_rthz = 0.0005;
    double accelerometer_bias_sigma_m_s2 = 0.2;
    bool use_ahrs = true;
    double ahrs_sigma_deg = 1.0;
    double ahrs_correlation_s = 10.0;
    bool use_gravity = false;
    double gravity_sigma_m_s2 = 1.0;
    double attitude_rate_hz = 10.0;
    bool use_drag = true;
    double drag_1_s = 0.3;
    double drag_sigma_1_s = 0.2;
    double drag_walk_1_s_rts = 0.002;
    double drag_noise_m_s2_rthz = 0.02;
    double wind_sigma_m_s = 0.3;
    double wind_walk_m_s_rts = 0.001;
    double rest_s = 0.5;
    double rest_gyroscope_sigma_rad_s = 0.05;
    double rest_accelerometer_sigma_m_s2 = 0.5;
    double zero_velocity_sigma_m_s = 0.02;
    double zero_rotation_sigma_rad_s = 0.01;
    double gate_sigma = 4.0;
    double recovery_s = 0.4;
    int max_recoveries = 3;
    double recovery_window_s = 5.0;
    double max_speed_m_s = 8.0;
    double horizontal_timeout_s = 0.5;
    double vertical_timeout_s = 6.0;
    double valid_velocity_sigma_m_s = 0.35;
    double valid_height_sigma_m = 0.25;
    double diverged_velocity_sigma_m_s = 3.0;

    void describe(common::config::Fields& fields);
  };

  explicit ErrorStateFilter(const Config& config);
  ~ErrorStateFilter();
  ErrorStateFilter(ErrorStateFilter&&) noexcept;
  ErrorStateFilter& operator=(ErrorStateFilter&&) noexcept;

  /// The strapdown step to the sample's time. Before initialize() samples are only gathered for it.
  void predict(const common::ImuSample& sample);

  /// Starts at the newest IMU sample, at x = y = yaw = 0 and the given height: roll, pitch and the gyroscope bias from
  /// the last `rest_s` of samples. Fails, with the reason, when there are too few or when the vehicle moved. Forgets
  /// all.
  tl::expected<void, std::string> initialize(double height_m);
  bool initialized() const;

  /// While true, the vehicle is known to stand still: zero velocity and rotation are measured from the next
  /// attitude update on.
  void setAtRest(bool at_rest);

  /// Clones the pose at `time` (usually of a scan that becomes the reference). Up to four clones are kept; then the one
  /// that was used longest ago is dropped.
  Insertion addClone(common::Time time);
  /// T_from_to in the level frame of the body at `from`, which must be cloned: heading and planar displacement.
  /// Covariance of (x, y, yaw). Along `unseen_direction`, a unit vector in the frame at `from`, nothing was measured
  /// and nothing is taken in, whatever pose and covariance say there: a guess that comes back with each scan, however
  /// uncertain, would soon be certain.
  Insertion addRelativePose(common::Time from, common::Time to, const common::Pose2& T_from_to,
                            const Eigen::Matrix3d& covariance,
                            const std::optional<Eigen::Vector2d>& unseen_direction = std::nullopt);
  /// Height of the body origin over the take-off floor. `common_variance_m2` is the part of the error that does not
  /// change from one measurement to the next (of the level below); it is not averaged away.
  Insertion addHeight(common::Time time, double height_m, double variance_m2, double common_variance_m2 = 0.0);
  /// Speed of the body origin along z of odom.
  Insertion addVerticalSpeed(common::Time time, double speed_m_s, double variance_m2_s2);
  /// A landmark of known place, or a correction that shall move odom itself. SLAM's corrections stay outside, in
  /// T_map_odom.
  Insertion addAbsolutePose2(common::Time time, const common::Pose2& T_odom_body, const Eigen::Matrix3d& covariance);

  bool hasClone(common::Time time) const;

  /// At the newest IMU sample. T_map_odom is the identity and height_above_ground_m the height over the take-off floor;
  /// who knows better fills them in.
  common::VehicleState state() const;
  common::Time newest() const;
  /// Acceleration in odom, gravity and bias removed, at the newest sample: what MultilevelFilter wants.
  Eigen::Vector3d accelerationOdom_m_s2() const;
  Eigen::Vector3d accelerometerBias_m_s2() const;
  Eigen::Vector3d gyroscopeBias_rad_s() const;
  double drag_1_s() const;
  Eigen::Vector2d wind_odom_m_s() const;
  /// Of the errors (position, velocity, attitude, accelerometer bias, gyroscope bias).
  Eigen::Matrix<double, 15, 15> covariance() const;

  /// Interpolated in the history; up to 20 ms after the newest sample extrapolated. None outside.
  std::optional<common::Pose3> poseAt(common::Time time) const;
  /// Of the body origin along z of odom, with the covariance of both; where poseAt() knows a pose.
  std::optional<VerticalState> verticalAt(common::Time time) const;
  /// The poses that cover [from, to] as far as the history goes; for many questions, as when a scan is deskewed.
  PoseHistory poses(common::Time from, common::Time to) const;

  FusionHealth health() const;
  FusionCounts counts() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::perception
