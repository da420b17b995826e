#include "apps/envelope.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/command_line.hpp"
#include "apps/envelope_page.hpp"
#include "apps/progress_line.hpp"
#include "apps/show.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "evaluation/envelope_results.hpp"
#include "flight/build_version.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/stop_signals.hpp"
#include "flight/wall_clock.hpp"
#include "interfaces/files/required.hpp"
#include "simulated_flight/flight.hpp"
#include "simulated_flight/flights_in_parallel.hpp"
#include "simulated_flight/trial_flight.hpp"
#include "simulation/plant_keys.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::EnvelopeEntry;
using evaluation::EnvelopeFinding;
using evaluation::EnvelopeFlight;
using evaluation::EnvelopeStep;
using evaluation::TrialConfig;

/// Keeps the quantities with one of the keys. An unknown key is a mistake.
void keepOnly(const std::string& keys, evaluation::EnvelopeConfig& config) {
  std::vector<std::string> known, wanted;
  for (const auto& quantity : config.quantities) known.push_back(quantity.key);
  for (std::size_t begin = 0; begin <= keys.size();) {
    const std::size_t end = std::min(keys.find(',', begin), keys.size());
    wanted.push_back(keys.substr(begin, end - begin));
    begin = end + 1;
    if (std::find(known.begin(), known.end(), wanted.back()) == known.end())
      throw common::InputError(
          {}, "--only", common::Message("envelope.no-such-quantity", "no quantity has the key `{}`", wanted.back()),
          common::didYouMean(wanted.back(), known));
  }
  std::erase_if(config.quantities, [&wanted](const auto& quantity) {
    return std::find(wanted.begin(), wanted.end(), quantity.key) == wanted.end();
  });
}

/// The one condition of the trial that is flown. The envelope's base replaces its natures.
TrialConfig onlyCondition(TrialConfig trial, const EnvelopeOptions& options, const fs::path& file) {
  const auto refused = [&](const char* element, const common::Message& message, const char* hint) {
    return common::InputError({file.string()}, element, message, hint);
  };
  if (trial.each_fault)
    throw refused("each_fault",
                  common::Message("envelope.one-condition", "does not go with --envelope, which flies one condition"),
                  "leave it out");
  if (!trial.batteries.empty())
    throw refused("batteries",
                  common::Message("envelope.pins-plant", "does not go with --envelope, which pins the plant"),
                  "leave it out");
  if (!options.system.empty()) trial.setSystem(options.system);
  if (trial.systems.size() > 1)
    throw refused("systems",
                  common::Message("envelope.several-systems", "names several: {}", fmt::join(trial.systems, ", ")),
                  "give --system");
  trial.natures.resize(1);
  return trial.byCondition().front();
}

/// The trial with everything pinned, ready to be flown.
TrialConfig pinnedTrial(const EnvelopeOptions& options, const simulation::Nature& base) {
  const fs::path file = flight::findTrial(options.trial);
  if (fs::is_directory(file))
    throw common::InputError({file.string()}, "--envelope",
                             common::Message("file.is-folder", "is a folder, a file was expected"),
                             "give the file of one trial");
  std::vector<TrialConfig> trials = {onlyCondition(evaluation::readTrial(file), options, file)};
  simulated_flight::prepare(trials, *options.types);
  TrialConfig trial = std::move(trials.front());
  trial.scenario = evaluation::pinned(trial.scenario, base);
  return trial;
}

evaluation::EnvelopeResults emptyResults(const EnvelopeOptions& options, evaluation::EnvelopeConfig config,
                                         const TrialConfig& trial) {
  const simulation::Nature real = simulation::Nature::load("real"), harsh = simulation::Nature::load("harsh");
  evaluation::EnvelopeResults results;
  results.trial = trial.name;
  results.system = trial.system;
  results.mission = trial.mission;
  results.version = toString(flight::buildVersion());
  results.first_seed = options.seed.value_or(trial.scenario.seed);
  for (const auto& quantity : config.quantities) {
    EnvelopeEntry& entry = results.entries.emplace_back();
    entry.finding.quantity = quantity;
    entry.finding.from = baseValue(quantity, trial.scenario);
    entry.real = real.rangeOf(quantity.key);
    entry.harsh = harsh.rangeOf(quantity.key);
  }
  results.config = std::move(config);
  return results;
}

