// Flies the decisions of the reactive layer: its speed limit, where it looks, and its retreat, which overrides every
// intent.
#pragma once

#include <optional>

#include "common/vehicle_state.hpp"
#include "control/flight_controller.hpp"
#include "planning/avoidance/avoidance.hpp"

namespace swiftlet::autonomy {

/// One thread; react() at the laser rate.
///
///            the layer wants to retreat
///   calm ----------------------------------> active: flies at the velocity asked for, no path
///     ^   no longer or unseen (it holds), or the vehicle does not fly any more |
///     +-----------------------------------------------------------------------+
class RetreatFlight {
 public:
  /// `camera_ahead`: a camera looks where the vehicle flies to, so it turns away only in a retreat.
  explicit RetreatFlight(control::FlightController& controller, bool camera_ahead = false)
      : controller_(controller), camera_ahead_(camera_ahead) {}

  void react(const planning::AvoidanceDecision& decision, const common::VehicleState& state);
  /// Without sight of the surroundings the vehicle holds: what it would retreat into is unknown.
  void end();
  bool active() const { return yaw_map_rad_.has_value(); }

 private:
  void look(const planning::AvoidanceDecision& decision, const common::Pose2& T_map_body);

  control::FlightController& controller_;
  bool camera_ahead_;
  std::optional<double> yaw_map_rad_;  ///< The heading during the retreat.
};

}  // namespace swiftlet::autonomy
