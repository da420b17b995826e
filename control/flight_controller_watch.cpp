// What the flight controller does about an estimate that can be used no longer.
#include <algorithm>

#include <fmt/core.h>

#include "control/flight_controller.hpp"
#include "control/usable_state.hpp"

namespace swiftlet::control {

using common::FlightState;
using common::Severity;

void FlightController::watch(const FlightTick& tick) {
  watchInertial(tick.inertial_fault);
  const bool vertical = isFinite(tick.state) && tick.state.vertical_valid;
  if (vertical) {
    vertical_lost_.reset();
  } else if (!vertical_lost_) {
    vertical_lost_ = now_;
  }
  if (tick.fusion_diverged && state() == FlightState::kLanded) transition(FlightInput::kEmergency, "fusion diverged");
  if (!isAirborne(state()) || state() == FlightState::kEmergencyLanding) return;
  if (tick.fusion_diverged) {
    transition(FlightInput::kEmergency, "fusion diverged");
  } else if (vertical_lost_ && (now_ - *vertical_lost_).seconds() >= config_.vertical_loss_s) {
    transition(FlightInput::kEmergency, fmt::format("no valid height for {:.1f} s", config_.vertical_loss_s));
  } else if (inertial_lost_ && (now_ - *inertial_lost_).seconds() >= config_.inertial_loss_s) {
    transition(FlightInput::kEmergency, fmt::format("{} for {:.1f} s", inertial_fault_, config_.inertial_loss_s));
  } else {
    watchHorizontal(tick);
  }
}

void FlightController::watchInertial(std::string_view fault) {
  if (fault.empty()) {
    if (inertial_lost_) say(Severity::kInfo, "inertial samples are good again");
    inertial_lost_.reset();
  } else if (!inertial_lost_) {
    inertial_lost_ = now_;
    say(Severity::kWarning, "inertial samples cannot be used", std::string(fault));
  }
  inertial_fault_ = fault;
}

void FlightController::watchHorizontal(const FlightTick& tick) {
  if (escapes_until_ && (tick.state.horizontal_valid || now_ >= *escapes_until_)) {
    escapes_until_.reset();
    follower_.stop();
  }
  if (tick.state.horizontal_valid) {
    if (horizontal_lost_) {
      // The present height, not the reference, which may be far away.
      Eigen::Vector3d here = last_state_.T_odom_body.position_m;
      here.z() = follower_.reference().position_odom_m.z();
      follower_.reset(here, common::yawOf(last_state_.T_odom_body.rotation));
      say(Severity::kInfo, "horizontal estimate is back");
    }
    horizontal_lost_.reset();
    return;
  }
  if (!horizontal_lost_) {
    horizontal_lost_ = now_;
    escape();
  }
  if (state() != FlightState::kLanding && (now_ - *horizontal_lost_).seconds() >= config_.horizontal_loss_s)
    transition(FlightInput::kLand, fmt::format("no horizontal estimate for {:.1f} s", config_.horizontal_loss_s));
}

/// The velocity is known for longer than the position. So the vehicle brakes, or flies away from the walls into which
/// it would drift while it descends.
void FlightController::escape() {
  const double length_m = std::min(escape_map_m_.norm(), escapeReach_m());
  if (state() != FlightState::kFlying || length_m < config_.blind_speed_m_s * dt_s_) {
    follower_.stop();
    return say(Severity::kWarning, "horizontal estimate lost", "holding the velocity", common::Concern::kPosition);
  }
  const Eigen::Vector2d velocity_m_s =
      Eigen::Rotation2Dd(-T_map_odom_.yaw_rad) * (config_.blind_speed_m_s * escape_map_m_.normalized());
  follower_.setVelocity({velocity_m_s.x(), velocity_m_s.y(), 0.0}, config_.blind_acceleration_m_s2,
                        common::yawOf(last_state_.T_odom_body.rotation));
  escapes_until_ = now_ + common::Duration::fromSeconds(length_m / config_.blind_speed_m_s);
  say(Severity::kWarning, "horizontal estimate lost", fmt::format("flying {:.1f} m away from the walls", length_m),
      common::Concern::kPosition);
}

void FlightController::keepPathInMap(const common::VehicleState& state) {
  const common::Pose2& now = state.T_map_odom;
  const bool same = now.x_m == T_map_odom_.x_m && now.y_m == T_map_odom_.y_m && now.yaw_rad == T_map_odom_.yaw_rad;
  if (same) return;
  follower_.movePath(now.inverse() * T_map_odom_);
  T_map_odom_ = now;
}

}  // namespace swiftlet::control