fs::path baseFolder(const fs::path& out, int seed) { return out / "base" / fmt::format("{}", seed); }

/// Flies an envelope. Each thread takes one quantity after the other, so that the values of a quantity, of which each
/// depends on those before it, are the same however many threads there are.
class EnvelopeRun {
 public:
  EnvelopeRun(TrialConfig trial, evaluation::EnvelopeResults results, fs::path out, const EnvelopeOptions& options,
              const std::atomic<bool>& stop)
      : trial_(std::move(trial)),
        results_(std::move(results)),
        out_(std::move(out)),
        started_(flight::startedNow()),
        options_(options),
        stop_(stop),
        progress_(options.json),
        map_(simulated_flight::givenMap(trial_, out_)) {}

  /// What keeps a flight from being flown at all ends the search, and is thrown once the files have what was flown.
  void run() {
    if (map_.map) showNotes(map_.map->notes);
    std::exception_ptr failure;
    try {
      search();
    } catch (...) {
      failure = std::current_exception();
      collectBase();
    }
    progress_.close();
    write();
    removeEmptyFolders();
    if (failure) std::rethrow_exception(failure);
  }

  const evaluation::EnvelopeResults& results() const { return results_; }

 private:
  void search() {
    const auto fly = [&](int count, auto&& work) {
      simulated_flight::flyInParallel(count, options_.jobs, stop_, work);
    };
    fly(results_.config.seeds, [this](int i) { flyBase(i); });
    collectBase();
    for (EnvelopeEntry& entry : results_.entries) entry.finding.steps = {at(entry.finding.from)};
    if (!results_.base.acceptable() || stop_) return;
    fly(static_cast<int>(results_.entries.size()),
        [this](int i) { search(results_.entries[static_cast<std::size_t>(i)].finding); });
  }

  void collectBase() {
    for (auto& flown : std::exchange(base_, {}))
      if (flown) results_.base.flights.push_back(std::move(*flown));
  }

  EnvelopeStep at(double value) const { return {value, results_.base.flights}; }

  /// nullopt if it was stopped from outside.
  std::optional<EnvelopeFlight> fly(const TrialConfig& trial, int seed, const fs::path& folder) const {
    simulated_flight::SimulatedSetup setup = simulated_flight::setupOf(trial, map_, seed, folder);
    setup.types = options_.types;
    simulated_flight::SimulatedHooks hooks;
    hooks.stop = &stop_;
    EnvelopeFlight flight = envelopeFlight(simulated_flight::flyScored(trial, setup, std::move(hooks)));
    const bool stopped = stop_, kept = !stopped && !flight.acceptable;
    flight.folder = kept ? folder.lexically_relative(out_).string() : "";
    if (!kept) fs::remove_all(folder);  // Hundreds of them; they can be flown again.
    return stopped ? std::nullopt : std::optional(std::move(flight));
  }

  void flyBase(int number) {
    const int seed = results_.first_seed + number;
    auto flight = fly(trial_, seed, baseFolder(out_, seed));
    const std::scoped_lock lock(mutex_);
    base_.resize(static_cast<std::size_t>(results_.config.seeds));
    base_[static_cast<std::size_t>(number)] = std::move(flight);
    ++flown_;
    progress_.update(fmt::format("base: {} of {} flights", flown_, results_.config.seeds),
                     flight::secondsSince(begin_));
  }

  void search(EnvelopeFinding& finding) {
    while (const auto value = nextValue(finding, results_.config)) {
      auto step = flyAt(finding.quantity.key, *value);
      const std::scoped_lock lock(mutex_);
      if (!step) return;
      finding.add(std::move(*step));
      writeJson();
    }
    const std::scoped_lock lock(mutex_);
    finding.complete = true;
    ++searched_;
    showFound(finding);
    write();
  }

