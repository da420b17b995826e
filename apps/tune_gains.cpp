#include "apps/tune_gains.hpp"

#include <atomic>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/core.h>

#include "apps/command_line.hpp"
#include "apps/output_file.hpp"
#include "apps/show.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "control/gains.hpp"
#include "control/identification/gain_search.hpp"
#include "evaluation/gain_cost.hpp"
#include "evaluation/trial.hpp"
#include "flight/stop_signals.hpp"
#include "flight/system.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "simulated_flight/flights_in_parallel.hpp"
#include "simulated_flight/trial_flight.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using control::Gain;
using evaluation::FlightScore;
using evaluation::TrialConfig;

/// The one trial to be flown, in one nature, with its files found.
TrialConfig trialToFly(const TuneGainsOptions& options) {
  const fs::path file = common::findData(options.trial);
  TrialConfig trial = evaluation::readTrial(file);
  trial.setSystem(options.system);
  if (!options.nature.empty()) trial.natures = {options.nature};
  std::vector<TrialConfig> conditions = trial.byCondition();
  if (conditions.size() != 1)
    throw common::InputError({file.string()}, "natures",
                             common::Message("tune.several-conditions", "has several conditions to fly in"),
                             "choose a nature with --nature");
  simulated_flight::prepare(conditions);
  TrialConfig one = conditions.front();
  if (one.phases.empty())
    throw common::InputError({file.string()}, "phases", common::Message("config.missing", "is missing"),
                             "gains are compared by phases that have criteria with a `max`");
  one.scenario.nature = std::make_shared<const simulation::Nature>(simulation::Nature::load(one.natures.front()));
  return one;
}

/// What marks a file as a tuned profile of ours.
constexpr const char* kProfileLine = "# Tuned by `swiftlet tune --gains`: a profile for --system.";

struct SearchStopped {};

/// Flies sets of gains, each with the same seeds. What a flight leaves is removed, the profiles stay.
class GainFlights {
 public:
  GainFlights(TrialConfig trial, flight::System system, const TuneGainsOptions& options, fs::path folder)
      : trial_(std::move(trial)), system_(std::move(system)), options_(options), folder_(std::move(folder)) {}

  flight::System systemWith(const std::vector<Gain>& gains) const {
    flight::System system = system_.namingSheetsByPath();
    system.config.autonomy.control = control::withGains(system.config.autonomy.control, gains);
    return system;
  }

  /// Throws SearchStopped if the user stops the flights.
  double cost(const std::vector<Gain>& gains) {
    const fs::path profile = folder_ / fmt::format("set-{:03}.yaml", ++sets_);
    const std::string yaml = systemWith(gains).toYaml(false);
    required(interfaces::writeAtomically(profile, yaml));
    const double cost = best_ && isRefused(profile) ? std::numeric_limits<double>::infinity() : flownCost(profile);
    required(interfaces::writeAtomically(profile, fmt::format("# cost {:.6g}\n{}", cost, yaml)));
    if (!best_ || cost < best_->after) best_ = control::GainSearch{gains, best_ ? best_->before : cost, cost, sets_};
    best_->evaluations = sets_;
    show(fmt::format("set {:3}  cost {:.4f}  best {:.4f}\n", sets_, cost, best_->after));
    return cost;
  }

  /// The best gains so far; nullopt before the first set has flown.
  const std::optional<control::GainSearch>& best() const { return best_; }

 private:
  /// A controller may have no solution for gains of the search, as LQR for weights of very different sizes.
  static bool isRefused(const fs::path& profile) {
    try {
      (void)flight::loadSystem(profile.string());
      return false;
    } catch (const common::InputError&) {
      return true;
    }
  }

  double flownCost(const fs::path& profile) {
    TrialConfig trial = trial_;
    trial.system = profile.string();
    return evaluation::gainCost(flown(trial));
  }

