// swiftlet trial: scripted flights with pass criteria.
#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/core.h>

#include "apps/build_version.hpp"
#include "apps/command.hpp"
#include "apps/envelope.hpp"
#include "apps/files_of_kind.hpp"
#include "apps/flight.hpp"
#include "apps/flights_in_parallel.hpp"
#include "apps/leaf_libraries.hpp"
#include "apps/required.hpp"
#include "apps/show.hpp"
#include "apps/stop_signals.hpp"
#include "apps/trial_flight.hpp"
#include "apps/trial_progress.hpp"
#include "common/error.hpp"
#include "common/table.hpp"
#include "evaluation/trial.hpp"
#include "evaluation/trial_results.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/report/report.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::TrialConfig;
using evaluation::TrialResult;
using evaluation::TrialResults;

struct TrialOptions {
  std::string trials;
  std::vector<std::string> leaves;
  std::optional<int> repeat;  ///< Flights of each trial; nullopt: from the trial.
  int jobs = 1;
  std::optional<int> seed;  ///< Of the first flight; nullopt: from the trial.
  std::string system;
  std::string nature;  ///< Empty: those of the trial.
  bool control_log = false;
  bool record_rgbd = false;
  bool allow_incomplete_world = false;
  std::string vehicle_memory;     ///< Empty: each flight starts from the data sheet.
  std::optional<double> battery;  ///< nullopt: from the trial.
  std::string out;
  bool json = false;
  bool envelope = false;
  std::string quantities;  ///< Empty: those of EnvelopeOptions.
  std::string only;
  std::string write;
};

void refuseIf(bool given, const char* option, const char* message) {
  if (given) throw common::InputError(common::Problem{{}, option, message, ""});
}

EnvelopeOptions envelopeOptions(const TrialOptions& options) {
  constexpr const char* kPinned = "does not go with --envelope, which pins the plant";
  constexpr const char* kNotKept =
      "does not go with --envelope, which keeps only the runs that fail, for their reports";
  refuseIf(options.battery.has_value(), "--battery", kPinned);
  refuseIf(!options.nature.empty(), "--nature", kPinned);
  refuseIf(!options.vehicle_memory.empty(), "--vehicle-memory",
           "does not go with --envelope, which starts from the data sheet");
  refuseIf(options.control_log, "--control-log", kNotKept);
  refuseIf(options.record_rgbd, "--record-rgbd", kNotKept);
  EnvelopeOptions envelope{.trial = options.trials,
                           .types = nodesWith(options.leaves),
                           .only = options.only,
                           .repeat = options.repeat,
                           .seed = options.seed,
                           .jobs = options.jobs,
                           .system = options.system,
                           .out = options.out,
                           .write = options.write,
                           .json = options.json};
  if (!options.quantities.empty()) envelope.quantities = options.quantities;
  return envelope;
}

std::string flightLine(const TrialConfig& trial, const evaluation::FlightScore& score) {
  const std::string vehicle = score.vehicle.empty() ? "" : fmt::format("{:<10} ", score.vehicle);
  std::string line = fmt::format("{:<24} seed {:<4} {}{:<8} {:6.1f} s {:5.1f} x", trial.name, score.seed, vehicle,
                                 score.passed() ? "passed" : "FAILED", score.figure("mission_time_s").value_or(0.0),
                                 score.figure("realtime_factor").value_or(0.0));
  for (const std::string& failure : score.failures) line += "\n    " + failure;
  if (!score.passed() && score.failures.empty()) line += "\n    " + score.collisionText();
  if (!score.coverage_problem.empty() && !trial.criteria.asksFor("coverage"))
    line += "\n    no coverage: " + score.coverage_problem;
  return line;
}

struct Seeds {
  int first = 1, count = 1;
};

Seeds seedsOf(const TrialConfig& trial, const TrialOptions& options) {
  return {options.seed.value_or(trial.scenario.seed), options.repeat.value_or(trial.repeat)};
}

fs::path runFolder(const TrialConfig& trial, int seed, const fs::path& out) {
  return out / fmt::format("{}-{:03}", trial.name, seed);
}

