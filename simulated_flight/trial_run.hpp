// A run of trials: everything that they need is found and checked, then all are flown, and their results lie in one
// folder.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/registry.hpp"
#include "common/error.hpp"
#include "evaluation/flight_score.hpp"
#include "evaluation/trial.hpp"
#include "evaluation/trial_results.hpp"
#include "flight/vehicle_memory_file.hpp"
#include "simulated_flight/placed_map.hpp"
#include "simulated_flight/simulated_setup.hpp"

namespace swiftlet::simulated_flight {

/// How trials are flown; what is empty, as they say themselves.
struct TrialRunOptions {
  std::string trials;                                      ///< A file, or a folder of them.
  behaviors::NodeTypes types = behaviors::missionNodes();  ///< Of the missions.
  std::optional<int> repeat;                               ///< Flights of each trial.
  int jobs = 1;                                            ///< Flights at the same time.
  std::optional<int> seed;                                 ///< Of the first flight.
  std::string system = {};
  std::string nature = {};
  std::optional<double> battery = std::nullopt;  ///< Charge at the start, as a share of the full one.
  std::string vehicle_memory = {};               ///< Empty: each flight starts from the data sheet.
  bool control_log = false;
  bool record_rgbd = false;
  bool allow_incomplete_world = false;
  std::string out = {};  ///< Empty: a new folder, runs/TIME-trial.
};

/// Who hears of the flights, from their threads.
struct TrialRunHooks {
  const std::atomic<bool>& stop;
  std::function<void(const std::vector<common::Problem>&)> notes;  ///< What is odd about the map of a trial.
  /// A flight, as "levels seed 3", has been in the air for this long in simulated time.
  std::function<void(const std::string& flight, double simulated_s)> flies;
  /// A flight is over: a score for each vehicle.
  std::function<void(const evaluation::TrialConfig&, const std::vector<evaluation::FlightScore>&)> over;
};

class TrialRun {
 public:
  /// Reads the trials and makes the folder: a mistake in the last trial is found before the first flight. Throws
  /// common::InputError.
  explicit TrialRun(TrialRunOptions options);

  /// One for each condition that is flown, with their files found.
  const std::vector<evaluation::TrialConfig>& trials() const { return trials_; }
  int flights() const;
  const std::filesystem::path& folder() const { return out_; }

  /// Flies them; results.json and report.html are written after each trial. What keeps a flight from beginning is
  /// thrown once the files have what was flown.
  void fly(const TrialRunHooks& hooks);
  const evaluation::TrialResults& results() const { return results_; }

 private:
  struct Seeds {
    int first = 1, count = 1;
  };
  Seeds seedsOf(const evaluation::TrialConfig& trial) const;
  std::filesystem::path runFolder(const evaluation::TrialConfig& trial, int seed) const;
  void readTrials();
  void readMemory();
  void flyAll(const evaluation::TrialConfig& trial, const TrialRunHooks& hooks, evaluation::TrialResult& result) const;
  std::vector<evaluation::FlightScore> flyOne(const evaluation::TrialConfig& trial, const PlacedMap& map, int seed,
                                              const TrialRunHooks& hooks) const;
  bool anyFlown() const;
  void writeResults() const;

  TrialRunOptions options_;
  std::vector<evaluation::TrialConfig> trials_;
  flight::VehicleMemorySetup memory_;
  std::filesystem::path out_;
  evaluation::TrialResults results_;
};

}  // namespace swiftlet::simulated_flight
