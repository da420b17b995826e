#include "simulated_flight/trial_run.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "common/table.hpp"
#include "flight/build_version.hpp"
#include "flight/files_of_kind.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/report/report.hpp"
#include "simulated_flight/flight.hpp"
#include "simulated_flight/flights_in_parallel.hpp"
#include "simulated_flight/trial_flight.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::simulated_flight {
namespace {

namespace fs = std::filesystem;
using evaluation::FlightScore;
using evaluation::TrialConfig;
using evaluation::TrialResult;

interfaces::TrialReport reportOf(const evaluation::TrialResults& results) {
  interfaces::TrialReport report;
  report.version = results.version;
  report.title = "Swiftlet trials";
  report.subtitle = flight::startedNow();
  report.passed = results.passed();
  report.tables.push_back(summaryTable(results));
  report.tables.push_back(failureTable(results));
  for (const TrialResult& trial : results.trials) {
    report.tables.push_back(flightTable(trial));
    report.tables.push_back(conductTable(trial));
    if (common::Table phases = phaseTable(trial); !phases.rows.empty()) report.tables.push_back(std::move(phases));
    for (const auto& flight : trial.flights)
      report.pictures.push_back({fmt::format("{} seed {} {}", trial.name, flight.seed, flight.vehicle),
                                 flight.folder + "/map.png", flight.folder + "/report.html", flight.passed()});
  }
  return report;
}

/// Runs of the same name would lie in the same folders.
void refuseSameNames(const std::vector<TrialConfig>& trials, const fs::path& file_or_folder) {
  std::set<std::string> names;
  for (const TrialConfig& trial : trials)
    if (!names.insert(trial.name).second)
      throw common::InputError(
          {file_or_folder.string()}, "",
          common::Message("trial.conditions-alike", "two conditions to fly in are named `{}`", trial.name),
          "name each of systems, natures and batteries once");
}

}  // namespace

TrialRun::TrialRun(TrialRunOptions options) : options_(std::move(options)) {
  readTrials();
  readMemory();
  out_ = trialFolder(options_.out, "trial", kTrialResults);
  for (const TrialConfig& trial : trials_) {
    const Seeds seeds = seedsOf(trial);
    for (int i = 0; i < seeds.count; ++i) checkFlightFolder(runFolder(trial, seeds.first + i), trial.scenario);
  }
  results_.version = flight::buildVersion();
}

void TrialRun::readTrials() {
  const fs::path file_or_folder = flight::findTrial(options_.trials);
  for (TrialConfig& trial : evaluation::readTrials(file_or_folder)) {
    if (!options_.nature.empty()) trial.natures = {options_.nature};
    if (options_.battery) trial.batteries = {*options_.battery};
    if (!options_.system.empty()) trial.setSystem(options_.system);
    trial.scenario.allow_incomplete_world |= options_.allow_incomplete_world;
    for (TrialConfig& one : trial.byCondition()) trials_.push_back(std::move(one));
  }
  refuseSameNames(trials_, file_or_folder);
  prepare(trials_, *options_.types);
  for (const TrialConfig& trial : trials_) {
    const Seeds seeds = seedsOf(trial);
    checkSeeds(seeds.first, seeds.count);
    if (options_.record_rgbd) flight::requireCamera(flight::loadSystem(trial.system));
  }
  for (TrialConfig& trial : trials_)
    trial.scenario.nature = std::make_shared<const simulation::Nature>(simulation::Nature::load(trial.natures.front()));
}

/// Every flight starts from it; it must belong to the vehicle of every trial.
void TrialRun::readMemory() {
  if (options_.vehicle_memory.empty()) return;
  for (const TrialConfig& trial : trials_)
    memory_ = flight::setupOfMemory(options_.vehicle_memory, flight::loadSystem(trial.system).vehicle,
                                    trial.scenario.vehicles.size(), flight::MemoryUse::kRead);
}

TrialRun::Seeds TrialRun::seedsOf(const TrialConfig& trial) const {
  return {options_.seed.value_or(trial.scenario.seed), options_.repeat.value_or(trial.repeat)};
}

int TrialRun::flights() const {
  int count = 0;
  for (const TrialConfig& trial : trials_) count += seedsOf(trial).count;
  return count;
}

fs::path TrialRun::runFolder(const TrialConfig& trial, int seed) const {
  return out_ / fmt::format("{}-{:03}", trial.name, seed);
}

void TrialRun::fly(const TrialRunHooks& hooks) {
  clearOfOlderResults(out_, kTrialResults);
  for (const TrialConfig& trial : trials_) {
    if (hooks.stop) break;
    results_.trials.push_back({trial.name, trial.system, trial.paper, {}, trial.criteria, trial.figureBounds()});
    try {
      flyAll(trial, hooks, results_.trials.back());
    } catch (...) {
      if (anyFlown()) writeResults();
      throw;
    }
    writeResults();
  }
}

/// All flights of one trial, some at a time; the results are in the order of the seeds. A flight that cannot begin ends
/// the trial, and its exception is thrown once `result` has the others.
void TrialRun::flyAll(const TrialConfig& trial, const TrialRunHooks& hooks, TrialResult& result) const {
  const Seeds seeds = seedsOf(trial);
  const PlacedMap map = givenMap(trial, out_);
  if (map.map) hooks.notes(map.map->notes);
  std::vector<std::vector<FlightScore>> scores(static_cast<std::size_t>(seeds.count));
  const auto collect = [&] {
    for (auto& flown : scores) std::move(flown.begin(), flown.end(), std::back_inserter(result.flights));
  };
  try {
    flyInParallel(seeds.count, options_.jobs, hooks.stop,
                  [&](int i) { scores[static_cast<std::size_t>(i)] = flyOne(trial, map, seeds.first + i, hooks); });
  } catch (...) {
    collect();
    throw;
  }
  collect();
}

std::vector<FlightScore> TrialRun::flyOne(const TrialConfig& trial, const PlacedMap& map, int seed,
                                          const TrialRunHooks& hooks) const {
  SimulatedSetup setup = setupOf(trial, map, seed, runFolder(trial, seed));
  setup.types = options_.types;
  setup.memory = memory_;
  setup.control_log = options_.control_log;
  setup.record_rgbd = options_.record_rgbd;
  SimulatedHooks flight_hooks;
  flight_hooks.stop = &hooks.stop;
  flight_hooks.progress = [&, name = fmt::format("{} seed {}", trial.name, seed)](const FlightProgress& progress) {
    hooks.flies(name, progress.simulated_s);
  };
  std::vector<FlightScore> flown = flyScored(trial, setup, std::move(flight_hooks));
  hooks.over(trial, flown);
  return flown;
}

bool TrialRun::anyFlown() const {
  return std::any_of(results_.trials.begin(), results_.trials.end(),
                     [](const TrialResult& trial) { return !trial.flights.empty(); });
}

void TrialRun::writeResults() const {
  for (const auto& [name, text] : {std::pair{"results.json", toJson(results_)},
                                   std::pair{"report.html", interfaces::trialReport(reportOf(results_))}})
    required(interfaces::writeAtomically(out_ / name, text));
}

}  // namespace swiftlet::simulated_flight
