// What a seed makes of a scenario: where the vehicle starts, where the obstacles stand, the wind and the battery.
#pragma once

#include <string>

#include "common/geometry.hpp"
#include "simulation/scenario.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

struct Realization {
  WorldModel world;
  /// With `start`, `wind.mean`, and `battery_remaining` as drawn.
  Scenario scenario;
  /// The take-off place on its floor.
  common::Pose3 T_world_map;
  int redraws = 0;  ///< Draws that were refused: start or an obstacle in the way, a goal out of reach.
};

/// Draws until the start is free and every goal can be reached, at most kMostDraws times. The same world, scenario and
/// seed give the same result. Throws common::InputError with file and line when the scenario cannot be flown: no floor
/// under the start, the start inside something, an unknown obstacle, or no draw that will do.
Realization realize(const WorldModel& world, const Scenario& scenario);
inline constexpr int kMostDraws = 200;

}  // namespace swiftlet::simulation
