// Taking off and landing: the part of the flight controller that moves the height by itself.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "common/gravity.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::control {

using common::FlightState;

namespace {

constexpr double kLiftedOff_m = 0.06;     ///< Above the noise of the height and the give of the gear.
constexpr double kSpoolShare = 0.6;       ///< Share of the hover command given before the vehicle lifts.
constexpr double kReferenceLead_m = 0.3;  ///< Greatest lead of the height reference over the vehicle.
/// A take-off with all of its thrust for this long is given up; with enough thrust, a lift takes tenths of that.
constexpr double kSpent_s = 2.0;
/// A table of glass, or the edges of a gap, carry the vehicle higher than the beams down say. In the air no wind holds
/// it still for this long.
constexpr double kStandsHigher_s = 3.0;
constexpr double kTouchdownSpeed_m_s = 0.10;  ///< A descent is faster: only the ground explains less.
constexpr double kTouchdownMargin_m = 0.20;   ///< Error of the height after a descent over unknown ground.
constexpr double kCarried_s = 0.5;            ///< Age from which the height counts as carried by inertial samples.
/// A speed that was carried is off by the bias of the accelerometer; in the air so little thrust would change it by
/// more than this within touchdown_s.
constexpr double kCarriedTouchdownSpeed_m_s = 0.35;
constexpr double kCarriedLimit_s = 10.0;  ///< Beyond this age a carried speed counts as no worse.

}  // namespace

common::Setpoint FlightController::takeOff(const FlightTick& tick) {
  const double spooled = (now_ - state_since_).seconds() / config_.spool_up_s;
  const double height_m = last_state_.T_odom_body.position_m.z();
  if (spooled < 1.0) {
    common::Setpoint setpoint;
    setpoint.motors_on = true;
    position_.thrust().observeVoltage(tick.battery_v, dt_s_);
    setpoint.thrust = spooled * kSpoolShare * position_.thrust().hoverCommand();
    return setpoint;
  }
  if (!lifted_ && height_m > standing_height_m_ + kLiftedOff_m) {
    // The lead that the reference gained while the vehicle still stood would become overshoot.
    lifted_ = true;
    height_reference_m_ = height_m;
  }
  moveVertically(take_off_height_m_, margin_.speed() * config_.climb_m_s, height_m);
  const common::Setpoint setpoint = track(tick, follower_.advance(dt_s_), !lifted_);

  const double timeout_s = config_.take_off_timeout_s + take_off_height_m_ / config_.climb_m_s;
  const bool hovers = std::abs(height_m - take_off_height_m_) <= config_.hover_tolerance_m &&
                      last_state_.velocity_odom_m_s.norm() <= config_.hover_speed_m_s;
  constexpr double kRounding = 1e-6;  // Of a command that was clamped.
  const bool spent = setpoint.thrust >= config_.position.thrust.max_thrust - kRounding;
  if (heldFor(spent_since_, spent, kSpent_s)) {
    transition(FlightInput::kLand, fmt::format("{:.0f} % of the thrust for {:.1f} s do not carry it there",
                                               100.0 * setpoint.thrust, kSpent_s));
  } else if (heldFor(condition_since_, hovers && !spent, config_.hover_s)) {
    transition(FlightInput::kHoverReached, fmt::format("hovers at {:.2f} m", height_m));
  } else if ((now_ - state_since_).seconds() > timeout_s) {
    transition(FlightInput::kLand, fmt::format("not hovering after {:.0f} s", timeout_s));
  }
  return setpoint;
}

