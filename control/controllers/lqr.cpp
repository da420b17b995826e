#include "control/controllers/lqr.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "common/gravity.hpp"
#include "control/actuation.hpp"

namespace swiftlet::control {

using common::config::kPositive;
namespace {

/// The weight of an error of that size.
double weight(double size) { return size > 0.0 ? 1.0 / (size * size) : 0.0; }

struct AxisWeights {
  double integral_m_s, position_m, speed_m_s, acceleration_m_s2;
};

/// The gains on x = (integral of e, e, de/dt, acceleration taken up) with e = position less reference, for the input
/// w = k u + b, the commanded acceleration: so neither k nor b is in the gains.
LqrGains gainsOf(const AxisModel& axis, const AxisWeights& weights) {
  const double dt_s = common::kControlPeriod.seconds();
  AxisMatrix A = AxisMatrix::Zero();
  AxisVector B = AxisVector::Zero();
  A(0, 0) = A(1, 1) = 1.0;
  A(0, 1) = A(1, 2) = dt_s;
  A(2, 2) = 1.0 + dt_s * axis.damping_1_s;  // Equation 2.
  if (axis.lag_s > dt_s) {
    const double kept = std::exp(-dt_s / axis.lag_s);
    A(2, 3) = dt_s;
    A(3, 3) = kept;
    B(3) = 1.0 - kept;
  } else {
    B(2) = dt_s;  // Equation 1.
  }
  AxisMatrix Q = AxisMatrix::Zero();
  Q.diagonal() << weight(weights.integral_m_s), weight(weights.position_m), weight(weights.speed_m_s), 0.0;
  const double r = weight(weights.acceleration_m_s2);
  return lqrGains(A, B, Q * dt_s, r * dt_s);
}

struct AllGains {
  LqrGains horizontal, up;
};

AllGains gainsOf(const Lqr::Config& config, const VehicleModel& model) {
  const AxisWeights horizontal{config.horizontal_integral_m_s, config.horizontal_position_m,
                               config.horizontal_speed_m_s, config.acceleration_m_s2};
  const AxisWeights vertical{config.vertical_integral_m_s, config.vertical_position_m, config.vertical_speed_m_s,
                             config.acceleration_m_s2};
  // The heading turns the horizontal axes into each other, so that both are given the mean of the two models.
  AxisModel mean = model.forward;
  mean.damping_1_s = 0.5 * (model.forward.damping_1_s + model.left.damping_1_s);
  mean.lag_s = 0.5 * (model.forward.lag_s + model.left.lag_s);
  return {gainsOf(mean, horizontal), gainsOf(model.up, vertical)};
}

}  // namespace

std::vector<common::Problem> Lqr::problemsOf(const Config& config, const VehicleModel& model) {
  const AllGains gains = gainsOf(config, model);
  std::vector<common::Problem> problems;
  const auto check = [&](const char* axes, const LqrGains& found) {
    if (!found.converged || !found.K.allFinite())
      problems.push_back(
          {{}, axes, common::Message("lqr.no-gains", "the Riccati equation does not converge for these weights"), ""});
  };
  check("forward and left", gains.horizontal);
  check("up", gains.up);
  return problems;
}

Lqr::Lqr(const Config& config, const common::VehicleConfig& vehicle, const VehicleModel& model)
    : vehicle_(vehicle), model_(model), lag_s_(model.forward.lag_s, model.left.lag_s, model.up.lag_s) {
  const AllGains gains = gainsOf(config, model);
  gains_ = {gains.horizontal.K, gains.horizontal.K, gains.up.K};
  // For a single integrator the Riccati equation leaves K = sqrt(q / r).
  yaw_gain_1_s_ = std::sqrt(weight(config.yaw_rad) / weight(config.yaw_rate_rad_s));
}

void Lqr::reset() {
  started_ = false;
  integral_m_s_.setZero();
  taken_up_m_s2_.setZero();
}

Eigen::Vector3d Lqr::wanted(const ControlErrors& errors) const {
  Eigen::Vector3d wanted_m_s2 = errors.acceleration_odom_m_s2;
  for (int axis = 0; axis < 3; ++axis) {
    // u = -K x; the errors are reference less state, so that their gains count positive.
    const AxisVector x(integral_m_s_[axis], errors.position_odom_m[axis], errors.velocity_odom_m_s[axis],
                       -taken_up_m_s2_[axis]);
    wanted_m_s2[axis] += gains_[static_cast<std::size_t>(axis)] * x;
  }
  return wanted_m_s2;
}

/// Equation 1 solved for the commands: u = (acceleration - b) / k. `given_m_s2`: the acceleration within the limits.
common::Setpoint Lqr::command(const Eigen::Vector3d& wanted_m_s2, const ControlInput& input,
                              const ControlErrors& errors, const ThrustModel& thrust,
                              Eigen::Vector3d& given_m_s2) const {
  common::Setpoint setpoint;
  const Eigen::Rotation2Dd odom_level(errors.heading_rad);
  const Eigen::Vector2d level_m_s2 = odom_level.inverse() * Eigen::Vector2d(wanted_m_s2.head<2>());
  Eigen::Vector2d tilt_rad((level_m_s2.x() - model_.forward.offset) / model_.forward.gain,
                           (level_m_s2.y() - model_.left.offset) / model_.left.gain);
  tilt_rad = limited(tilt_rad, greatestTilt_rad(vehicle_, thrust));
  if (input.on_ground) tilt_rad.setZero();
  setpoint.pitch_rad = tilt_rad.x();
  setpoint.roll_rad = tilt_rad.y();
  // The integral's part is not bounded as an acceleration, because it corrects the model.
  const double integral_m_s2 = gains_[2][0] * integral_m_s_.z(), most_m_s2 = kMaxAccelerationUp_m_s2;
  const double most_up_m_s2 = input.on_ground ? std::numeric_limits<double>::infinity() : most_m_s2;
  const double up_m_s2 = integral_m_s2 + std::clamp(wanted_m_s2.z() - integral_m_s2, -most_m_s2, most_up_m_s2);
  setpoint.thrust = thrust.clamped(thrust.hoverCommand() * (up_m_s2 - model_.up.offset) / model_.up.gain);
  setpoint.yaw_rate_rad_s =
      (yawRate_rad_s(input, errors.yaw_rad, yaw_gain_1_s_, kMaxYawRate_deg_s) - model_.yaw.offset) / model_.yaw.gain;
  if (input.on_ground || input.horizontal != Horizontal::kPosition) setpoint.yaw_rate_rad_s = 0.0;
  const Eigen::Vector2d given_level_m_s2(model_.forward.gain * tilt_rad.x() + model_.forward.offset,
                                         model_.left.gain * tilt_rad.y() + model_.left.offset);
  given_m_s2 << odom_level * given_level_m_s2,
      model_.up.gain * setpoint.thrust / thrust.hoverCommand() + model_.up.offset;
  return setpoint;
}

common::Setpoint Lqr::tick(const ControlInput& input, ThrustModel& thrust) {
  if (!started_) setTrim(Eigen::Vector3d::Zero(), thrust);
  const ControlErrors errors = errorsOf(input);
  const Eigen::Vector3d wanted_m_s2 = wanted(errors);
  Eigen::Vector3d given_m_s2;
  const common::Setpoint setpoint = command(wanted_m_s2, input, errors, thrust, given_m_s2);
  advance(errors, wanted_m_s2, given_m_s2, input.dt_s);
  if (!input.on_ground) {
    const double learned_m_s2 = thrust.learn(trim_odom_m_s2(thrust).z(), input.dt_s);
    if (gains_[2][0] > 0.0) integral_m_s_.z() -= learned_m_s2 * model_.up.gain / common::kGravity_m_s2 / gains_[2][0];
  }
  return setpoint;
}

void Lqr::advance(const ControlErrors& errors, const Eigen::Vector3d& wanted_m_s2, const Eigen::Vector3d& given_m_s2,
                  double dt_s) {
  for (int axis = 0; axis < 3; ++axis) {
    // The integral only balances errors of the model, so its part accelerates nothing.
    const double integral_gain = gains_[static_cast<std::size_t>(axis)][0];
    const double balance_m_s2 = errors.acceleration_odom_m_s2[axis] + integral_gain * integral_m_s_[axis];
    const double share = lag_s_[axis] > dt_s ? 1.0 - std::exp(-dt_s / lag_s_[axis]) : 1.0;
    taken_up_m_s2_[axis] += share * (given_m_s2[axis] - balance_m_s2 - taken_up_m_s2_[axis]);
    const double refused_m_s2 = wanted_m_s2[axis] - given_m_s2[axis];
    if (integral_gain <= 0.0 || refused_m_s2 * errors.position_odom_m[axis] > 1e-9) continue;
    // The vertical one also compensates a thrust that is far from that of the identified flight.
    const double most_m_s = (axis == 2 ? common::kGravity_m_s2 : kMaxIntegral_m_s2) / integral_gain;
    integral_m_s_[axis] = std::clamp(integral_m_s_[axis] + dt_s * errors.position_odom_m[axis], -most_m_s, most_m_s);
  }
}

/// The vertical trim counts from the learned hover command, as that of the other controllers: the model's error at a
/// hover, k + b, is a part of it.
Eigen::Vector3d Lqr::trim_odom_m_s2(const ThrustModel&) const {
  Eigen::Vector3d trim_m_s2;
  for (int axis = 0; axis < 3; ++axis)
    trim_m_s2[axis] = gains_[static_cast<std::size_t>(axis)][0] * integral_m_s_[axis];
  trim_m_s2.z() = common::kGravity_m_s2 * ((trim_m_s2.z() - model_.up.offset) / model_.up.gain - 1.0);
  return trim_m_s2;
}

void Lqr::setTrim(const Eigen::Vector3d& trim_odom_m_s2, const ThrustModel&) {
  started_ = true;
  Eigen::Vector3d wanted_m_s2 = trim_odom_m_s2;
  wanted_m_s2.z() = model_.up.gain * (1.0 + trim_odom_m_s2.z() / common::kGravity_m_s2) + model_.up.offset;
  for (int axis = 0; axis < 3; ++axis) {
    const double gain = gains_[static_cast<std::size_t>(axis)][0];
    integral_m_s_[axis] = gain > 0.0 ? wanted_m_s2[axis] / gain : 0.0;
  }
}

void Lqr::Config::describe(common::config::Fields& fields) {
  fields("horizontal_integral_m_s", horizontal_integral_m_s, {0, 100},
         "Horizontal integral of the position error that costs as much as the acceleration; 0: no integral.");
  fields("horizontal_position_m", horizontal_position_m, kPositive,
         "Horizontal position error that costs as much as the acceleration.");
  fields("horizontal_speed_m_s", horizontal_speed_m_s, {0, 100},
         "Horizontal velocity error that costs as much as the acceleration; 0: no weight.");
  fields("vertical_integral_m_s", vertical_integral_m_s, {0, 100},
         "Integral of the height error that costs as much as the acceleration; 0: no integral.");
  fields("vertical_position_m", vertical_position_m, kPositive, "Height error that costs as much as the acceleration.");
  fields("vertical_speed_m_s", vertical_speed_m_s, {0, 100},
         "Climb speed error that costs as much as the acceleration; 0: no weight.");
  fields("acceleration_m_s2", acceleration_m_s2, kPositive, "Acceleration whose cost is one.");
  fields("yaw_rad", yaw_rad, kPositive, "Yaw error that costs as much as the yaw rate.");
  fields("yaw_rate_rad_s", yaw_rate_rad_s, kPositive, "Yaw rate whose cost is one.");
}

}  // namespace swiftlet::control
