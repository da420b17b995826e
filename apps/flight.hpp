// One simulated flight from the first tick to the last: each vehicle of the scenario and its autonomy in a FlightLoop,
// side by side in one arena, with the run folder, the page and the scorer's recorder beside it. Used by `fly` and by
// `trial`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/flight_setup.hpp"

namespace swiftlet::apps {

struct FlightResult {
  std::filesystem::path folder;         ///< The folder of the only vehicle, or the one that holds a folder for each.
  std::vector<VehicleResult> vehicles;  ///< In the order of the scenario.

  bool done() const;  ///< Every vehicle's mission succeeded.
  std::optional<std::string> writeFailure() const;
};

/// The names of the scenario's vehicles; empty when one flies alone.
std::vector<std::string> vehicleNames(const simulation::Scenario& scenario);

/// The mission of each vehicle of the scenario, read and checked. Throws common::InputError with all problems.
std::vector<FlightMission> soundMissions(const FlightSetup& setup, bool has_map);

/// Throws common::InputError if the vehicles of a flight cannot write their runs to `folder`; changes nothing.
void checkFlightFolder(const std::filesystem::path& folder, const simulation::Scenario& scenario);

/// Throws common::InputError if its vehicle has no camera for --record-rgbd.
void requireCamera(const System& system);

/// Flies it to the end of its last vehicle, with the missions of soundMissions(). Throws common::InputError for a world
/// or folder that cannot be used, before anything moves. Flights may run in several threads at once, each with a folder
/// of its own.
FlightResult flySimulated(const FlightSetup& setup, std::vector<FlightMission> missions, const FlightHooks& hooks);

/// "2026-11-21_14-03-55", local time.
std::string startedNow();

}  // namespace swiftlet::apps
