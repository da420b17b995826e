#include "autonomy/maneuvers/retreat_flight.hpp"

#include <cmath>

namespace swiftlet::autonomy {

void RetreatFlight::react(const planning::AvoidanceDecision& decision, const common::VehicleState& state) {
  controller_.setSpeedLimit(decision.speed_limit_m_s);
  const common::Pose2 T_map_body = state.T_map_body_planar();
  look(decision, T_map_body);
  if (controller_.state() != common::FlightState::kFlying) {
    yaw_map_rad_.reset();
    return;
  }
  if (decision.retreat_velocity_level_m_s) {
    if (!active() || decision.turn_rad) yaw_map_rad_ = T_map_body.yaw_rad + decision.turn_rad.value_or(0.0);
    (void)controller_.followVelocity(Eigen::Rotation2Dd(T_map_body.yaw_rad) * *decision.retreat_velocity_level_m_s,
                                     decision.retreat_acceleration_m_s2, *yaw_map_rad_);
  } else {
    end();
  }
}

void RetreatFlight::look(const planning::AvoidanceDecision& decision, const common::Pose2& T_map_body) {
  // So far away that its bearing does not change with the place.
  constexpr double kFar_m = 100.0;
  std::optional<Eigen::Vector2d> point_map_m;
  if (decision.turn_rad && !camera_ahead_)
    point_map_m =
        T_map_body * Eigen::Vector2d(kFar_m * std::cos(*decision.turn_rad), kFar_m * std::sin(*decision.turn_rad));
  controller_.lookAt(point_map_m, control::FlightController::Looks::kForReactive);
}

void RetreatFlight::end() {
  if (!active()) return;
  controller_.hold();
  yaw_map_rad_.reset();
}

}  // namespace swiftlet::autonomy
