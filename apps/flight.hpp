// One simulated flight from the first tick to the last: the simulator's vehicle and the autonomy in a FlightLoop, with
// the run folder, the page and the scorer's recorder as sinks. `fly` and `trial` use it.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/given_map.hpp"
#include "apps/system.hpp"
#include "behaviors/mission.hpp"
#include "evaluation/flight_recorder.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/run_folder.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::apps {

class WebLink;

struct FlightSetup {
  System system;
  std::string mission_file;              ///< For the run's records; the mission itself was already read from it.
  simulation::Scenario scenario;         ///< World, start, weather, seed. Vehicle and laser are those of the system.
  std::shared_ptr<const FlightMap> map;  ///< The map to localize in; null if none was given.
  std::filesystem::path out;
  std::string started;           ///< For the run's records.
  double speed = 0.0;            ///< Multiple of real time; 0 for as fast as possible.
  double time_limit_s = 1800.0;  ///< Limit of simulated time.
  double linger_s = 0.0;         ///< Time on the wall clock to wait after the end, so that a page can show it.
};

struct FlightProgress {
  std::shared_ptr<const common::World> world;
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

struct FlightHooks {
  std::function<void(const FlightProgress&)> progress;  ///< Called about ten times a second of wall time.
  std::function<void(const common::Event&)> event;
  WebLink* web = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< Ends the flight from outside.
  /// Called at the end, before the run's last files are written. It adds the figures of a scorer to them.
  std::function<void(const evaluation::FlightRecord&, const simulation::SimulatedVehicle&, interfaces::FlightEnd&)>
      score;
};

struct FlightResult {
  interfaces::FlightSummary summary;
  std::filesystem::path folder;
  std::optional<std::string> write_failure;
};

/// Flies to the end of the flight. Throws common::InputError for a world or folder that cannot be used, before anything
/// moves. Flights may run in several threads at once, each with a folder of its own.
FlightResult flySimulated(const FlightSetup& setup, behaviors::Mission mission, const FlightHooks& hooks);

/// "2026-11-21_14-03-55", local time.
std::string startedNow();

}  // namespace swiftlet::apps
