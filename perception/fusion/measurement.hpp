// A measurement for the fusion filter, as a value.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "common/unobservable_motion.hpp"
#include "perception/fusion/fusion_types.hpp"

namespace swiftlet::perception {

/// At equal times, measurements are applied in the order of their kinds: a pose is cloned after all measurements of it.
enum class MeasurementKind : std::uint8_t { kHeight, kVertical, kRelativePose, kRelativePose3, kAbsolutePose, kClone };

struct Measurement {
  common::Time stamp;
  MeasurementKind kind = MeasurementKind::kClone;
  OdometrySource source = OdometrySource::kLaser;  ///< kClone: whose reference it is.
  common::Time from;                               ///< Of a relative pose: time of the cloned reference.
  common::Pose2 pose;                              ///< kRelativePose, kAbsolutePose.
  /// kRelativePose: change of the pose, along the axes of the level frame at `from`.
  std::optional<common::UnobservableMotion> unobservable_motion;
  double value = 0;                                                               ///< kHeight: m.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();                           ///< kHeight: only (0, 0).
  Eigen::Vector3d vertical = Eigen::Vector3d::Zero();                             ///< kVertical: m, m/s, m/s^2.
  common::Pose3 pose3;                                                            ///< kRelativePose3.
  Eigen::Matrix<double, 6, 6> covariance6 = Eigen::Matrix<double, 6, 6>::Zero();  ///< kRelativePose3.
};

/// Clones the pose at `time`, usually that of a scan or picture that becomes a reference of that sensor. One clone is
/// kept for the laser and three for the camera, more while the other needs less: a new one replaces the oldest of its
/// own sensor, so that a sensor that is not used keeps its reference.
Measurement poseClone(common::Time time, OdometrySource source = OdometrySource::kLaser);
/// T_from_to in the level frame of the body at `from`, which must be cloned, with the covariance of (x, y, yaw). Along
/// `unobservable_motion`, with the axes of the frame at `from`, nothing was measured and nothing is used, whatever the
/// pose and covariance say. Otherwise a guess repeated with each scan, however uncertain, would soon count as
/// certain.
Measurement measuredRelativePose(common::Time from, common::Time to, const common::Pose2& T_from_to,
                                 const Eigen::Matrix3d& covariance,
                                 const std::optional<common::UnobservableMotion>& unobservable_motion = std::nullopt);
/// T_from_to of the body in space, whose pose at `from` must be cloned, with the covariance of its error (position,
/// rotation vector) in the axes of the body at `to`. A direction in which nothing was measured has a large variance.
Measurement measuredRelativePose3(common::Time from, common::Time to, const common::Pose3& T_from_to,
                                  const Eigen::Matrix<double, 6, 6>& covariance);
/// Height of the body origin above the take-off floor.
Measurement measuredHeight(common::Time time, double height_m, double variance_m2);
/// The height, vertical speed and accelerometer bias of an estimator that has used the same inertial samples: what the
/// filter knows of the three is replaced, and what is correlated with them follows.
Measurement knownVertical(common::Time time, const VerticalState& state);
/// A pose in odom, such as one from a landmark at a known place. It moves the estimate in odom. SLAM's corrections do
/// not belong here; they are in T_map_odom.
Measurement measuredAbsolutePose(common::Time time, const common::Pose2& T_odom_body,
                                 const Eigen::Matrix3d& covariance);

/// Whether it is finite, its covariance is positive definite, and its time is after that of its reference.
bool isValid(const Measurement& measurement);

}  // namespace swiftlet::perception
