// One simulated flight from the first tick to the last: the simulator's vehicle and the autonomy in a FlightLoop, with
// the run folder, the page and the scorer's recorder beside it. Used by `fly` and by `trial`.
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
  std::string mission_file;              ///< For the run's records; what is flown is the mission read from it.
  simulation::Scenario scenario;         ///< World, start, weather, seed; vehicle and laser are taken from the system.
  std::shared_ptr<const FlightMap> map;  ///< To find itself in; null: it is given none.
  std::filesystem::path out;
  std::string started;           ///< For the run's records.
  double speed = 0.0;            ///< Times real time; 0: as fast as the machine can.
  double time_limit_s = 1800.0;  ///< Of simulated time.
  double linger_s = 0.0;         ///< Time on the wall clock to wait after the end, so that a page sees it.
};

struct FlightProgress {
  std::shared_ptr<const common::World> world;
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

struct FlightHooks {
  std::function<void(const FlightProgress&)> progress;  ///< About ten times a second of wall time.
  std::function<void(const common::Event&)> event;
  WebLink* web = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< Ends the flight from outside.
  /// At the end, before the run's last files are written: adds to them what a scorer finds.
  std::function<void(const evaluation::FlightRecord&, const simulation::SimulatedVehicle&, interfaces::FlightEnd&)>
      score;
};

struct FlightResult {
  interfaces::FlightSummary summary;
  std::filesystem::path folder;
  std::optional<std::string> write_failure;
};

/// Flies it to its end. Throws common::InputError for a world or folder that cannot be used, before anything moves.
/// Flights may run in several threads at once, each with a folder of its own.
FlightResult flySimulated(const FlightSetup& setup, behaviors::Mission mission, const FlightHooks& hooks);

/// "2026-11-21_14-03-55", local time.
std::string startedNow();

}  // namespace swiftlet::apps
