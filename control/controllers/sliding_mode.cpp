#include "control/controllers/sliding_mode.hpp"

#include <algorithm>

#include "common/config_fields.hpp"
#include "common/first_order_lag.hpp"
#include "control/actuation.hpp"

namespace swiftlet::control {

using common::config::kPositive;
namespace {

constexpr double kMaxDisturbance_m_s2 = 2.0;  ///< Greatest disturbance that is compensated.
/// Time constant of the reference's filter: that of a small quadrotor's attitude behind its command, 1/7 s and 1/18 s
/// of the two loops of its autopilot and the lag of its motors. It is not SlidingMode::Config::attitude_lag_s, which
/// belongs to the estimate of the disturbance and was tuned in a hover, where no reference moves.
constexpr double kReferenceLag_s = 0.2;

}  // namespace

void SlidingMode::reset() {
  smoothed_.reset();
  integral_m_s_.reset();
  disturbance_m_s2_.setZero();
  taken_up_m_s2_.setZero();
}

common::Setpoint SlidingMode::tick(const ControlInput& input, ThrustModel& thrust) {
  const ControlErrors errors = smoothedErrors(input);
  const Eigen::Vector3d p(config_.horizontal_p_1_s2, config_.horizontal_p_1_s2, config_.vertical_p_1_s2);
  const Eigen::Vector3d d(config_.horizontal_d_1_s, config_.horizontal_d_1_s, config_.vertical_d_1_s);

  // The nominal control of a double integrator, u0 = Kp e + Kd de/dt, and the surface on which the vehicle behaves as
  // if there were no disturbance: sigma = de/dt - de/dt(0) + int(u0) dt (Utkin and Shi 1996).
  const Eigen::Vector3d nominal_m_s2 =
      p.cwiseProduct(errors.position_odom_m) + d.cwiseProduct(errors.velocity_odom_m_s);
  if (!integral_m_s_) integral_m_s_ = -errors.velocity_odom_m_s;
  // u = a* + u0 + rho sat(sigma / boundary) - d, with d by time-delay estimation.
  const Eigen::Vector3d wanted_m_s2 = errors.acceleration_odom_m_s2 + slide(nominal_m_s2, errors) - disturbance_m_s2_;

  Actuation actuation =
      actuate(wanted_m_s2, errors.heading_rad, kMaxAccelerationUp_m_s2, input.on_ground, vehicle_, thrust);
  actuation.setpoint.yaw_rate_rad_s = yawRate_rad_s(input, errors.yaw_rad, config_.yaw_p_1_s, kMaxYawRate_deg_s);
  advanceSurface(nominal_m_s2, wanted_m_s2 - actuation.given_odom_m_s2, errors, input.dt_s);
  estimateDisturbance(input, actuation.given_odom_m_s2);
  // A thrust that has been learned is no longer a disturbance.
  if (!input.on_ground) disturbance_m_s2_.z() += thrust.learn(trim_odom_m_s2(thrust).z(), input.dt_s);
  return actuation.setpoint;
}

/// From the reference through the vehicle's translational dynamics, as in the paper.
ControlErrors SlidingMode::smoothedErrors(const ControlInput& input) {
  if (input.horizontal != Horizontal::kPosition) {
    smoothed_.reset();
    return errorsOf(input);
  }
  ControlInput smooth = input;
  smooth.reference = smoothed_.advance(input.reference, kReferenceLag_s, input.dt_s);
  return errorsOf(smooth);
}

Eigen::Vector3d SlidingMode::slide(const Eigen::Vector3d& nominal_m_s2, const ControlErrors& errors) const {
  const Eigen::Vector3d sigma_m_s = errors.velocity_odom_m_s + *integral_m_s_;
  return nominal_m_s2 + config_.switching_m_s2 * (sigma_m_s / config_.boundary_m_s).cwiseMax(-1.0).cwiseMin(1.0);
}

/// Within the boundary the switching term is an integral action; beyond it, or while the vehicle gives less than is
/// wanted, the surface would only wind up.
void SlidingMode::advanceSurface(const Eigen::Vector3d& nominal_m_s2, const Eigen::Vector3d& refused_m_s2,
                                 const ControlErrors& errors, double dt_s) {
  for (int axis = 0; axis < 3; ++axis) {
    if (refused_m_s2[axis] * nominal_m_s2[axis] > 1e-9) continue;
    const double sigma_m_s = errors.velocity_odom_m_s[axis] + (*integral_m_s_)[axis] + dt_s * nominal_m_s2[axis];
    (*integral_m_s_)[axis] =
        std::clamp(sigma_m_s, -config_.boundary_m_s, config_.boundary_m_s) - errors.velocity_odom_m_s[axis];
  }
}

/// Time-delay estimation: what the accelerometer measures less what the previous commands explain, both behind the same
/// filter. The accelerometer shares the horizon of the attitude, so that a wrong horizon is left to the integral.
void SlidingMode::estimateDisturbance(const ControlInput& input, const Eigen::Vector3d& given_m_s2) {
  const Eigen::Vector3d lag_s(config_.attitude_lag_s, config_.attitude_lag_s, config_.thrust_lag_s);
  for (int axis = 0; axis < 3; ++axis)
    taken_up_m_s2_[axis] += common::followedShare(input.dt_s, lag_s[axis]) * (given_m_s2[axis] - taken_up_m_s2_[axis]);
  if (input.on_ground || !input.acceleration_odom_m_s2 || !input.acceleration_odom_m_s2->allFinite()) return;
  const double share = common::followedShare(input.dt_s, config_.disturbance_filter_s);
  const Eigen::Vector3d seen_m_s2 = *input.acceleration_odom_m_s2 - taken_up_m_s2_;
  disturbance_m_s2_ += share * (seen_m_s2 - disturbance_m_s2_);
  disturbance_m_s2_ = disturbance_m_s2_.cwiseMax(-kMaxDisturbance_m_s2).cwiseMin(kMaxDisturbance_m_s2);
}

/// The part of sigma beyond the velocity error.
Eigen::Vector3d SlidingMode::trim_odom_m_s2(const ThrustModel&) const {
  const double rate_1_s = config_.switching_m_s2 / config_.boundary_m_s;
  return integral_m_s_ ? Eigen::Vector3d(rate_1_s * *integral_m_s_ - disturbance_m_s2_) : -disturbance_m_s2_;
}

void SlidingMode::setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel&) {
  reset();
  disturbance_m_s2_ = -trim_odom_m_s2;
  // The vehicle follows that acceleration already: the estimate would take it for one that the commands do not explain.
  taken_up_m_s2_ = trim_odom_m_s2;
}

