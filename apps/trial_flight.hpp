// The flights of trials: what must be found before the first, one flight with its scores, and the folder of the
// results.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/flight_setup.hpp"
#include "apps/given_map.hpp"
#include "apps/vehicle_memory_file.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/trial.hpp"

namespace swiftlet::apps {

/// Finds the maps and the worlds of trials, and checks their missions for the systems that fly them. Throws
/// common::InputError with the problems of all missions.
void prepare(std::vector<evaluation::TrialConfig>& trials, const tree::Registry& types = behaviors::missionRegistry());

/// Warnings of missions that wait for an operator, in trials whose script does not answer: a line each.
std::vector<std::string> warningsOfOperator(const std::vector<evaluation::TrialConfig>& trials,
                                            const tree::Registry& types);

/// The map that the flights of a trial are given; null without a given map. A map that a robot makes first lies in
/// `out`.
std::shared_ptr<const FlightMap> givenMap(const evaluation::TrialConfig& trial, const std::filesystem::path& out);

/// What the flights of a trial have beyond it.
struct FlightExtras {
  behaviors::NodeTypes types = behaviors::missionNodes();  ///< Of the missions.
  VehicleMemorySetup memory = {};
  bool control_log = false;                                  ///< Whether the runs keep control.tsv.
  bool record_rgbd = false;                                  ///< Whether the runs keep the frames of the RGB-D camera.
  std::function<void(const FlightProgress&)> progress = {};  ///< See FlightHooks.
};

/// Flies a prepared trial once and returns a score for each vehicle. The run lies in `folder`, and FlightScore::folder
/// is relative to the folder above it. Safe from several threads. Throws common::InputError if the run cannot be
/// written.
std::vector<evaluation::FlightScore> flyOne(const evaluation::TrialConfig& trial,
                                            const std::shared_ptr<const FlightMap>& map, int seed,
                                            const std::filesystem::path& folder, const std::atomic<bool>& stop,
                                            const FlightExtras& extras = {});

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

/// Throws common::InputError if the seeds of this many flights would go beyond kGreatestSeed.
void checkSeeds(int first, int count);

}  // namespace swiftlet::apps
