// The measurement models of the fusion filter, linearized: residual = measured - predicted = H * error + noise, and the
// errors of the laser that are only considered.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/unobservable_motion.hpp"
#include "perception/fusion/filter_state.hpp"

namespace swiftlet::perception::fusion {

/// A measurement with K rows. Columns of H beyond the state's dimension are not read.
template <int K>
struct Linearized {
  Eigen::Matrix<double, K, 1> residual = Eigen::Matrix<double, K, 1>::Zero();
  Eigen::Matrix<double, K, kMaxDimension> jacobian = Eigen::Matrix<double, K, kMaxDimension>::Zero();
  Eigen::Matrix<double, K, K> noise = Eigen::Matrix<double, K, K>::Identity();
  Eigen::Matrix<double, K, kLaserSize> by_laser = Eigen::Matrix<double, K, kLaserSize>::Zero();
};

/// Planar pose of the body in the level frame of the body at a clone, by a laser whose mount may differ from the data
/// sheet: it measures E^-1 T E of a motion T, E being the error of its mount, at a time that its clock is off.
Linearized<3> relativePose(const FilterState& state, int clone, const common::Pose2& T_clone_body,
                           const Eigen::Matrix3d& covariance);
/// Relative pose where the scene does not show one motion (axes of the level frame at the clone). Measures what of the
/// pose is across it, in metres (common::rowsAcross); along it nothing is measured.
Linearized<2> relativePoseAcross(const FilterState& state, int clone, const common::Pose2& T_clone_body,
                                 const Eigen::Matrix3d& covariance,
                                 const common::UnobservableMotion& unobservable_clone);
/// Pose of the body relative to that at a clone. Residual and noise are errors (position, rotation vector) with the
/// axes of the body now: T_clone_body * exp(error).
Linearized<6> relativePose3(const FilterState& state, int clone, const common::Pose3& T_clone_body,
                            const Eigen::Matrix<double, 6, 6>& covariance);
Linearized<1> height(const FilterState& state, double height_m, double variance_m2);
Linearized<3> absolutePose(const FilterState& state, const common::Pose2& T_odom_body,
                           const Eigen::Matrix3d& covariance);
/// Roll and pitch from the direction of "up" in the body frame; yaw is not measured.
Linearized<2> upDirection(const FilterState& state, const Eigen::Vector3d& up_body, double variance_rad2);
/// The yaw of the AHRS, which has an offset of its own (FilterState::ahrs_yaw_off).
Linearized<1> ahrsYaw(const FilterState& state, double yaw_rad, double variance_rad2);
/// The specific force, assumed to be due to gravity alone.
Linearized<3> gravity(const FilterState& state, const Eigen::Vector3d& specific_force_body_m_s2, double gravity_m_s2,
                      double variance_m2_s4);
Linearized<3> zeroVelocity(const FilterState& state, double variance_m2_s2);
Linearized<3> zeroRotation(const FilterState& state, const Eigen::Vector3d& angular_velocity_body_rad_s,
                           double variance_rad2_s2);

/// Along the body's x and y axes an accelerometer measures only the drag of rotors and frame, at any tilt: thrust is
/// along z, and gravity is not measured (Martin and Salaun 2010; Leishman et al. 2014). Uses the means over the state's
/// drag_stretch, which must not be empty.
Linearized<2> drag(const FilterState& state, double variance_m2_s4);

/// Gives height, vertical speed and vertical accelerometer bias this mean and covariance. What the rest of the state
/// says given these three stays as it is (Jeffrey's rule, for Gaussians). Returns false and changes nothing if the
/// present covariance of the three is not positive definite.
bool replaceVertical(FilterState& state, const Eigen::Vector3d& vertical, const Eigen::Matrix3d& covariance);

/// Derivative of the yaw by the attitude error (in odom).
Eigen::RowVector3d yawJacobian(const Eigen::Quaterniond& rotation);

/// Squared Mahalanobis distance of the residual.
template <int K>
double mahalanobis2(const FilterState& state, const Linearized<K>& measurement);
/// The Kalman update, with the gain of a laser that is known exactly. What its errors do to the estimate is followed
/// (consider covariance analysis: Tapley, Schutz and Born 2004, section 6.2). Returns false and changes nothing if the
/// innovation covariance is not positive definite.
template <int K>
bool update(FilterState& state, const Linearized<K>& measurement);

}  // namespace swiftlet::perception::fusion
