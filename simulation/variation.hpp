// What a seed makes of a scenario: where the vehicles start, where the obstacles stand, the wind and the batteries.
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
  std::string name;  ///< Empty when it flies alone without one.
  /// With this vehicle alone; `start`, `wind.mean` and `battery_remaining` as drawn.
  Scenario scenario;
  /// Names its random streams: the scenario's own seed for the first vehicle, so that it draws as if it flew alone.
  std::uint64_t stream_seed = 0;
  /// The take-off place on its floor.
  common::Pose3 T_world_map;
  int redraws = 0;  ///< Draws that were refused: something in the way of start or obstacle, a goal out of reach.
};

struct Realization {
  WorldModel world;
  std::vector<PlacedVehicle> vehicles;  ///< At least one.
};

/// Draws until the start is free and every goal can be reached, at most kMostDraws times; first the obstacles, the wind
/// and the first vehicle, then each further vehicle in what stands by then. The same world, scenario and seed give the
/// same result. Throws common::InputError with file and line when the scenario cannot be flown: no floor under a start,
/// a start inside something, an unknown obstacle, or no draw that will do.
Realization realize(const WorldModel& world, const Scenario& scenario);
inline constexpr int kMostDraws = 200;

}  // namespace swiftlet::simulation
