// Two vehicles in one room, each flown by the truth.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "simulation/arena.hpp"

namespace swiftlet::simulation {

inline ScenarioVehicle vehicleAt(const std::string& name, double x_m, double y_m, double yaw_deg = 0.0) {
  ScenarioVehicle vehicle;
  vehicle.name = name;
  vehicle.start = {false, x_m, y_m, 0.0, yaw_deg};
  return vehicle;
}

inline Scenario scenarioOf(std::vector<ScenarioVehicle> vehicles) {
  Scenario scenario;
  scenario.sensors.camera.width_px = 32;
  scenario.sensors.camera.height_px = 24;
  scenario.vehicles = std::move(vehicles);
  return scenario;
}

/// Vehicles `a` and `b` with their pilots.
struct Pair {
  explicit Pair(const Scenario& scenario, const WorldModel& world = boxRoom())
      : arena(std::make_shared<Arena>(world, scenario)), a(arena, 0), b(arena, 1), pilot_a(a), pilot_b(b) {}

  /// Tick by tick, `a` before `b` or in the other order; one that has crashed is left out.
  void fly(double seconds, bool a_first = true) {
    TruthPilot& first = a_first ? pilot_a : pilot_b;
    TruthPilot& second = a_first ? pilot_b : pilot_a;
    for (int tick = 0; tick < std::lround(seconds / common::kControlPeriod.seconds()); ++tick) {
      for (TruthPilot* pilot : {&first, &second}) pilot->steer();
      for (TruthPilot* pilot : {&first, &second})
        if (!pilot->vehicle().truth().crashed) (void)pilot->advance();
    }
  }

  std::shared_ptr<Arena> arena;
  SimulatedVehicle a, b;
  TruthPilot pilot_a, pilot_b;
};

/// The range straight ahead in the last scan.
inline float rangeAhead_m(const std::vector<common::SensorEvent>& events) {
  const std::vector<float>& ranges_m = eventsOf<Scan>(events).back()->ranges_m;
  return ranges_m[ranges_m.size() / 2];
}

}  // namespace swiftlet::simulation