void SlidingMode::Config::describe(common::config::Fields& fields) {
  fields("horizontal_p_1_s2", horizontal_p_1_s2, {0, 40}, "Horizontal acceleration per position error.");
  fields("horizontal_d_1_s", horizontal_d_1_s, {0, 20}, "Horizontal acceleration per velocity error.");
  fields("vertical_p_1_s2", vertical_p_1_s2, {0, 40}, "Vertical acceleration per height error.");
  fields("vertical_d_1_s", vertical_d_1_s, {0, 20}, "Vertical acceleration per climb speed error.");
  fields("switching_m_s2", switching_m_s2, {0, 9},
         "Greatest acceleration that brings the vehicle to the sliding surface.");
  fields("boundary_m_s", boundary_m_s, kPositive,
         "Distance from the sliding surface within which the switching acceleration is in proportion to the distance, "
         "against chattering.");
  fields("disturbance_filter_s", disturbance_filter_s, {0.02, 100}, "Time constant of the estimated disturbance.");
  fields("attitude_lag_s", attitude_lag_s, {0.01, 0.5},
         "Time the attitude takes to follow a command, for the estimated disturbance.");
  fields("thrust_lag_s", thrust_lag_s, {0.01, 0.5}, "Time the thrust takes to follow a command.");
  fields("yaw_p_1_s", yaw_p_1_s, {0, 10}, "Yaw rate per yaw error.");
}

}  // namespace swiftlet::control
