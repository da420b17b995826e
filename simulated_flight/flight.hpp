// One simulated flight from the first tick to the last: the vehicles of the scenario side by side in one arena, each
// with its autonomy, its run folder and the scorer's recorder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulated_flight/simulated_setup.hpp"

namespace swiftlet::simulated_flight {

struct FlightResult {
  std::filesystem::path folder;  ///< The folder of the only vehicle, or the one that holds a folder for each.
  std::vector<flight::VehicleResult> vehicles;  ///< In the order of the scenario.

  bool done() const;  ///< Every vehicle's mission succeeded.
  std::optional<std::string> writeFailure() const;
};

/// The names of the scenario's vehicles; empty when one flies alone.
std::vector<std::string> vehicleNames(const simulation::Scenario& scenario);

/// The mission file of each vehicle of the scenario, in their order: its own, or else `otherwise`.
std::vector<std::string> missionFiles(const simulation::Scenario& scenario, const std::string& otherwise);

/// The mission of each vehicle of the scenario, read and checked. Throws common::InputError with all problems.
std::vector<flight::FlightMission> soundMissions(const SimulatedSetup& setup, bool has_map);

/// Throws common::InputError if the vehicles of a flight cannot write their runs to `folder`; changes nothing.
void checkFlightFolder(const std::filesystem::path& folder, const simulation::Scenario& scenario);

/// Flies it to the end of its last vehicle, with the missions of soundMissions(). Throws common::InputError for a world
/// or folder that cannot be used, before anything moves. Flights may run in several threads at once, each with a folder
/// of its own.
FlightResult flySimulated(const SimulatedSetup& setup, std::vector<flight::FlightMission> missions,
                          const SimulatedHooks& hooks);

}  // namespace swiftlet::simulated_flight
