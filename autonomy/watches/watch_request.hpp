// The request of a watch to the supervisor.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/event.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/flight_state.hpp"

namespace swiftlet::autonomy {

/// The condition of the vehicle at one tick.
struct VehicleCondition {
  common::FlightState flight = common::FlightState::kPreparation;
  common::EnergyLayer energy;
  std::string charge_counted_on;  ///< EnergyMonitor::countedOn.
  double vertical_age_s = 0.0;    ///< VehicleState::verticalAge_s.
  double drift_m = 0.0;           ///< See DriftMonitor.
  /// Whether the map has walls around the vehicle, by which the position may be found again: not so in the open.
  bool walls_around = true;
  /// Whether the state is valid and some sensor has just measured the position and the height.
  bool position_measured = false;
  /// Why the vehicle must land while its other sensors hold it, for people; empty if it need not.
  std::string sensor_lies;
  bool lands = false;  ///< The vehicle is about to land where it is, and needs no path home.
};

/// The answer of a watch to one tick. Each reason is for people; it is empty without such a request.
struct WatchRequest {
  std::string hold;                   ///< Why the vehicle must stop, in this tick.
  unsigned back = 0;                  ///< The present flight back along the trail, counted from 1; 0: no such flight.
  std::string home;                   ///< Why a flight home begins, in one tick only.
  std::string land;                   ///< Why it must land. It is not revoked.
  std::vector<common::Event> events;  ///< What has changed since the last tick.

  void say(common::Time now, common::Severity severity, std::string text, std::string why = {},
           common::Concern concern = common::Concern::kNone) {
    events.push_back({now, severity, "supervisor", std::move(text), std::move(why), {}, concern});
  }
};

}  // namespace swiftlet::autonomy
