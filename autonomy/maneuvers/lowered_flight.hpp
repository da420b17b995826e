// Where the vehicle flies lower than its paths do: below something that hangs over them, and until it is back up.
#pragma once

#include "autonomy/maneuvers/flight_memory.hpp"
#include "autonomy/planning_jobs/lower_planner.hpp"
#include "common/vehicle_state.hpp"
#include "control/flight_controller.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

/// Refers to both, which must outlive it. One thread.
class LoweredFlight {
 public:
  LoweredFlight(FlightMemory& memory, const control::FlightController& controller)
      : memory_(memory), controller_(controller) {}

  /// Remembers where it is lower. `plan` is the plan that is flown; null without one.
  void follow(const planning::Path* plan, const common::VehicleState& state);

  FlightHeights heights() const {
    return {memory_.cruise_height_m, controller_.follower().reference().position_odom_m.z(), memory_.lowered_m};
  }
  /// How much lower than its paths' height the vehicle is to be; else 0.
  double dip_m() const;

 private:
  FlightMemory& memory_;
  const control::FlightController& controller_;
};

}  // namespace swiftlet::autonomy
