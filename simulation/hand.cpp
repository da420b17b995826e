#include "simulation/hand.hpp"

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "simulation/quadrotor.hpp"

namespace swiftlet::simulation {
namespace {

/// The share of a motion at the share `t` of its time, its rate and its acceleration: minimum jerk, as arms move
/// (Flash and Hogan 1985).
struct Reach {
  double share, rate, acceleration;
};
Reach reachAt(double t) {
  return {t * t * t * (10.0 - t * (15.0 - 6.0 * t)), 30.0 * t * t * (1.0 - t) * (1.0 - t),
          60.0 * t * (1.0 - t) * (1.0 - 2.0 * t)};
}

/// A critically damped spring; so stiff that a controller that pulls with 3 m/s^2 and 17 rad/s^2 is off by 3 cm and by
/// 2 degrees.
double springAcceleration(double off, double rate_off, double frequency_rad_s) {
  return frequency_rad_s * (frequency_rad_s * off + 2.0 * rate_off);
}
constexpr double kGrip_rad_s = 10.0;
constexpr double kTurn_rad_s = 22.0;

}  // namespace

void HandConfig::describe(common::config::Fields& fields) {
  fields("time_s", time_s, {0, 1e6}, "Time at which the hand takes the vehicle.");
  fields("lasts_s", lasts_s, {0.1, 100}, "Time after which it lets go.");
  fields("x_m", x_m, {-100, 100}, "How far it carries the vehicle along the world's x.");
  fields("y_m", y_m, {-100, 100}, "How far it carries the vehicle along the world's y.");
  fields("yaw_deg", yaw_deg, {-180, 180}, "How far it turns the vehicle, counterclockwise.");
}

void Hand::lead(common::Time now, Quadrotor& quadrotor) {
  const QuadrotorState& state = quadrotor.state();
  const double time_s = now.seconds() - config_.time_s;
  if (time_s < 0.0 || time_s >= config_.lasts_s || state.standing) return;
  const Eigen::Vector2d position_m = state.T_world_body.position_m.head<2>();
  const double yaw_rad = common::yawOf(state.T_world_body.rotation);
  if (!grip_) grip_ = {position_m, yaw_rad};
  const Reach reach = reachAt(time_s / config_.lasts_s);
  const double rate = reach.rate / config_.lasts_s,
               acceleration = reach.acceleration / config_.lasts_s / config_.lasts_s;
  const Eigen::Vector2d displacement_m(config_.x_m, config_.y_m);
  const double turn_rad = config_.yaw_deg * common::kRadPerDeg;
  const Eigen::Vector2d off_m = grip_->position_world_m + reach.share * displacement_m - position_m;
  const Eigen::Vector2d rate_off_m_s = rate * displacement_m - state.velocity_world_m_s.head<2>();
  Eigen::Vector2d acceleration_world_m_s2;
  for (int axis = 0; axis < 2; ++axis)
    acceleration_world_m_s2[axis] =
        acceleration * displacement_m[axis] + springAcceleration(off_m[axis], rate_off_m_s[axis], kGrip_rad_s);
  const double yaw_acceleration_rad_s2 =
      acceleration * turn_rad + springAcceleration(common::wrapAngle(grip_->yaw_rad + reach.share * turn_rad - yaw_rad),
                                                   rate * turn_rad - state.angular_velocity_body_rad_s.z(),
                                                   kTurn_rad_s);
  quadrotor.lead(acceleration_world_m_s2, yaw_acceleration_rad_s2);
}

}  // namespace swiftlet::simulation
