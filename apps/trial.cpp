// swiftlet trial: scripted flights with pass criteria.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/envelope.hpp"
#include "apps/show.hpp"
#include "apps/trial_progress.hpp"
#include "behaviors/mission_check.hpp"
#include "common/error.hpp"
#include "common/table.hpp"
#include "evaluation/trial_results.hpp"
#include "flight/files_of_kind.hpp"
#include "flight/leaf_libraries.hpp"
#include "flight/stop_signals.hpp"
#include "simulated_flight/flight.hpp"
#include "simulated_flight/trial_run.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using evaluation::FlightScore;
using evaluation::TrialConfig;

struct TrialOptions {
  simulated_flight::TrialRunOptions run;
  std::vector<std::string> leaves;
  bool json = false;
  bool envelope = false;
  std::string quantities;  ///< Empty: those of EnvelopeOptions.
  std::string only;
  std::string write;
};

void refuseIf(bool given, const char* option, const common::Message& message) {
  if (given) throw common::InputError({}, option, message);
}

EnvelopeOptions envelopeOptions(const TrialOptions& options) {
  const common::Message pinned("envelope.pins-plant", "does not go with --envelope, which pins the plant");
  const common::Message not_kept("envelope.keeps-failed-runs",
                                 "does not go with --envelope, which keeps only the runs that fail, for their reports");
  refuseIf(options.run.battery.has_value(), "--battery", pinned);
  refuseIf(!options.run.nature.empty(), "--nature", pinned);
  refuseIf(!options.run.vehicle_memory.empty(), "--vehicle-memory",
           common::Message("envelope.data-sheet", "does not go with --envelope, which starts from the data sheet"));
  refuseIf(options.run.control_log, "--control-log", not_kept);
  refuseIf(options.run.record_rgbd, "--record-rgbd", not_kept);
  EnvelopeOptions envelope{.trial = options.run.trials,
                           .types = flight::nodesWith(options.leaves),
                           .only = options.only,
                           .repeat = options.run.repeat,
                           .seed = options.run.seed,
                           .jobs = options.run.jobs,
                           .system = options.run.system,
                           .out = options.run.out,
                           .write = options.write,
                           .json = options.json};
  if (!options.quantities.empty()) envelope.quantities = options.quantities;
  return envelope;
}

std::string flightLine(const TrialConfig& trial, const FlightScore& score) {
  const std::string vehicle = score.vehicle.empty() ? "" : fmt::format("{:<10} ", score.vehicle);
  std::string line = fmt::format("{:<24} seed {:<4} {}{:<8} {:6.1f} s {:5.1f} x", trial.name, score.seed, vehicle,
                                 score.passed() ? "passed" : "FAILED", score.figure("mission_time_s").value_or(0.0),
                                 score.figure("realtime_factor").value_or(0.0));
  for (const std::string& failure : score.failures) line += "\n    " + failure;
  if (!score.passed() && score.failures.empty()) line += "\n    " + score.collisionText();
  if (!score.coverage_problem.empty() && !trial.criteria.asksFor("coverage"))
    line += "\n    no coverage: " + score.coverage_problem;
  for (const std::string& certificate : score.certificates) line += "\n    " + certificate;
  return line;
}

/// Warnings of missions that wait for an operator, in trials whose script does not answer: a line each.
void showOperatorWarnings(const std::vector<TrialConfig>& trials, const tree::Registry& types) {
  std::set<std::string> lines;
  for (const TrialConfig& trial : trials) {
    const auto commands = [&](evaluation::OperatorAction action) {
      return std::any_of(trial.operator_steps.begin(), trial.operator_steps.end(),
                         [&](const evaluation::OperatorStep& step) { return step.command == action; });
    };
    behaviors::MissionLimits limits;
    limits.operator_goes_on = commands(evaluation::OperatorAction::kGoOn);
    limits.operator_gives_goals =
        commands(evaluation::OperatorAction::kGoal) || commands(evaluation::OperatorAction::kHome);
    for (const std::string& mission : simulated_flight::missionFiles(trial.scenario, trial.mission))
      for (const tree::Problem& warning : behaviors::operatorWarnings(flight::findMission(mission), limits, types))
        lines.insert(lineOf(warning, true));
  }
  for (const std::string& line : lines) showError(line);
}