  std::optional<EnvelopeStep> flyAt(const std::string& key, double value) {
    TrialConfig trial = trial_;
    setPlantKey(trial.scenario, key, value);
    EnvelopeStep step{value, {}};
    for (int i = 0; i < results_.config.seeds; ++i) {
      const int seed = results_.first_seed + i;
      const auto flight = fly(trial, seed, out_ / key / fmt::format("{:.6g}-{}", value, seed));
      if (!flight) return std::nullopt;
      step.flights.push_back(*flight);
      const std::scoped_lock lock(mutex_);
      ++flown_;
      progress_.update(fmt::format("{} of {} quantities, {} flights; {} at {}", searched_, results_.entries.size(),
                                   flown_, key, evaluation::shownValue(key, value)),
                       flight::secondsSince(begin_));
      if (!flight->acceptable) break;
    }
    return step;
  }

  void showFound(const EnvelopeFinding& finding) {
    if (options_.json) return;
    const EnvelopeStep* failing = finding.firstFailing();
    const auto shown = [&](double value) { return evaluation::shownValue(finding.quantity.key, value); };
    progress_.close();
    show(fmt::format("{:<30} acceptable to {:<11} {:<22} {}\n", finding.quantity.name,
                     shown(finding.acceptableTo().value_or(finding.from)),
                     failing != nullptr ? "fails at " + shown(failing->value) : "does not fail", endingText(finding)));
  }

  void removeEmptyFolders() const {
    std::error_code not_empty;
    fs::remove(out_ / "base", not_empty);
    for (const EnvelopeEntry& entry : results_.entries) fs::remove(out_ / entry.finding.quantity.key, not_empty);
  }

  void writeJson() const { required(interfaces::writeAtomically(out_ / "envelope.json", toJson(results_))); }

  void write() const {
    writeJson();
    required(interfaces::writeAtomically(out_ / "report.html", envelopeReport(results_, started_)));
  }

  TrialConfig trial_;
  evaluation::EnvelopeResults results_;
  fs::path out_;
  std::string started_;
  const EnvelopeOptions& options_;
  const std::atomic<bool>& stop_;
  ProgressLine progress_;
  simulated_flight::PlacedMap map_;
  const flight::Clock::time_point begin_ = flight::Clock::now();
  std::mutex mutex_;  ///< Of results and progress.
  std::vector<std::optional<EnvelopeFlight>> base_;
  int flown_ = 0;
  int searched_ = 0;
};

void showEnd(const evaluation::EnvelopeResults& results, const fs::path& out) {
  if (!results.base.acceptable())
    show("The base itself fails, so that nothing was turned up.\n" + toText(failedFlightTable(results)));
  else
    show(fmt::format("\n{}\n", toText(envelopeTable(results))));
  show(fmt::format("results {}\nreport  {}\n", (out / "envelope.json").string(), (out / "report.html").string()));
}

}  // namespace

int flyEnvelope(const EnvelopeOptions& options) {
  const std::atomic<bool>& stop = flight::stopOnSignals().first;
  outliveReaders();
  evaluation::EnvelopeConfig config = evaluation::readEnvelope(common::findData(options.quantities));
  if (!options.only.empty()) keepOnly(options.only, config);
  config.seeds = options.repeat.value_or(config.seeds);
  if (!options.write.empty()) checkPage(options.write, kEnvelopeMarks);
  TrialConfig trial = pinnedTrial(options, simulation::Nature::load(config.base));
  evaluation::EnvelopeResults results = emptyResults(options, std::move(config), trial);
  simulated_flight::checkSeeds(results.first_seed, results.config.seeds);
  const simulated_flight::TrialResultsProof proof{"envelope.json", "\"envelope\""};
  const fs::path out = simulated_flight::trialFolder(options.out, "envelope", proof);
  for (int i = 0; i < results.config.seeds; ++i)
    simulated_flight::checkFlightFolder(baseFolder(out, results.first_seed + i), trial.scenario);
  simulated_flight::clearOfOlderResults(out, proof);
  EnvelopeRun run(std::move(trial), std::move(results), out, options, stop);
  run.run();
  if (options.json)
    showJson(toJson(run.results()));
  else
    showEnd(run.results(), out);
  if (!options.write.empty() && run.results().base.acceptable()) writePage(options.write, run.results());
  return run.results().complete() ? kDone : kFailed;
}

}  // namespace swiftlet::apps
