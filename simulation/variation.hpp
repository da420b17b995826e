// The scenario as varied by a seed: starts of the vehicles, places of the obstacles, the wind and the batteries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "simulation/scenario.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// A vehicle at its start.
struct PlacedVehicle {
  std::string name;  ///< Empty for a single vehicle without a name.
  /// The scenario for this vehicle alone; `start`, `wind.mean` and `battery_remaining` as drawn.
  Scenario scenario;
  /// Names its random streams. For the first vehicle it is the scenario's own seed, so that it draws as if it flew
  /// alone.
  std::uint64_t stream_seed = 0;
  /// The take-off place on its floor.
  common::Pose3 T_world_map;
  int redraws = 0;  ///< Draws that were refused: start or obstacle blocked, or a goal out of reach.
};

struct Realization {
  WorldModel world;
  std::vector<PlacedVehicle> vehicles;  ///< At least one.
};

/// Draws of a seed until one will do, at most. A world in which one draw in twenty is suitable is refused once in
/// 30,000 seeds: 0.95^200.
inline constexpr int kMostDraws = 200;

/// Draws until the start is free and every goal can be reached, at most kMostDraws times. First it draws the obstacles,
/// the wind and the first vehicle, then each further vehicle into the world with those before it. The same world,
/// scenario and seed give the same result. Throws common::InputError with file and line if the scenario cannot be
/// flown: no floor under a start, a start inside something, an unknown obstacle, or no suitable draw.
Realization realize(const WorldModel& world, const Scenario& scenario);

}  // namespace swiftlet::simulation