  std::vector<FlightScore> flown(const TrialConfig& trial) {
    const std::atomic<bool>& stop = flight::stopOnSignals().first;
    std::vector<std::vector<FlightScore>> scores(static_cast<std::size_t>(options_.seeds));
    simulated_flight::flyInParallel(options_.seeds, options_.jobs, stop, [&](int i) {
      const fs::path run = folder_ / fmt::format("run-{}", i);
      simulated_flight::SimulatedHooks hooks;
      hooks.stop = &stop;
      scores[static_cast<std::size_t>(i)] =
          simulated_flight::flyScored(trial, simulated_flight::setupOf(trial, {}, options_.seed + i, run), hooks);
      fs::remove_all(run);
    });
    if (stop) throw SearchStopped();
    std::vector<FlightScore> all;
    for (auto& of_one : scores) all.insert(all.end(), of_one.begin(), of_one.end());
    return all;
  }

  TrialConfig trial_;
  flight::System system_;
  const TuneGainsOptions& options_;
  fs::path folder_;
  int sets_ = 0;
  std::optional<control::GainSearch> best_;
};

std::vector<Gain> gainsToSearch(const flight::System& system, const std::string& only) {
  std::vector<Gain> gains;
  for (const Gain& gain : control::gainsOf(system.config.autonomy.control))
    if (gain.name.starts_with(only)) gains.push_back(gain);
  if (gains.empty())
    throw common::InputError({}, "--only",
                             common::Message("tune.no-such-gain", "no gain of {} begins with `{}`", system.name, only),
                             "see `swiftlet config`");
  return gains;
}

std::string comparison(const std::vector<Gain>& before, const std::vector<Gain>& after) {
  std::string text;
  for (std::size_t i = 0; i < before.size(); ++i)
    text += fmt::format("{:<28} {:8.4g} -> {:8.4g}\n", before[i].name, before[i].value, after[i].value);
  return text;
}

}  // namespace

int tuneGains(const TuneGainsOptions& options) {
  const flight::System system = flight::loadSystem(options.system);
  if (!options.out.empty()) requireWritable(options.out, "--out", kProfileLine);
  const std::vector<Gain> start = gainsToSearch(system, options.only);
  if (options.flights < 2 * options.seeds)
    throw common::InputError({}, "--flights",
                             common::Message("tune.too-few-flights", "is too few for two sets of gains"),
                             "each is flown with all --seeds");
  const TrialConfig trial = trialToFly(options);
  const fs::path folder = simulated_flight::trialFolder("", "tune", simulated_flight::kTrialResults);
  GainFlights flights(trial, system, options, folder);
  control::GainSearchOptions search_options;
  search_options.evaluations = options.flights / options.seeds;
  std::optional<control::GainSearch> found;
  try {
    found = control::searchGains(start, search_options,
                                 [&](const std::vector<Gain>& gains) { return flights.cost(gains); });
  } catch (const SearchStopped&) {
    show("stopped before the search was over\n");
  }
  const bool stopped = !found;
  if (stopped) found = flights.best();
  if (!found) return kFailed;
  const control::GainSearch& search = *found;
  show(fmt::format("\n{} of {}, {} sets of gains in {} flights, seeds {} to {}\ncost {:.4f} -> {:.4f}\n{}",
                   control::sectionOfGains(system.config.autonomy.control.controller.kind), system.name,
                   search.evaluations, search.evaluations * options.seeds, options.seed,
                   options.seed + options.seeds - 1, search.before, search.after, comparison(start, search.gains)));
  if (!options.out.empty()) {
    required(interfaces::writeAtomically(
        options.out, fmt::format("{}\n{}", kProfileLine, flights.systemWith(search.gains).toYaml(false))));
    show(fmt::format("profile {}\n", options.out));
  }
  show(fmt::format("sets    {}\n", folder.string()));
  return !stopped && search.after < search.before ? kDone : kFailed;
}

}  // namespace swiftlet::apps
