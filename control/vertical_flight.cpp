#include "control/vertical_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "control/emergency_descent.hpp"

namespace swiftlet::control {
namespace {

constexpr double kSpoolUp_s = 0.8;     ///< Time from starting the motors to lifting.
constexpr double kSpoolShare = 0.6;    ///< Share of the hover command given before the vehicle lifts.
constexpr double kLiftedOff_m = 0.06;  ///< Above the noise of the height and the give of the gear.
/// Taking off ends when the vehicle has been this close to the height, and slower than this, for this long.
constexpr double kHoverTolerance_m = 0.10, kHoverSpeed_m_s = 0.15, kHover_s = 0.4;
/// Without hovering this long after the climb should have ended the vehicle lands again.
constexpr double kTakeOffTimeout_s = 15.0;
/// A take-off with all of its thrust for this long is given up; with enough thrust, a lift takes tenths of that.
/// Measured: docs/decisions/control.md#033.
constexpr double kSpent_s = 2.0;

constexpr double kAcceleration_m_s2 = 0.8;  ///< Vertical acceleration of taking off and landing.
constexpr double kReferenceLead_m = 0.3;    ///< Greatest lead of the height reference over the vehicle.

constexpr double kNearGround_m = 0.4;          ///< Height over what is below at which the ground counts as near.
constexpr double kTouchdownDescent_m_s = 0.2;  ///< Descent speed near the ground.
constexpr double kTouchdownThrust = 0.7;      ///< Below this share of the hover command the ground carries the vehicle.
constexpr double kTouchdownSpeed_m_s = 0.10;  ///< A descent is faster: only the ground explains less.
constexpr double kTouchdown_s = 0.3;          ///< The vehicle has landed when the ground has carried it for this long.
constexpr double kTouchdownMargin_m = 0.20;   ///< Error of the height after a descent over unknown ground.
/// A table of glass, or the edges of a gap, carry the vehicle higher than the beams down say. In the air no wind holds
/// it still for this long.
constexpr double kStandsHigher_s = 3.0;
constexpr double kCarried_s = 0.5;  ///< Age from which the height counts as carried by inertial samples.
/// A speed that was carried is off by the bias of the accelerometer; in the air so little thrust would change it by
/// more than this within kTouchdown_s: the missing 0.3 g change it by 0.88 m/s in 0.3 s, and from -0.35 to 0.35 m/s are
/// 0.70 m/s.
constexpr double kCarriedTouchdownSpeed_m_s = 0.35;
constexpr double kCarriedLimit_s = 10.0;  ///< Beyond this age a carried speed counts as no worse.

/// Without a measurement the inertial samples carry the height.
bool isCarried(const TickClock& clock, const common::VehicleState& state) {
  return state.verticalAge_s(clock.now()) > kCarried_s;
}

/// The uncertainty of a carried height grows.
double uncertainty_m(bool carried, const common::VehicleState& state) {
  return carried ? 2.0 * std::sqrt(std::max(0.0, state.position_covariance_m2(2, 2))) : 0.0;
}

}  // namespace

std::string VerticalFlight::refusal(double height_m, double standing_m) const {
  const double least_m = standing_m + kHoverTolerance_m;
  if (!std::isfinite(height_m) || height_m < least_m)
    return fmt::format("a take-off height of {:.2f} m is not above {:.2f} m", height_m, least_m);
  if (height_m > max_height_m_)
    return fmt::format("a take-off height of {:.2f} m is above the greatest height, {:.2f} m", height_m, max_height_m_);
  return {};
}

void VerticalFlight::start(common::Time now, double standing_m, double standing_raw_m) {
  started_ = now;
  standing_m_ = standing_m;
  standing_raw_m_ = standing_raw_m;
  lifted_ = false;
  restart(standing_m, 0.0);
}

void VerticalFlight::restart(double height_m, double climb_m_s) {
  height_m_ = height_m;
  rate_m_s_ = climb_m_s;
  spent_.reset();
  hovers_.reset();
  rests_.reset();
}

void VerticalFlight::skipSpoolUp(common::Time now) {
  const auto spool_up = common::Duration::fromSeconds(kSpoolUp_s);
  if (now - started_ > spool_up) started_ = now - spool_up;
}

std::optional<double> VerticalFlight::spoolUpShare(common::Time now) const {
  const double spooled = (now - started_).seconds() / kSpoolUp_s;
  return spooled < 1.0 ? std::optional(spooled * kSpoolShare) : std::nullopt;
}

void VerticalFlight::climb(const TickClock& clock, const common::VehicleState& state, const MarginLimits& margin) {
  const double height_m = state.T_odom_body.position_m.z();
  if (!lifted_ && height_m > standing_m_ + kLiftedOff_m) {
    // The lead that the reference gained while the vehicle still stood would become overshoot.
    lifted_ = true;
    height_m_ = height_m;
  }
  move(goal_m_, margin.speed() * climb_m_s_, height_m, clock, margin);
}

std::optional<VerticalFlight::End> VerticalFlight::takeOffEnd(const TickClock& clock, const common::VehicleState& state,
                                                              double command, const ThrustModel& thrust) {
  const double height_m = state.T_odom_body.position_m.z();
  const double timeout_s = kTakeOffTimeout_s + goal_m_ / climb_m_s_;
  const bool hovers =
      std::abs(height_m - goal_m_) <= kHoverTolerance_m && state.velocity_odom_m_s.norm() <= kHoverSpeed_m_s;
  const bool spent = thrust.isGreatest(command);
  spent_.update(spent, clock.now());
  hovers_.update(hovers && !spent, clock.now());
  if (spent_.active_s(clock.now()) >= kSpent_s)
    return End{FlightInput::kLand,
               fmt::format("{:.0f} % of the thrust for {:.1f} s did not reach the height", 100.0 * command, kSpent_s)};
  if (hovers_.active_s(clock.now()) >= kHover_s)
    return End{FlightInput::kHoverReached, fmt::format("hovers at {:.2f} m", height_m)};
  if ((clock.now() - started_).seconds() > timeout_s)
    return End{FlightInput::kLand, fmt::format("not hovering after {:.0f} s", timeout_s)};
  return std::nullopt;
}

void VerticalFlight::descend(const TickClock& clock, const common::VehicleState& state, const MarginLimits& margin,
                             bool drifts) {
  const bool carried = isCarried(clock, state);
  const bool near = state.height_above_ground_m < standing_raw_m_ + kNearGround_m + uncertainty_m(carried, state);
  // Faster by what the carried speed may be wrong, so that the vehicle sinks in any case.
  const double wrong_m_s =
      carried ? kCarriedSpeed_m_s2 * std::min(kCarriedLimit_s, state.verticalAge_s(clock.now())) : 0.0;
  // Without a position the drift grows with time, so the vehicle sinks faster.
  const double far_m_s = drifts ? EmergencyDescent::kDescent_m_s : descent_m_s_;
  const double near_m_s = drifts ? EmergencyDescent::kTouchdownDescent_m_s : kTouchdownDescent_m_s;
  const double descent_m_s = margin.speed() * (near ? near_m_s : far_m_s);
  move(-std::numeric_limits<double>::infinity(), descent_m_s + wrong_m_s, state.T_odom_body.position_m.z(), clock,
       margin);
}

/// If the vehicle does not sink under a small thrust, it stands on the ground.
std::optional<std::string> VerticalFlight::touchedDown(const TickClock& clock, const common::VehicleState& state,
                                                       double command, const ThrustModel& thrust) {
  const double over_ground_m = state.height_above_ground_m;
  const bool carried = isCarried(clock, state);
  const bool rests =
      command < kTouchdownThrust * thrust.hoverCommand() &&
      std::abs(state.velocity_odom_m_s.z()) < (carried ? kCarriedTouchdownSpeed_m_s : kTouchdownSpeed_m_s);
  const bool low = over_ground_m < standing_raw_m_ + kTouchdownMargin_m + uncertainty_m(carried, state);
  rests_.update(rests && (low || !carried), clock.now());
  if (rests_.active_s(clock.now()) < (low ? kTouchdown_s : kStandsHigher_s)) return std::nullopt;
  return fmt::format("{:.2f} m over the ground{}", over_ground_m, low ? "" : " that the beams measure, at rest");
}

double VerticalFlight::landing_s(double height_m, const MarginLimits& margin) const {
  const double fast_m = std::max(0.0, height_m - standing_raw_m_ - kNearGround_m);
  const double ramp_s = descent_m_s_ / kAcceleration_m_s2;
  return (fast_m / descent_m_s_ + kNearGround_m / kTouchdownDescent_m_s) / margin.speed() + ramp_s + kTouchdown_s;
}

bool VerticalFlight::nearGround(const common::VehicleState& state) const {
  return state.height_above_ground_m < standing_raw_m_ + kNearGround_m;
}

/// The rate changes within the acceleration, so that it is zero at the goal.
void VerticalFlight::move(double goal_m, double speed_m_s, double height_m, const TickClock& clock,
                          const MarginLimits& margin) {
  const double dt_s = clock.dt_s();
  const double left_m = goal_m - height_m_;
  const double acceleration_m_s2 = margin.acceleration() * kAcceleration_m_s2;
  const double stoppable = std::sqrt(2.0 * acceleration_m_s2 * std::abs(left_m));
  const double wanted = std::copysign(std::min({speed_m_s, stoppable, std::abs(left_m) / dt_s}), left_m);
  const double step = acceleration_m_s2 * dt_s;
  // In steps, braking along the root needs a little more than the acceleration.
  rate_m_s_ = std::clamp(wanted, rate_m_s_ - 1.2 * step, rate_m_s_ + 1.2 * step);
  height_m_ = std::clamp(height_m_ + rate_m_s_ * dt_s, height_m - kReferenceLead_m, height_m + kReferenceLead_m);
}

}  // namespace swiftlet::control
