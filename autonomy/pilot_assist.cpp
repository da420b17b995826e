#include "autonomy/pilot_assist.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/gravity.hpp"
#include "control/usable_state.hpp"

namespace swiftlet::autonomy {
namespace {

/// Grzonka 2009, V-F: programs perturb the commands of the user by 20 %.
constexpr double kProgramShare = 0.20;
/// Acceleration with which the pilot's velocity is followed.
constexpr double kAcceleration_m_s2 = 1.0;
/// As PilotAssist::kDeadBand, of the thrust's stick: where it hovers differs with vehicle and battery.
constexpr double kClimbDeadBand = 0.2;
/// Where the stick of the thrust is taken to hover until the pilot takes over.
constexpr double kHoverStick = 0.5;
/// The attitude of an autopilot is good to about a degree (common/sensor_event.hpp), which tilts the program's share.
constexpr double kHorizonError_rad = 1.0 * common::kRadPerDeg;
/// From a requested speed to the flown speed.
constexpr double kLag_s = 0.4;
/// Kept from what is near, ahead and aside: gusts move a vehicle that stands by some 5 cm, and the pilot may leave it
/// there for long. A door of 0.8 m leaves a hull of 0.55 m this much on either side.
constexpr double kSpare_m = 0.12;
/// From a missing distance to the speed away.
constexpr double kAway_1_s = 1.0;
/// The reference that is farther away was left by the pilot's sticks, not by the wind.
constexpr double kLeft_m = 0.35;
/// The requested yaw leads the present one by this time while its stick is moved.
constexpr double kYawAhead_s = 0.25;

/// Without the dead band, so that it starts at zero.
double wish(double stick, double dead_band) {
  return std::copysign(std::max(0.0, std::abs(stick) - dead_band) / (1.0 - dead_band), stick);
}

}  // namespace

void PilotAssistConfig::describe(common::config::Fields& fields) {
  fields("enabled", enabled,
         "Whether a pilot who takes over is assisted; the remote control must mix the setpoints into the sticks.");
  fields("speed_m_s", speed_m_s, {0.1, 10}, "Horizontal speed that a stick at its end wishes.");
  fields("climb_m_s", climb_m_s, {0.05, 5}, "Climb that the stick of the thrust at its end wishes.");
  fields("yaw_rate_deg_s", yaw_rate_deg_s, {1, 360}, "Yaw rate that the stick of the yaw at its end wishes.");
}

PilotAssist::PilotAssist(const PilotAssistConfig& config, double max_tilt_deg,
                         const planning::AvoidanceConfig& avoidance)
    : config_(config),
      max_tilt_rad_(max_tilt_deg * common::kRadPerDeg),
      hover_stick_(kHoverStick),
      deceleration_m_s2_(avoidance.deceleration_m_s2),
      lag_s_(avoidance.lag_s),
      unlimited_m_s_(avoidance.max_speed_m_s) {}

void PilotAssist::pilotArrived(const common::PilotSample& sample) {
  const bool begins = sample.takes_over && !sticks_.takes_over;
  const auto finite = [](double stick) { return std::isfinite(stick) ? std::clamp(stick, -1.0, 1.0) : 0.0; };
  sticks_ = sample;
  sticks_.roll = finite(sample.roll);
  sticks_.pitch = finite(sample.pitch);
  sticks_.yaw_rate = finite(sample.yaw_rate);
  sticks_.thrust = std::isfinite(sample.thrust) ? std::clamp(sample.thrust, 0.0, 1.0) : hover_stick_;
  if (begins) hover_stick_ = sticks_.thrust;
}

bool PilotAssist::assists(bool pilot_flies, common::FlightState flight, const common::VehicleState& state) {
  assists_ = config_.enabled && pilot_flies && flight == common::FlightState::kFlying && state.horizontal_valid &&
             state.vertical_valid && control::isFinite(state);
  if (!assists_) yaw_map_rad_.reset();
  return assists_;
}

Eigen::Vector2d PilotAssist::wantedVelocity_map_m_s(const common::VehicleState& state) const {
  if (!assists_) return Eigen::Vector2d::Zero();
  // A nose down flies forwards, a roll to the right flies to the right.
  const Eigen::Vector2d level_m_s =
      config_.speed_m_s * Eigen::Vector2d(wish(sticks_.pitch, kDeadBand), -wish(sticks_.roll, kDeadBand));
  return Eigen::Rotation2Dd(state.T_map_body_planar().yaw_rad) * level_m_s;
}

/// The reactive layer counts on its own deceleration and lag; against the pilot's stick the program has only what is
/// left of its share, less the tilt by which the horizon may be wrong. A stick beyond that share leaves nothing: the
/// program then requests a stop.
double PilotAssist::allowedSpeed_m_s(const planning::AvoidanceDecision& decision) const {
  const double limit_m_s = decision.speed_limit_m_s;
  if (limit_m_s >= unlimited_m_s_) return limit_m_s;
  const double stick = std::hypot(sticks_.pitch, sticks_.roll);
  const double left_m_s2 =
      common::kGravity_m_s2 * std::tan(max_tilt_rad_ * std::max(0.0, kProgramShare - stick) - kHorizonError_rad);
  const double gap_m = limit_m_s * lag_s_ + 0.5 * limit_m_s * limit_m_s / deceleration_m_s2_ - kSpare_m;
  if (left_m_s2 <= 0.0 || gap_m <= 0.0) return 0.0;
  return std::min(limit_m_s, planning::stoppingSpeed_m_s(gap_m, left_m_s2, kLag_s));
}

/// Away from the nearest return, at least as fast as it takes to regain the distance that is kept.
Eigen::Vector2d PilotAssist::keptAway_level_m_s(const planning::AvoidanceDecision& decision,
                                                const Eigen::Vector2d& velocity_level_m_s) {
  const double missing_m = kSpare_m - decision.status.nearest_m;
  if (!decision.nearest_level_m || missing_m <= 0.0) return velocity_level_m_s;
  const Eigen::Vector2d away = -decision.nearest_level_m->normalized();
  const double slower_m_s = kAway_1_s * missing_m - velocity_level_m_s.dot(away);
  return velocity_level_m_s + std::max(0.0, slower_m_s) * away;
}

bool PilotAssist::fly(control::FlightController& controller, const planning::AvoidanceDecision& decision,
                      const common::VehicleState& state, double max_height_m) {
  const double yaw_now_rad = state.T_map_body_planar().yaw_rad, yaw_stick = wish(sticks_.yaw_rate, kDeadBand);
  if (yaw_stick != 0.0 || !yaw_map_rad_)
    yaw_map_rad_ =
        common::wrapAngle(yaw_now_rad + kYawAhead_s * yaw_stick * config_.yaw_rate_deg_s * common::kRadPerDeg);

  Eigen::Vector2d velocity_map_m_s = wantedVelocity_map_m_s(state);
  double acceleration_m_s2 = kAcceleration_m_s2;
  if (decision.retreat_velocity_level_m_s) {
    velocity_map_m_s = Eigen::Rotation2Dd(yaw_now_rad) * *decision.retreat_velocity_level_m_s;
    acceleration_m_s2 = decision.retreat_acceleration_m_s2;
  } else {
    const double speed_m_s = velocity_map_m_s.norm(), allowed_m_s = allowedSpeed_m_s(decision);
    if (speed_m_s > allowed_m_s) velocity_map_m_s *= allowed_m_s / speed_m_s;
    const Eigen::Rotation2Dd R_map_level(yaw_now_rad);
    velocity_map_m_s = R_map_level * keptAway_level_m_s(decision, R_map_level.inverse() * velocity_map_m_s);
  }
  double climb_m_s = config_.climb_m_s * wish(2.0 * (sticks_.thrust - hover_stick_), kClimbDeadBand);
  if (state.T_odom_body.position_m.z() > max_height_m) climb_m_s = std::min(climb_m_s, 0.0);
  (void)controller.followVelocity(velocity_map_m_s, acceleration_m_s2, *yaw_map_rad_, climb_m_s);
  return (controller.follower().reference().position_odom_m - state.T_odom_body.position_m).head<2>().norm() < kLeft_m;
}

bool PilotAssist::thrustApplies(double thrust) const { return std::abs(thrust - sticks_.thrust) <= kProgramShare; }

}  // namespace swiftlet::autonomy
