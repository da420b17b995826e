#include "autonomy/maneuvers/retreat_flight.hpp"

namespace swiftlet::autonomy {

void RetreatFlight::react(const planning::AvoidanceDecision& decision, const common::VehicleState& state) {
  controller_.setSpeedLimit(decision.speed_limit_m_s);
  if (controller_.state() != common::FlightState::kFlying) {
    yaw_map_rad_.reset();
    return;
  }
  const common::Pose2 T_map_body = state.T_map_body_planar();
  if (decision.retreat_velocity_level_m_s) {
    if (!active() || decision.turn_rad != 0.0) yaw_map_rad_ = T_map_body.yaw_rad + decision.turn_rad;
    (void)controller_.followVelocity(Eigen::Rotation2Dd(T_map_body.yaw_rad) * *decision.retreat_velocity_level_m_s,
                                     decision.retreat_acceleration_m_s2, *yaw_map_rad_);
  } else {
    end();
  }
}

void RetreatFlight::end() {
  if (!active()) return;
  controller_.hold();
  yaw_map_rad_.reset();
}

}  // namespace swiftlet::autonomy
