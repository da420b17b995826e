#include "control/emergency_descent.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"

namespace swiftlet::control {

using common::config::kPositive;
namespace {

constexpr double kStill_m_s = 0.10;
constexpr double kMaxAcceleration_m_s2 = 2.0;
constexpr double kMaxIntegral_m_s2 = 2.0;

}  // namespace

void AlphaBetaFilter::reset() {
  samples_ = 0;
  velocity_m_s_ = 0.0;
}

void AlphaBetaFilter::update(const RawHeight& raw) {
  if (!std::isfinite(raw.height_m) || raw.height_m < 0.0) return;
  const double dt_s = (raw.stamp - stamp_).seconds();
  if (samples_ > 0 && dt_s <= 0.0) return;
  constexpr double kForgotten_s = 1.0;
  if (samples_ == 0 || dt_s > kForgotten_s) {
    stamp_ = raw.stamp;
    height_m_ = raw.height_m;
    velocity_m_s_ = 0.0;
    samples_ = 1;
    return;
  }
  const double predicted_m = height_m_ + velocity_m_s_ * dt_s;
  const double residual_m = raw.height_m - predicted_m;
  if (std::abs(residual_m) > jump_m_) {
    height_m_ = raw.height_m;
  } else {
    height_m_ = predicted_m + alpha_ * residual_m;
    velocity_m_s_ += beta_ / dt_s * residual_m;
  }
  stamp_ = raw.stamp;
  ++samples_;
}

EmergencyDescent::EmergencyDescent(const Config& config)
    : config_(config), filter_(config.alpha, config.beta, config.jump_m) {}

void EmergencyDescent::start(common::Time now, double standing_height_m, const Eigen::Vector2d& velocity_level_m_s) {
  velocity_left_m_s_ = velocity_level_m_s.allFinite() ? velocity_level_m_s : Eigen::Vector2d::Zero();
  last_seen_ = last_moving_ = now;
  standing_height_m_ = standing_height_m;
  integral_m_s2_ = 0.0;
  touched_down_ = false;
}

common::Setpoint EmergencyDescent::tick(common::Time now, double dt_s, const ThrustModel& thrust) {
  common::Setpoint setpoint;
  setpoint.stamp = now;
  setpoint.motors_on = !touched_down_;
  if (touched_down_) return setpoint;

  const Eigen::Vector2d braking_m_s2 = -config_.brake_1_s * velocity_left_m_s_;
  const Eigen::Vector2d given_m_s2 = braking_m_s2 / std::max(1.0, braking_m_s2.norm() / kMaxAcceleration_m_s2);
  velocity_left_m_s_ += given_m_s2 * dt_s;
  setpoint.pitch_rad = std::atan2(given_m_s2.x(), kGravity_m_s2);
  setpoint.roll_rad = std::atan2(-given_m_s2.y(), kGravity_m_s2);
  setpoint.thrust = verticalThrust(now, dt_s, thrust);
  return setpoint;
}

double EmergencyDescent::verticalThrust(common::Time now, double dt_s, const ThrustModel& thrust) {
  const bool sees = filter_.ready() && (now - filter_.stamp()).seconds() <= config_.blind_after_s;
  if (!sees) {
    touched_down_ = (now - last_seen_).seconds() > config_.blind_rest_s;
    return config_.blind_thrust * thrust.hoverCommand();
  }
  last_seen_ = now;
  const bool low = filter_.height_m() < standing_height_m_ + config_.touchdown_height_m;
  const double wanted_m_s = low ? -config_.touchdown_descent_m_s : -config_.descent_m_s;
  const double error_m_s = wanted_m_s - filter_.velocity_m_s();
  integral_m_s2_ =
      std::clamp(integral_m_s2_ + config_.integral_1_s2 * error_m_s * dt_s, -kMaxIntegral_m_s2, kMaxIntegral_m_s2);
  const double acceleration_m_s2 =
      std::clamp(config_.gain_1_s * error_m_s + integral_m_s2_, -kMaxAcceleration_m_s2, kMaxAcceleration_m_s2);
  const bool may_stand =
      filter_.height_m() < standing_height_m_ + config_.rest_margin_m && std::abs(filter_.velocity_m_s()) < kStill_m_s;
  if (!may_stand) last_moving_ = now;
  touched_down_ = (now - last_moving_).seconds() >= config_.rest_s;
  return thrust.commandFor(acceleration_m_s2, 1.0);
}

void EmergencyDescent::Config::describe(common::config::Fields& fields) {
  fields("descent_m_s", descent_m_s, {0.05, 2}, "Speed of descent.");
  fields("touchdown_descent_m_s", touchdown_descent_m_s, {0.05, 2}, "Speed of descent near the ground.");
  fields("touchdown_height_m", touchdown_height_m, {0, 5},
         "Height above where it stood at which the ground counts as near.");
  fields("gain_1_s", gain_1_s, {0, 20}, "Vertical acceleration per error of the vertical speed.");
  fields("integral_1_s2", integral_1_s2, {0, 20}, "Vertical acceleration per integrated error of the vertical speed.");
  fields("alpha", alpha, {0.01, 1}, "Share of the residual that corrects the height (alpha-beta filter, Tomic 2012).");
  fields("beta", beta, {0.001, 1},
         "Share of the residual that corrects the vertical speed (alpha-beta filter, Tomic 2012).");
  fields("jump_m", jump_m, kPositive, "A residual larger than this is a step of the ground.");
  fields("blind_after_s", blind_after_s, kPositive,
         "Without a raw height for this long the vehicle sinks by thrust alone.");
  fields("blind_thrust", blind_thrust, {0.5, 1},
         "Thrust of sinking without a height, as a share of the hover command.");
  fields("rest_margin_m", rest_margin_m, {0, 1}, "Less than this above where it stood the vehicle may be standing.");
  fields("rest_s", rest_s, kPositive, "Low and still for this long the vehicle is on the ground.");
  fields("blind_rest_s", blind_rest_s, kPositive, "After sinking without a height for this long the motors stop.");
  fields("brake_1_s", brake_1_s, {0, 10}, "Deceleration per last known velocity when no horizontal estimate is left.");
}

}  // namespace swiftlet::control
