// Feedback of one tick of flying to the senses, for the inputs after it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "autonomy/inertial/inertial_check.hpp"
#include "common/given_map.hpp"
#include "common/vehicle.hpp"

namespace swiftlet::autonomy {

/// The mission's order about the given map.
struct GivenMapOrder {
  std::shared_ptr<const common::GivenMap>
      load;  ///< The given map from now on; null: the place in it is searched again.
};

struct Feedback {
  bool airborne = false;  ///< Otherwise the vehicle stands still.
  /// How much lower than the height of the map the vehicle flies, on a path in space; negative above.
  double below_map_m = 0.0;
  /// Elsewhere scans are not compared with the given map, because near the floor the laser sees other objects.
  bool at_flight_height = false;
  std::optional<double> flight_height_m;  ///< Over the take-off floor, of the slice of the map; nullopt on the ground.
  double thrust_margin = 0.0;             ///< Greatest thrust over the weight.
  /// The horizontal speed while the vehicle follows a path whose end is not near; nullopt otherwise.
  std::optional<double> path_speed_m_s;
  common::Setpoint setpoint;
  InertialContext inertial;  ///< How that setpoint was flown.
  std::vector<GivenMapOrder> given_map;
};

}  // namespace swiftlet::autonomy
