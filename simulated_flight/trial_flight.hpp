// The flights of trials: what must be found before the first, one flight with its scores, and the folder of the
// results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "behaviors/registry.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/trial.hpp"
#include "simulated_flight/placed_map.hpp"
#include "simulated_flight/simulated_setup.hpp"

namespace swiftlet::simulated_flight {

/// Finds the maps and the worlds of trials, and checks their missions for the systems that fly them. Throws
/// common::InputError with the problems of all missions.
void prepare(std::vector<evaluation::TrialConfig>& trials, const tree::Registry& types = behaviors::missionRegistry());

/// The map that the flights of a trial are given. One that a robot makes first lies in `out`.
PlacedMap givenMap(const evaluation::TrialConfig& trial, const std::filesystem::path& out);

/// A flight of a prepared trial, whose run lies in `folder`.
SimulatedSetup setupOf(const evaluation::TrialConfig& trial, const PlacedMap& map, int seed,
                       const std::filesystem::path& folder);

/// Flies it and returns a score for each vehicle. FlightScore::folder is relative to the folder above that of the run.
/// Safe from several threads. Throws common::InputError if the run cannot be written.
std::vector<evaluation::FlightScore> flyScored(const evaluation::TrialConfig& trial, const SimulatedSetup& setup,
                                               SimulatedHooks hooks);

/// How older results of the same command are recognized.
struct TrialResultsProof {
  std::string file;  ///< "results.json"
  std::string text;  ///< Text near the beginning of that file.
};

inline const TrialResultsProof kTrialResults{"results.json", "\"trials\""};

/// Makes the folder for results: `given`, or if that is empty a new one, runs/TIME-NOUN. Throws common::InputError if
/// the folder holds results of something else.
std::filesystem::path trialFolder(const std::string& given, const std::string& noun, const TrialResultsProof& proof);

/// Removes the results and the report that another trial left in a folder of trialFolder(): they would look like this
/// one's until its last flight. Call it once no problem keeps the flights on the ground.
void clearOfOlderResults(const std::filesystem::path& out, const TrialResultsProof& proof);

/// Throws common::InputError if the seeds of this many flights would go beyond simulation::kGreatestSeed.
void checkSeeds(int first, int count);

}  // namespace swiftlet::simulated_flight