/// All flights of one trial, `jobs` at a time; the results are in the order of the seeds. A flight that cannot
/// begin ends the trial, and its exception is thrown once `result` has the others.
void flyAll(const TrialConfig& trial, const TrialOptions& options, const behaviors::NodeTypes& types,
            const VehicleMemorySetup& memory, const fs::path& out, const std::atomic<bool>& stop,
            TrialProgress& progress, TrialResult& result) {
  const auto [first_seed, count] = seedsOf(trial, options);
  const std::shared_ptr<const FlightMap> map = givenMap(trial, out);
  std::vector<std::vector<evaluation::FlightScore>> scores(static_cast<std::size_t>(count));
  std::mutex mutex;
  const auto fly = [&, first = first_seed](int i) {
    const int seed = first + i;
    const auto tell = [&, name = fmt::format("{} seed {}", trial.name, seed)](const FlightProgress& flight) {
      progress.flies(name, flight.simulated_s);
    };
    auto flown = flyOne(trial, map, seed, runFolder(trial, seed, out), stop,
                        {types, memory, options.control_log, options.record_rgbd, tell});
    std::string lines;
    for (const evaluation::FlightScore& score : flown) lines += flightLine(trial, score) + "\n";
    progress.over(lines, std::all_of(flown.begin(), flown.end(), [](const auto& score) { return score.passed(); }));
    const std::scoped_lock lock(mutex);
    scores[static_cast<std::size_t>(i)] = std::move(flown);
  };
  const auto collect = [&] {
    for (auto& flown : scores) std::move(flown.begin(), flown.end(), std::back_inserter(result.flights));
  };
  try {
    flyInParallel(count, options.jobs, stop, fly);
  } catch (...) {
    collect();
    throw;
  }
  collect();
}

interfaces::TrialReport reportOf(const TrialResults& results) {
  interfaces::TrialReport report;
  report.version = buildVersion();
  report.title = "Swiftlet trials";
  report.subtitle = startedNow();
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

void writeResults(const TrialResults& results, const fs::path& out) {
  for (const auto& [name, text] : {std::pair{"results.json", toJson(results)},
                                   std::pair{"report.html", interfaces::trialReport(reportOf(results))}})
    required(interfaces::writeAtomically(out / name, text));
}

/// Runs of the same name would lie in the same folders.
void refuseSameNames(const std::vector<TrialConfig>& trials, const fs::path& file_or_folder) {
  std::set<std::string> names;
  for (const TrialConfig& trial : trials)
    if (!names.insert(trial.name).second)
      throw common::InputError(common::Problem{{file_or_folder.string()},
                                               "",
                                               fmt::format("two conditions to fly in are named `{}`", trial.name),
                                               "name each of systems, natures and batteries once"});
}

/// The trials to be flown, read and checked, with missions that suit their systems: a mistake in the last trial
/// is reported before the first flight.
std::vector<TrialConfig> preparedTrials(const TrialOptions& options, const tree::Registry& types) {
  const fs::path file_or_folder = findTrial(options.trials);
  std::vector<TrialConfig> trials;
  for (TrialConfig& trial : evaluation::readTrials(file_or_folder)) {
    if (!options.nature.empty()) trial.natures = {options.nature};
    if (options.battery) trial.batteries = {*options.battery};
    if (!options.system.empty()) trial.setSystem(options.system);
    trial.scenario.allow_incomplete_world |= options.allow_incomplete_world;
    for (TrialConfig& one : trial.byCondition()) trials.push_back(std::move(one));
  }
  refuseSameNames(trials, file_or_folder);
  prepare(trials, types);
  for (const std::string& warning : warningsOfOperator(trials, types)) showError(warning);
  for (const TrialConfig& trial : trials) {
    const Seeds seeds = seedsOf(trial, options);
    checkSeeds(seeds.first, seeds.count);
    if (options.record_rgbd) requireCamera(loadSystem(trial.system));
  }
  for (TrialConfig& trial : trials)
    trial.scenario.nature = std::make_shared<const simulation::Nature>(simulation::Nature::load(trial.natures.front()));
  return trials;
}

/// The memory that every flight starts from; it must belong to the vehicle of every trial.
VehicleMemorySetup memoryFor(const std::vector<TrialConfig>& trials, const TrialOptions& options) {
  VehicleMemorySetup memory;
  if (options.vehicle_memory.empty()) return memory;
  for (const TrialConfig& trial : trials)
    memory = setupOfMemory(options.vehicle_memory, loadSystem(trial.system).vehicle, trial.scenario.vehicles.size(),
                           MemoryUse::kRead);
  return memory;
}

/// Throws if a run could not be written, before the results of an older trial are removed.
void checkRunFolders(const std::vector<TrialConfig>& trials, const TrialOptions& options, const fs::path& out) {
  for (const TrialConfig& trial : trials) {
    const Seeds seeds = seedsOf(trial, options);
    for (int i = 0; i < seeds.count; ++i) checkFlightFolder(runFolder(trial, seeds.first + i, out), trial.scenario);
  }
}

bool anyFlown(const TrialResults& results) {
  return std::any_of(results.trials.begin(), results.trials.end(),
                     [](const TrialResult& trial) { return !trial.flights.empty(); });
}

int trial(const TrialOptions& options) {
  const std::atomic<bool>& stop = stopOnSignals().first;
  outliveReaders();
  const behaviors::NodeTypes types = nodesWith(options.leaves);
  const std::vector<TrialConfig> trials = preparedTrials(options, *types);
  const VehicleMemorySetup memory = memoryFor(trials, options);
  const fs::path out = trialFolder(options.out, "trial", kTrialResults);
  checkRunFolders(trials, options, out);
  clearOfOlderResults(out, kTrialResults);
  TrialResults results;
  results.version = buildVersion();
  int flights = 0;
  for (const TrialConfig& trial : trials) flights += seedsOf(trial, options).count;
  TrialProgress progress(flights, options.json);
  for (const TrialConfig& trial : trials) {
    if (stop) break;
    results.trials.push_back({trial.name, trial.system, trial.paper, {}, trial.criteria, trial.figureBounds()});
    try {
      flyAll(trial, options, types, memory, out, stop, progress, results.trials.back());
    } catch (...) {
      progress.close();
      if (anyFlown(results)) writeResults(results, out);
      throw;
    }
    writeResults(results, out);
  }
  progress.close();
  if (options.json) {
    showJson(toJson(results));
  } else {
    show(fmt::format("\n{}\n", toText(summaryTable(results))));
    for (const TrialResult& trial : results.trials)
      for (const std::string& failure : trial.missed()) show(fmt::format("{}, all flights: {}\n", trial.name, failure));
    show(fmt::format("results {}\nreport  {}\n", (out / "results.json").string(), (out / "report.html").string()));
  }
  return results.passed() && !stop ? kDone : kFailed;
}

}  // namespace

