#include "perception/fusion/measurement_models.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

namespace swiftlet::perception::fusion {
namespace {

template <int K>
using CrossCovariance = Eigen::Matrix<double, Eigen::Dynamic, K, Eigen::ColMajor, kMaxDimension, K>;

template <int K>
CrossCovariance<K> covarianceTimesJacobian(const FilterState& state, const Linearized<K>& measurement) {
  const int n = state.dimension();
  CrossCovariance<K> cross(n, K);
  cross.noalias() = state.covariance.lazyProduct(measurement.jacobian.leftCols(n).transpose());
  return cross;
}

template <int K>
Eigen::Matrix<double, K, K> innovationCovariance(const Linearized<K>& measurement, const CrossCovariance<K>& cross) {
  Eigen::Matrix<double, K, K> innovation = measurement.noise;
  innovation.noalias() += measurement.jacobian.leftCols(cross.rows()).lazyProduct(cross);
  return innovation;
}

/// A direct measurement of one component of the state.
Linearized<1> direct(int component, double residual, double variance) {
  Linearized<1> m;
  m.residual(0) = residual;
  m.jacobian(0, component) = 1.0;
  m.noise(0, 0) = variance;
  return m;
}

}  // namespace

Eigen::RowVector3d yawJacobian(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector3d nose = rotation * Eigen::Vector3d::UnitX();
  const double planar2 = std::max(nose.head<2>().squaredNorm(), 1e-6);
  return {-nose.z() * nose.x() / planar2, -nose.z() * nose.y() / planar2, 1.0};
}

Linearized<3> relativePose(const FilterState& state, int clone, const common::Pose2& T_clone_body,
                           const Eigen::Matrix3d& covariance) {
  const ClonedPose& cloned = state.clones[static_cast<std::size_t>(clone)];
  const common::Pose3& from = cloned.T_odom_body;
  const double yaw = common::yawOf(from.rotation), c = std::cos(yaw), s = std::sin(yaw);
  Eigen::Matrix2d to_level;
  to_level << c, s, -s, c;
  const Eigen::Vector2d moved = to_level * (state.position_odom_m - from.position_m).head<2>();
  const int at = kCore + kCloneSize * clone;

  Linearized<3> m;
  m.residual.head<2>() = T_clone_body.position_m() - moved;
  m.residual(2) = common::wrapAngle(T_clone_body.yaw_rad - (common::yawOf(state.rotation_odom_body) - yaw));
  m.jacobian.block<2, 2>(0, kPosition) = to_level;
  m.jacobian.block<2, 2>(0, at) = -to_level;
  const Eigen::RowVector3d yaw_from = yawJacobian(from.rotation);
  m.jacobian.block<1, 3>(0, at + 3) = moved.y() * yaw_from;
  m.jacobian.block<1, 3>(1, at + 3) = -moved.x() * yaw_from;
  m.jacobian.block<1, 3>(2, at + 3) = -yaw_from;
  m.jacobian.block<1, 3>(2, kAttitude) = yawJacobian(state.rotation_odom_body);
  m.noise = covariance;
  const double turned_rad = common::yawOf(state.rotation_odom_body) - yaw;
  const Eigen::Vector2d left(-moved.y(), moved.x());  // By which a turn of the clone moves the body.
  m.by_laser.block<2, 1>(0, 0) = -left;
  m.by_laser.block<2, 2>(0, 1) = Eigen::Rotation2Dd(turned_rad).toRotationMatrix() - Eigen::Matrix2d::Identity();
  m.by_laser.block<2, 1>(0, 3) =
      to_level * (state.velocity_odom_m_s - cloned.velocity_odom_m_s).head<2>() - cloned.yaw_rate_odom_rad_s * left;
  m.by_laser(2, 3) = state.yaw_rate_odom_rad_s - cloned.yaw_rate_odom_rad_s;
  return m;
}

Linearized<2> relativePoseAcross(const FilterState& state, int clone, const common::Pose2& T_clone_body,
                                 const Eigen::Matrix3d& covariance,
                                 const common::UnobservableMotion& unobservable_clone) {
  const Linearized<3> whole = relativePose(state, clone, T_clone_body, covariance);
  const Eigen::Matrix<double, 2, 3> seen = common::rowsAcross(unobservable_clone);
  Linearized<2> m;
  m.residual = seen * whole.residual;
  m.jacobian = seen * whole.jacobian;
  m.noise = seen * whole.noise * seen.transpose();
  m.by_laser = seen * whole.by_laser;
  return m;
}

Linearized<6> relativePose3(const FilterState& state, int clone, const common::Pose3& T_clone_body,
                            const Eigen::Matrix<double, 6, 6>& covariance) {
  const common::Pose3& from = state.clones[static_cast<std::size_t>(clone)].T_odom_body;
  const Eigen::Matrix3d to_body = state.rotation_odom_body.conjugate().toRotationMatrix();
  const Eigen::Vector3d moved_odom_m = state.position_odom_m - from.position_m;
  const int at = kCore + kCloneSize * clone;

  Linearized<6> m;
  m.residual.head<3>() = to_body * (from.rotation * T_clone_body.position_m - moved_odom_m);
  m.residual.tail<3>() = common::logSO3(state.rotation_odom_body.conjugate() * (from.rotation * T_clone_body.rotation));
  m.jacobian.block<3, 3>(0, kPosition) = to_body;
  m.jacobian.block<3, 3>(0, at) = -to_body;
  m.jacobian.block<3, 3>(0, at + 3) = to_body * common::skew(moved_odom_m);
  m.jacobian.block<3, 3>(3, kAttitude) = to_body;
  m.jacobian.block<3, 3>(3, at + 3) = -to_body;
  m.noise = covariance;
  return m;
}

Linearized<1> height(const FilterState& state, double height_m, double variance_m2) {
  return direct(kPosition + 2, height_m - state.position_odom_m.z(), variance_m2);
}

bool replaceVertical(FilterState& state, const Eigen::Vector3d& vertical, const Eigen::Matrix3d& covariance) {
  constexpr int kVertical[] = {kPosition + 2, kVelocity + 2, kAccelerometerBias + 2};
  const int n = state.dimension();
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxDimension, 3> cross(n, 3);
  Eigen::Matrix<double, 3, kLaserSize> by_laser;
  Eigen::Matrix3d present;
  for (int i = 0; i < 3; ++i) {
    cross.col(i) = state.covariance.col(kVertical[i]);
    by_laser.row(i) = state.by_laser.row(kVertical[i]);
    for (int k = 0; k < 3; ++k) present(k, i) = state.covariance(kVertical[k], kVertical[i]);
  }
  const Eigen::LLT<Eigen::Matrix3d> factor(present);
  if (factor.info() != Eigen::Success) return false;
  // The regression of all errors on the three; its rows of the three themselves are the identity.
  CrossCovariance<3> slope(n, 3);
  slope = factor.solve(cross.transpose()).transpose();
  const Eigen::Vector3d error(vertical.x() - state.position_odom_m.z(), vertical.y() - state.velocity_odom_m_s.z(),
                              vertical.z() - state.accelerometer_bias_m_s2.z());
  ErrorVector all(n);
  all.noalias() = slope.lazyProduct(error);
  const CrossCovariance<3> less = slope.lazyProduct((present - covariance).eval());
  state.covariance.noalias() -= less.lazyProduct(slope.transpose());
  state.by_laser.noalias() -= slope.lazyProduct(by_laser);
  state.inject(all);
  return true;
}

Linearized<3> absolutePose(const FilterState& state, const common::Pose2& T_odom_body,
                           const Eigen::Matrix3d& covariance) {
  Linearized<3> m;
  m.residual.head<2>() = T_odom_body.position_m() - state.position_odom_m.head<2>();
  m.residual(2) = common::wrapAngle(T_odom_body.yaw_rad - common::yawOf(state.rotation_odom_body));
  m.jacobian.block<2, 2>(0, kPosition).setIdentity();
  m.jacobian.block<1, 3>(2, kAttitude) = yawJacobian(state.rotation_odom_body);
  m.noise = covariance;
  return m;
}

Linearized<2> upDirection(const FilterState& state, const Eigen::Vector3d& up_body, double variance_rad2) {
  Linearized<2> m;
  // R_estimated * up_body = e_z + e_z x error + noise.
  m.residual = (state.rotation_odom_body * up_body).head<2>();
  m.jacobian(0, kAttitude + 1) = -1.0;
  m.jacobian(1, kAttitude) = 1.0;
  m.noise *= variance_rad2;
  return m;
}

Linearized<1> ahrsYaw(const FilterState& state, double yaw_rad, double variance_rad2) {
  const double expected_rad = common::yawOf(state.rotation_odom_body) + state.ahrs_yaw_off.x();
  Linearized<1> m = direct(kAhrsOffset, common::wrapAngle(yaw_rad - expected_rad), variance_rad2);
  m.jacobian.block<1, 3>(0, kAttitude) = yawJacobian(state.rotation_odom_body);
  return m;
}

Linearized<3> gravity(const FilterState& state, const Eigen::Vector3d& specific_force_body_m_s2, double gravity_m_s2,
                      double variance_m2_s4) {
  const Eigen::Matrix3d to_body = state.rotation_odom_body.conjugate().toRotationMatrix();
  Linearized<3> m;
  m.residual = specific_force_body_m_s2 - gravity_m_s2 * to_body.col(2) - state.accelerometer_bias_m_s2;
  m.jacobian.block<3, 1>(0, kAttitude) = gravity_m_s2 * to_body.col(1);
  m.jacobian.block<3, 1>(0, kAttitude + 1) = -gravity_m_s2 * to_body.col(0);
  m.jacobian.block<3, 3>(0, kAccelerometerBias).setIdentity();
  m.noise *= variance_m2_s4;
  return m;
}

Linearized<3> zeroVelocity(const FilterState& state, double variance_m2_s2) {
  Linearized<3> m;
  m.residual = -state.velocity_odom_m_s;
  m.jacobian.block<3, 3>(0, kVelocity).setIdentity();
  m.noise *= variance_m2_s2;
  return m;
}

Linearized<3> zeroRotation(const FilterState& state, const Eigen::Vector3d& angular_velocity_body_rad_s,
                           double variance_rad2_s2) {
  Linearized<3> m;
  m.residual = angular_velocity_body_rad_s - state.gyroscope_bias_rad_s;
  m.jacobian.block<3, 3>(0, kGyroscopeBias).setIdentity();
  m.noise *= variance_rad2_s2;
  return m;
}

Linearized<2> drag(const FilterState& state, double variance_m2_s4) {
  const DragStretch& stretch = state.drag_stretch;
  const Eigen::Matrix<double, 2, 3> to_body_xy = state.rotation_odom_body.conjugate().toRotationMatrix().topRows<2>();
  const Eigen::Vector3d wind_odom_m_s(state.wind_odom_m_s.x(), state.wind_odom_m_s.y(), 0.0);
  const Eigen::Vector2d airspeed_m_s = stretch.velocity_sum_m / stretch.seconds - to_body_xy * wind_odom_m_s;
  const Eigen::Vector3d airspeed_odom_m_s = state.velocity_odom_m_s - wind_odom_m_s;

  Linearized<2> m;
  m.residual =
      stretch.force_sum_m_s / stretch.seconds + state.drag_1_s * airspeed_m_s - state.accelerometer_bias_m_s2.head<2>();
  m.jacobian.block<2, 3>(0, kVelocity) = -state.drag_1_s * to_body_xy;
  // R^T (I - [error x]) v = R^T v + R^T [v x] error.
  m.jacobian.block<2, 3>(0, kAttitude) = -state.drag_1_s * to_body_xy * common::skew(airspeed_odom_m_s);
  m.jacobian.block<2, 2>(0, kAccelerometerBias).setIdentity();
  m.jacobian.block<2, 1>(0, kDrag) = -airspeed_m_s;
  m.jacobian.block<2, 2>(0, kWind) = state.drag_1_s * to_body_xy.leftCols<2>();
  m.noise *= variance_m2_s4;
  return m;
}

template <int K>
double mahalanobis2(const FilterState& state, const Linearized<K>& measurement) {
  const auto innovation = innovationCovariance<K>(measurement, covarianceTimesJacobian<K>(state, measurement));
  const Eigen::LLT<Eigen::Matrix<double, K, K>> factor(innovation);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return measurement.residual.dot(factor.solve(measurement.residual));
}

template <int K>
bool update(FilterState& state, const Linearized<K>& measurement) {
  const CrossCovariance<K> cross = covarianceTimesJacobian<K>(state, measurement);
  const Eigen::LLT<Eigen::Matrix<double, K, K>> factor(innovationCovariance<K>(measurement, cross));
  if (factor.info() != Eigen::Success) return false;
  // P - P H^T S^-1 H P = P - W W^T with W = P H^T L^-T: symmetric by construction.
  CrossCovariance<K> whitened = cross;
  factor.matrixL().transpose().template solveInPlace<Eigen::OnTheRight>(whitened);
  const Eigen::Matrix<double, K, 1> residual = factor.matrixL().solve(measurement.residual);
  ErrorVector error(state.dimension());
  error.noalias() = whitened.lazyProduct(residual);
  state.covariance.noalias() -= whitened.lazyProduct(whitened.transpose());
  const int n = state.dimension();
  Eigen::Matrix<double, K, kLaserSize> seen_by_laser = measurement.by_laser;
  seen_by_laser.noalias() += measurement.jacobian.leftCols(n).lazyProduct(state.by_laser);
  factor.matrixL().solveInPlace(seen_by_laser);
  state.by_laser.noalias() -= whitened.lazyProduct(seen_by_laser);
  state.inject(error);
  return true;
}

template double mahalanobis2<1>(const FilterState&, const Linearized<1>&);
template double mahalanobis2<2>(const FilterState&, const Linearized<2>&);
template double mahalanobis2<3>(const FilterState&, const Linearized<3>&);
template double mahalanobis2<6>(const FilterState&, const Linearized<6>&);
template bool update<1>(FilterState&, const Linearized<1>&);
template bool update<2>(FilterState&, const Linearized<2>&);
template bool update<3>(FilterState&, const Linearized<3>&);
template bool update<6>(FilterState&, const Linearized<6>&);

}  // namespace swiftlet::perception::fusion
