// A short mission in the first world: take-off, exploring with plans and SLAM jobs, landing; and all its outputs.
#pragma once

#include <memory>
#include <vector>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_sink.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/world.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::autonomy {

std::unique_ptr<simulation::SimulatedVehicle> makeVehicle(int seed, const common::RgbdCameraConfig* camera = nullptr);
Autonomy makeAutonomy(std::unique_ptr<common::JobRunner> jobs, const AutonomyConfig& config,
                      const VehicleMemory* memory = nullptr, const common::RgbdCameraConfig* camera = nullptr);
/// Configured to search for loops within the few metres of a short flight.
Autonomy makeAutonomy(std::unique_ptr<common::JobRunner> jobs);

/// All outputs of the autonomy.
class Witness final : public FlightSink {
 public:
  void ticked(const TickOutcome& outcome) override { ticks.push_back(outcome); }
  void world(const std::shared_ptr<const common::World>& world) override { last_world = world; }
  void event(const common::Event& event) override { events.push_back(event); }
  void result(const common::CommandResult& result) override { results.push_back(result); }
  bool heard(const std::string& part) const;

  std::vector<TickOutcome> ticks;
  std::vector<common::Event> events;
  std::vector<common::CommandResult> results;
  std::shared_ptr<const common::World> last_world;
};

/// The first bitwise difference of the second flight: "setpoint 231"; empty if there is none.
std::string difference(const Witness& first, const Witness& second);

}  // namespace swiftlet::autonomy
