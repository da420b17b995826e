// Assistance for a pilot who flies by hand (Grzonka 2012, IV-D): the sticks steer, the program keeps the vehicle
// from what the laser sees and holds it while the sticks are centred. The remote control mixes both: the program moves
// each stick by at most a fifth of its range (AutopilotConfig::program_share in the simulator), so that the pilot flies
// on whatever the program does.
//
//                   the pilot takes over,           the pilot gives control back,
//                   and the estimate is good        or the estimate is lost
//   not assisting ------------------------> assisting ------------------------> not assisting
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle_state.hpp"
#include "control/flight_controller.hpp"
#include "planning/avoidance/avoidance.hpp"

namespace swiftlet::autonomy {

struct PilotAssistConfig {
  bool enabled = false;
  double speed_m_s = 2.5;
  double climb_m_s = 0.5;
  double yaw_rate_deg_s = 60.0;

  void describe(common::config::Fields& fields);
};

/// One thread; called at every tick of the controller.
class PilotAssist {
 public:
  /// Share of a stick's range within which it counts as centred.
  static constexpr double kDeadBand = 0.03;

  /// `max_tilt_deg`: tilt at the end of a stick; `avoidance`: settings of the speed limits in the decisions.
  PilotAssist(const PilotAssistConfig& config, double max_tilt_deg, const planning::AvoidanceConfig& avoidance);

  void pilotArrived(const common::PilotSample& sample);

  /// Whether it assists in this tick: the pilot flies in the air, and the position is known.
  bool assists(bool pilot_flies, common::FlightState flight, const common::VehicleState& state);
  /// The velocity by the pilot's sticks, in `map`; zero while it does not assist.
  Eigen::Vector2d wantedVelocity_map_m_s(const common::VehicleState& state) const;
  /// Commands the controller by the sticks, as far as the reactive layer allows. Returns false when the pilot's sticks
  /// have led the vehicle so far from the reference that it has to restart where the vehicle is.
  [[nodiscard]] bool fly(control::FlightController& controller, const planning::AvoidanceDecision& decision,
                         const common::VehicleState& state, double max_height_m);
  /// Whether the thrust of the program is within the share by which it may move the stick.
  bool thrustApplies(double thrust) const;

 private:
  double allowedSpeed_m_s(const planning::AvoidanceDecision& decision) const;
  static Eigen::Vector2d keptAway_level_m_s(const planning::AvoidanceDecision& decision,
                                            const Eigen::Vector2d& velocity_level_m_s);

  PilotAssistConfig config_;
  double max_tilt_rad_;
  double hover_stick_;  ///< The stick of the thrust when the pilot took over: from there it commands climb or descent.
  double deceleration_m_s2_, lag_s_, unlimited_m_s_;  ///< Of the reactive layer.
  common::PilotSample sticks_;
  bool assists_ = false;
  std::optional<double> yaw_map_rad_;  ///< Held while the stick of the yaw is centred.
};

}  // namespace swiftlet::autonomy