void fly(simulated_flight::TrialRun& run, const std::atomic<bool>& stop, bool quiet) {
  TrialProgress progress(run.flights(), quiet);
  const auto over = [&](const TrialConfig& trial, const std::vector<FlightScore>& flown) {
    std::string lines;
    for (const FlightScore& score : flown) lines += flightLine(trial, score) + "\n";
    progress.over(lines, std::all_of(flown.begin(), flown.end(), [](const auto& score) { return score.passed(); }));
  };
  try {
    run.fly({.stop = stop,
             .notes = showNotes,
             .flies = [&](const std::string& flight, double simulated_s) { progress.flies(flight, simulated_s); },
             .over = over});
  } catch (...) {
    progress.close();
    throw;
  }
  progress.close();
}

void showResults(const evaluation::TrialResults& results, const fs::path& out) {
  show(fmt::format("\n{}\n", toText(summaryTable(results))));
  for (const evaluation::TrialResult& trial : results.trials)
    for (const std::string& failure : trial.missed()) show(fmt::format("{}, all flights: {}\n", trial.name, failure));
  show(fmt::format("results {}\nreport  {}\n", (out / "results.json").string(), (out / "report.html").string()));
}

int trial(const TrialOptions& options) {
  const std::atomic<bool>& stop = flight::stopOnSignals().first;
  outliveReaders();
  simulated_flight::TrialRunOptions run_options = options.run;
  run_options.types = flight::nodesWith(options.leaves);
  simulated_flight::TrialRun run(run_options);
  showOperatorWarnings(run.trials(), *run_options.types);
  fly(run, stop, options.json);
  if (options.json)
    showJson(toJson(run.results()));
  else
    showResults(run.results(), run.folder());
  return run.results().passed() && !stop ? kDone : kFailed;
}

}  // namespace

void addTrial(Command& program) {
  auto options = std::make_shared<TrialOptions>();
  Command command = program.command("trial", "Fly scripted trials and score them against the truth.");
  command.argument("trial", options->run.trials, "Trial file (YAML), or a folder of them.");
  command.leavesOption(options->leaves);
  command.option("--repeat", options->run.repeat, {1, 10'000},
                 "Flights of each trial, seeds S, S+1, ...; default: what it says.");
  command.option("--jobs", options->run.jobs, {1, 64}, "Flights at the same time.");
  command.option("--seed", options->run.seed, {0, simulation::kGreatestSeed},
                 "The first seed S; default: the trial's scenario.seed, or 1.");
  command.option("--system", options->run.system, "Profile to fly them all with, instead of their own.");
  command.option("--vehicle-memory", options->run.vehicle_memory,
                 "File with what earlier flights learned of the vehicle: each flight starts from it, none writes it.");
  command.flag("--control-log", options->run.control_log,
               "Keep commands, motion and battery at 100 Hz in each run: what `identify` reads.");
  command.flag("--record-rgbd", options->run.record_rgbd,
               "Keep the frames of the RGB-D camera in the run, as a folder that `map3d` reads.");
  command.option("--nature", options->run.nature, "Nature to fly them all in, instead of their own.");
  command.option("--battery", options->run.battery, {0.01, 1},
                 "Charge at the start to fly them all with, as a share of the full one.");
  command.flag("--allow-incomplete-world", options->run.allow_incomplete_world,
               "Fly though models, meshes or collisions of a world are missing: the vehicle meets nothing there.");
  command.option("--out", options->run.out, "Folder of the results; default runs/<time>-trial.");
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
    const common::Message only_there("envelope.option-alone", "goes only with --envelope");
    refuseIf(!options->quantities.empty(), "--quantities", only_there);
    refuseIf(!options->only.empty(), "--only", only_there);
    refuseIf(!options->write.empty(), "--write", only_there);
    return trial(*options);
  });
}

}  // namespace swiftlet::apps
