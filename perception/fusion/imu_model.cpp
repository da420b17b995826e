#include "perception/fusion/imu_model.hpp"

#include <algorithm>

#include "common/square.hpp"

namespace swiftlet::perception::fusion {
namespace {

/// A longer interval between two samples is a gap: the noise densities alone do not cover what happened inside it.
constexpr double kGap_s = 0.05;
/// Change of the specific force and of the angular rate that a gap may hide: a gust or a correction at the limits of an
/// indoor flight (30 % of g, 30 deg/s).
constexpr double kGapAcceleration_m_s2 = 3.0;
constexpr double kGapRotation_rad_s = 0.5;

/// The non-trivial 3x3 blocks of the state transition matrix.
struct Blocks {
  double dt_s;
  Eigen::Matrix3d velocity_attitude;
  Eigen::Matrix3d velocity_accelerometer;  ///< The same block maps gyroscope to attitude: both are -R dt.
  Eigen::Matrix3d velocity_gyroscope;
};

/// x <- F x for the rows of a matrix, block by block.
template <typename Rows>
void applyToRows(const Blocks& f, Rows&& x) {
  auto position = x.template middleRows<3>(kPosition);
  auto velocity = x.template middleRows<3>(kVelocity);
  auto attitude = x.template middleRows<3>(kAttitude);
  const auto accelerometer = x.template middleRows<3>(kAccelerometerBias);
  const auto gyroscope = x.template middleRows<3>(kGyroscopeBias);
  for (Eigen::Index column = 0; column < x.cols(); ++column) {
    const Eigen::Vector3d theta = attitude.col(column), gyro = gyroscope.col(column);
    const Eigen::Vector3d push = f.velocity_attitude * theta + f.velocity_accelerometer * accelerometer.col(column);
    position.col(column) += f.dt_s * (velocity.col(column) + 0.5 * push);
    velocity.col(column) += push + f.velocity_gyroscope * gyro;
    attitude.col(column) += f.velocity_accelerometer * gyro;
  }
  x.row(kAhrsOffset) += f.dt_s * x.row(kAhrsDrift);
}

struct Midpoint {
  double dt_s;
  Eigen::Vector3d angular_velocity_body_rad_s;
  Eigen::Quaterniond rotation_odom_body;
  Eigen::Vector3d force_odom_m_s2;
};

Midpoint midpoint(const FilterState& state, const ImuValue& begin, const ImuValue& end) {
  Midpoint m;
  m.dt_s = (end.stamp - begin.stamp).seconds();
  m.angular_velocity_body_rad_s =
      0.5 * (begin.angular_velocity_body_rad_s + end.angular_velocity_body_rad_s) - state.gyroscope_bias_rad_s;
  m.rotation_odom_body = state.rotation_odom_body * common::expSO3(0.5 * m.dt_s * m.angular_velocity_body_rad_s);
  m.force_odom_m_s2 = m.rotation_odom_body * (0.5 * (begin.specific_force_body_m_s2 + end.specific_force_body_m_s2) -
                                              state.accelerometer_bias_m_s2);
  return m;
}

Blocks blocks(const Midpoint& m) {
  const Eigen::Matrix3d rotation = m.rotation_odom_body.toRotationMatrix();
  const Eigen::Matrix3d force = common::skew(m.force_odom_m_s2);
  return {m.dt_s, -m.dt_s * force, -m.dt_s * rotation, 0.5 * m.dt_s * m.dt_s * force * rotation};
}

void addNoise(FilterState& state, double dt_s, const ImuNoise& noise) {
  using common::square;
  const double gap_s = std::max(0.0, dt_s - kGap_s);
  const double acceleration = square(noise.accelerometer_m_s2_rthz) * dt_s + square(kGapAcceleration_m_s2 * gap_s);
  const double rotation = square(noise.gyroscope_rad_s_rthz) * dt_s + square(kGapRotation_rad_s * gap_s);
  auto diagonal = state.covariance.diagonal();
  diagonal.segment<3>(kPosition).array() += acceleration * dt_s * dt_s / 3.0;
  diagonal.segment<3>(kVelocity).array() += acceleration;
  diagonal.segment<3>(kAttitude).array() += rotation;
  diagonal.segment<3>(kAccelerometerBias).array() += square(noise.accelerometer_walk_m_s3_rthz) * dt_s;
  diagonal.segment<3>(kGyroscopeBias).array() += square(noise.gyroscope_walk_rad_s2_rthz) * dt_s;
  diagonal(kDrag) += square(noise.drag_walk_1_s_rts) * dt_s;
  diagonal.segment<2>(kWind).array() += square(noise.wind_walk_m_s_rts) * dt_s;
  diagonal(kAhrsOffset) += square(noise.ahrs_yaw_walk_rad_rts) * dt_s;
}

}  // namespace

void propagate(FilterState& state, const ImuValue& begin, const ImuValue& end, const ImuNoise& noise) {
  const Midpoint m = midpoint(state, begin, end);
  const Blocks f = blocks(m);
  applyToRows(f, state.covariance);
  // F P is computed above. (F P) F^T = (F (F P)^T)^T and P is symmetric, so F is applied to the rows of the transpose.
  applyToRows(f, state.covariance.transpose());
  applyToRows(f, state.by_laser);
  addNoise(state, m.dt_s, noise);

  const Eigen::Vector3d acceleration = m.force_odom_m_s2 - Eigen::Vector3d(0.0, 0.0, noise.gravity_m_s2);
  state.position_odom_m += m.dt_s * (state.velocity_odom_m_s + 0.5 * m.dt_s * acceleration);
  state.velocity_odom_m_s += m.dt_s * acceleration;
  state.rotation_odom_body =
      (state.rotation_odom_body * common::expSO3(m.dt_s * m.angular_velocity_body_rad_s)).normalized();
  state.ahrs_yaw_off.x() = common::wrapAngle(state.ahrs_yaw_off.x() + m.dt_s * state.ahrs_yaw_off.y());
  state.yaw_rate_odom_rad_s = (m.rotation_odom_body * m.angular_velocity_body_rad_s).z();
  state.stamp = end.stamp;
}

Eigen::Matrix<double, kCore, kCore> transition(const FilterState& state, const ImuValue& begin, const ImuValue& end) {
  Eigen::Matrix<double, kCore, kCore> matrix = Eigen::Matrix<double, kCore, kCore>::Identity();
  applyToRows(blocks(midpoint(state, begin, end)), matrix);
  return matrix;
}

}  // namespace swiftlet::perception::fusion
