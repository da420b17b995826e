#include "apps/explore_bench_flights.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "apps/show.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "evaluation/trial.hpp"
#include "flight/stop_signals.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "simulated_flight/trial_flight.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::FlightScore;
using evaluation::TrialConfig;

constexpr const char* kMission = "trials/missions/explore_and_come_home.xml";
/// While the leaf runs; see PhaseConfig::phase.
constexpr const char* kExploring = "Explore";
constexpr double kWorldLimit_s = 3600.0;

/// The scenario of a trial, or of a world; of its mission, criteria and phases only those of exploring are left.
TrialConfig benchTrial(const std::string& file) {
  TrialConfig trial;
  const std::string ending = common::endingOf(file);
  if (ending == ".sdf" || ending == ".world") {
    trial.name = fs::path(file).stem().string();
    trial.scenario.world = file;
    trial.time_limit_s = kWorldLimit_s;
  } else if (ending == ".yaml" || ending == ".yml") {
    trial = evaluation::readTrial(file);
  } else {
    throw common::InputError(
        {file}, "", common::Message("explore-bench.not-flown", "is neither a world nor a trial, which can be flown"),
        "make a world of it with `swiftlet world`, and give that");
  }
  trial.mission = kMission;
  trial.criteria = {};
  trial.operator_steps = {};
  trial.event_orders = {};
  trial.asked_of = {};
  trial.paper = {};
  trial.targets = {};
  trial.phases = {evaluation::PhaseConfig{.name = "explore", .phase = kExploring}};
  return trial;
}

/// The profile with another explorer, as a file: a flight is repeated by the files that it names.
std::string profileWith(const std::string& system, planning::ExplorerKind kind, const fs::path& out) {
  const auto name = [&] {
    switch (kind) {
      case planning::ExplorerKind::kUtility:
        return "utility";
      case planning::ExplorerKind::kNearestFrontier:
        return "nearest_frontier";
      case planning::ExplorerKind::kTour:
        return "tour";
      case planning::ExplorerKind::kCameraTour:
        return "camera_tour";
    }
    return "";
  }();
  const fs::path file = out / fmt::format("{}.yaml", name);
  required(interfaces::writeAtomically(
      file, fmt::format("based_on: {}\nautonomy:\n  execution:\n    explorer: {{kind: {}}}\n", system, name)));
  return file.string();
}

evaluation::FlatFlight flightOf(const FlightScore& score) {
  evaluation::FlatFlight flight;
  flight.complete = score.passed() && score.mission_done;
  for (const std::string& failure : score.failures) flight.failure += (flight.failure.empty() ? "" : "; ") + failure;
  if (!flight.complete && flight.failure.empty())
    flight.failure = score.collisions > 0 ? score.collisionText() : score.outcome;
  if (!score.phases.empty()) {
    flight.explore_s = score.phases.front().figure("time_s").value_or(0.0);
    flight.explore_m = flight.explore_s * score.phases.front().figure("speed_mean_m_s").value_or(0.0);
  }
  flight.total_s = score.figure("mission_time_s").value_or(0.0);
  flight.total_m = score.figure("distance_m").value_or(0.0);
  flight.unseen_share = score.figure("explored_unseen_share").value_or(0.0);
  return flight;
}

}  // namespace

std::vector<BenchResult> flyExplorers(const std::string& file,
                                      const std::vector<std::pair<std::string, planning::ExplorerKind>>& explorers,
                                      const BenchFlightOptions& options, bool quiet) {
  const TrialConfig whole = benchTrial(file);
  simulated_flight::checkSeeds(options.seed, options.repeat);
  const fs::path out = simulated_flight::trialFolder(options.out, "explore-bench", {"results.json", "["});
  std::vector<TrialConfig> trials;
  for (const auto& [name, kind] : explorers) {
    TrialConfig trial = whole;
    trial.natures.resize(1);
    trial.setSystem(profileWith(options.system, kind, fs::absolute(out)));
    trial = trial.byCondition().front();
    trial.name = fmt::format("{}-{}", fs::path(file).stem().string(), name);
    trials.push_back(std::move(trial));
  }
  simulated_flight::prepare(trials);
  const auto& [stop, number] = flight::stopOnSignals();
  std::vector<BenchResult> results;
  for (int seed = options.seed; seed < options.seed + options.repeat && !stop; ++seed) {
    BenchResult result{fmt::format("{} seed {}", fs::path(file).filename().string(), seed), std::nullopt, 0.0, {}};
    for (std::size_t i = 0; i < trials.size() && !stop; ++i) {
      TrialConfig& trial = trials[i];
      trial.scenario.nature =
          std::make_shared<const simulation::Nature>(simulation::Nature::load(trial.natures.front()));
      const auto setup = simulated_flight::setupOf(trial, simulated_flight::givenMap(trial, out), seed,
                                                   out / fmt::format("{}-{:03}", trial.name, seed));
      simulated_flight::SimulatedHooks hooks;
      hooks.stop = &stop;
      const FlightScore score = simulated_flight::flyScored(trial, setup, std::move(hooks)).front();
      if (!quiet)
        for (const std::string& certificate : score.certificates)
          show(fmt::format("{} seed {}: {}\n", trial.name, seed, certificate));
      result.flights.push_back({explorers[i].first, flightOf(score)});
    }
    if (result.flights.size() == explorers.size()) results.push_back(std::move(result));
  }
  return results;
}

}  // namespace swiftlet::apps