void addTrial(Command& program) {
  auto options = std::make_shared<TrialOptions>();
  Command command = program.command("trial", "Fly scripted trials and score them against the truth.");
  command.argument("trial", options->trials, "Trial file (YAML), or a folder of them.");
  addLeavesOption(command, options->leaves);
  command.option("--repeat", options->repeat, {1, 10'000},
                 "Flights of each trial, seeds S, S+1, ...; default: what it says.");
  command.option("--jobs", options->jobs, {1, 64}, "Flights at the same time.");
  command.option("--seed", options->seed, {0, kGreatestSeed},
                 "The first seed S; default: the trial's scenario.seed, or 1.");
  command.option("--system", options->system, "Profile to fly them all with, instead of their own.");
  command.option("--vehicle-memory", options->vehicle_memory,
                 "File with what earlier flights learned of the vehicle: each flight starts from it, none writes it.");
  command.flag("--control-log", options->control_log,
               "Keep commands, motion and battery at 100 Hz in each run: what `identify` reads.");
  command.flag("--record-rgbd", options->record_rgbd,
               "Keep the frames of the RGB-D camera in the run, as a folder that `map3d` reads.");
  command.option("--nature", options->nature, "Nature to fly them all in, instead of their own.");
  command.option("--battery", options->battery, {0.01, 1},
                 "Charge at the start to fly them all with, as a share of the full one.");
  command.flag("--allow-incomplete-world", options->allow_incomplete_world,
               "Fly though models, meshes or collisions of a world are missing: the vehicle meets nothing there.");
  command.option("--out", options->out, "Folder of the results; default runs/<time>-trial.");
  command.flag("--json", options->json, "Print the results as JSON, nothing else.");
  command.flag("--envelope", options->envelope,
               "Turn up each quantity of the plant alone until flights fail; --repeat is then flights at each value.");
  command.option(
      "--quantities", options->quantities,
      fmt::format("With --envelope: what is turned up, and how far. Default: {}.", EnvelopeOptions().quantities));
  command.option("--only", options->only, "With --envelope: keys of the quantities to turn up, separated by commas.");
  command.option("--write", options->write, "With --envelope: page (Markdown) that gets the table and the picture.");
  command.footer(
      "Example: swiftlet trial trials/papers/unb_case1.yaml --system swiftlet --repeat 20\n"
      "Example: swiftlet trial trials/papers/unb_case1.yaml --system swiftlet --envelope --jobs 2");
  command.runs([options] {
    if (options->envelope) return flyEnvelope(envelopeOptions(*options));
    constexpr const char* kOnlyThere = "goes only with --envelope";
    refuseIf(!options->quantities.empty(), "--quantities", kOnlyThere);
    refuseIf(!options->only.empty(), "--only", kOnlyThere);
    refuseIf(!options->write.empty(), "--write", kOnlyThere);
    return trial(*options);
  });
}

}  // namespace swiftlet::apps