common::Setpoint FlightController::descend(const FlightTick& tick) {
  const double height_m = last_state_.T_odom_body.position_m.z();
  const double over_ground_m = last_state_.height_above_ground_m;
  // Without a measurement the inertial samples carry the height, and its uncertainty grows.
  const bool carried = last_state_.verticalAge_s(now_) > kCarried_s;
  const double uncertain_m = carried ? 2.0 * std::sqrt(std::max(0.0, last_state_.position_covariance_m2(2, 2))) : 0.0;
  const bool near = over_ground_m < standing_raw_m_ + config_.touchdown_height_m + uncertain_m;
  // Faster by what the carried speed may be wrong, so that the vehicle sinks in any case.
  const double wrong_m_s =
      carried ? kCarriedSpeed_m_s2 * std::min(kCarriedLimit_s, last_state_.verticalAge_s(now_)) : 0.0;
  // Without a position the drift grows with time, so the vehicle sinks faster.
  const bool drifts = !tick.state.horizontal_valid;
  const double far_m_s = drifts ? config_.emergency.descent_m_s : config_.descent_m_s;
  const double near_m_s = drifts ? config_.emergency.touchdown_descent_m_s : config_.touchdown_descent_m_s;
  const double descent_m_s = margin_.speed() * (near ? near_m_s : far_m_s);
  moveVertically(-std::numeric_limits<double>::infinity(), descent_m_s + wrong_m_s, height_m);
  const common::Setpoint setpoint = track(tick, follower_.advance(dt_s_));

  // If the vehicle does not sink under a small thrust, it stands on the ground.
  const bool rests =
      setpoint.thrust < config_.touchdown_thrust * position_.thrust().hoverCommand() &&
      std::abs(last_state_.velocity_odom_m_s.z()) < (carried ? kCarriedTouchdownSpeed_m_s : kTouchdownSpeed_m_s);
  const bool low = over_ground_m < standing_raw_m_ + kTouchdownMargin_m + uncertain_m;
  if (!heldFor(condition_since_, rests && (low || !carried), low ? config_.touchdown_s : kStandsHigher_s))
    return setpoint;
  transition(FlightInput::kTouchedDown,
             fmt::format("{:.2f} m over the ground{}", over_ground_m, low ? "" : " that the beams see, and stands"));
  common::Setpoint landed;
  landed.motors_on = true;
  return landed;
}

double FlightController::carryingCommand() const {
  const double lift_m_s2 =
      state() == FlightState::kEmergencyLanding ? emergency_.lift_m_s2() : position_.trim_odom_m_s2().z();
  return position_.thrust().hoverCommand() * (1.0 + lift_m_s2 / common::kGravity_m_s2);
}

double FlightController::landing_s() const {
  const double slow_m = config_.touchdown_height_m;
  const double fast_m = std::max(0.0, last_state_.T_odom_body.position_m.z() - standing_raw_m_ - slow_m);
  const double ramp_s = config_.descent_m_s / config_.climb_acceleration_m_s2;
  return (fast_m / config_.descent_m_s + slow_m / config_.touchdown_descent_m_s) / margin_.speed() + ramp_s +
         config_.touchdown_s;
}

void FlightController::moveVertically(double goal_m, double speed_m_s, double height_m) {
  const double left_m = goal_m - height_reference_m_;
  const double acceleration_m_s2 = margin_.acceleration() * config_.climb_acceleration_m_s2;
  const double stoppable = std::sqrt(2.0 * acceleration_m_s2 * std::abs(left_m));
  const double wanted = std::copysign(std::min({speed_m_s, stoppable, std::abs(left_m) / dt_s_}), left_m);
  const double step = acceleration_m_s2 * dt_s_;
  climb_reference_m_s_ = std::clamp(wanted, climb_reference_m_s_ - 1.2 * step, climb_reference_m_s_ + 1.2 * step);
  height_reference_m_ = std::clamp(height_reference_m_ + climb_reference_m_s_ * dt_s_, height_m - kReferenceLead_m,
                                   height_m + kReferenceLead_m);
}

/// The ground may carry a part of the weight while the vehicle takes off and lands.
bool FlightController::learnsThrust(const FlightTick& tick) const {
  if (!tick.thrust_applies || tick.pilot_flies || state() == FlightState::kEmergencyLanding) return false;
  if (tick.inertial_contradicted) return false;  // The estimate follows the given thrust, whatever the vehicle weighs.
  if (state() == FlightState::kTakingOff) return lifted_;
  return state() == FlightState::kFlying || !nearGround();
}

bool FlightController::nearGround() const {
  return last_state_.height_above_ground_m < standing_raw_m_ + config_.touchdown_height_m;
}

}  // namespace swiftlet::control
