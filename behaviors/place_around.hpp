// Where to fly to look at something, or to stay beside somebody: a free place on a circle around it.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "behaviors/flight_tick.hpp"
#include "common/intent.hpp"

namespace swiftlet::behaviors {

/// Places on a circle, evenly spread, the first one along x of the map.
struct PlacesAround {
  Eigen::Vector2d middle_map_m;
  double distance_m;
  int count;
  /// What the map has this near to the middle is the thing itself, and hides it from no side.
  double own_m;
};

/// The free place in sight of the middle that is nearest to the vehicle, facing the middle; nullopt without one.
/// Clearance, tolerance and mode are those of `asked`. `wanted` says which bearings from the middle, in radians, count;
/// without it all do.
std::optional<common::GoToIntent> nearestPlaceAround(const FlightTick& tick, const PlacesAround& around,
                                                     const common::GoToIntent& asked,
                                                     const std::function<bool(double bearing_rad)>& wanted = {});

}  // namespace swiftlet::behaviors
