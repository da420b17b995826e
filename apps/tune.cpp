// swiftlet tune: the noise parameters of the filter from flights with truth, or the gains of the controller by flying.
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/run_logs.hpp"
#include "apps/show.hpp"
#include "apps/tune_gains.hpp"
#include "common/error.hpp"
#include "control/identification/axis_fit.hpp"
#include "flight/system.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "perception/fusion/noise_tuning.hpp"
#include "simulation/scenario.hpp"

namespace swiftlet::apps {
namespace {

using perception::FusionConfig;
using perception::TapedFlight;

struct TuneOptions {
  std::vector<std::string> runs;
  std::vector<std::string> held_out;
  std::string system = "swiftlet";
  std::string out;
  int steps = 40;
  TuneGainsOptions gains;
};

std::vector<TapedFlight> readFlights(const std::vector<std::string>& runs, const common::VehicleConfig& vehicle) {
  // As long as for `identify`: the filter converges in some seconds, and a shorter flight would teach only that.
  const double least_s = control::AxisFitOptions{}.shortest_s;
  std::vector<TapedFlight> flights;
  for (const std::string& run : runs) flights.push_back(readTapedFlight(run, {vehicle, kSystemOfVehicle}, least_s));
  return flights;
}

/// Flights for the judgement must not be flights for the learning.
void refuseRepeatedFlights(const TuneOptions& options) {
  refuseRunsGivenTwice(options.runs, "run");
  refuseRunsGivenTwice(options.held_out, "--held-out");
  for (const std::string& run : options.held_out)
    for (const std::string& learned : options.runs) {
      std::error_code error;
      if (std::filesystem::equivalent(run, learned, error))
        throw common::InputError({}, "--held-out",
                                 common::Message("tune.learned-from-too", "{} is learned from too", run),
                                 "give a flight that is not");
    }
}

std::vector<const TapedFlight*> pointersTo(const std::vector<TapedFlight>& flights) {
  std::vector<const TapedFlight*> pointers;
  for (const TapedFlight& flight : flights) pointers.push_back(&flight);
  return pointers;
}

/// What marks a file as settings of ours.
constexpr const char* kSettingsLine = "# Learned by `swiftlet tune`: put it into a system profile.";

std::string settingsYaml(const FusionConfig& config) {
  std::string text = fmt::format("{}\nautonomy:\n  estimator:\n    fusion:\n", kSettingsLine);
  for (const perception::NoiseParameter& parameter : perception::noiseParameters())
    text += fmt::format("      {}: {:.4g}\n", parameter.name, config.*parameter.value);
  return text;
}

int tuneNoise(const TuneOptions& options) {
  const flight::System system = flight::loadSystem(options.system);
  if (!options.out.empty()) requireWritable(options.out, "--out", kSettingsLine);
  if (options.runs.empty())
    throw common::InputError({}, "run", common::Message("tune.no-flights", "names no flight"),
                             "give flights to learn from, or --gains with a trial to fly");
  if (options.held_out.empty())
    throw common::InputError({}, "--held-out", common::Message("tune.no-flights", "names no flight"),
                             "parameters are judged on flights that they were not learned from");
  refuseRepeatedFlights(options);
  const std::vector<TapedFlight> learned_from = readFlights(options.runs, system.vehicle);
  const std::vector<TapedFlight> held_out = readFlights(options.held_out, system.vehicle);
  const FusionConfig& start = system.config.autonomy.estimator.fusion;
  perception::TuningOptions tuning_options;
  tuning_options.steps = options.steps;
  const perception::Tuning tuning =
      perception::tuneNoise(pointersTo(learned_from), start, tuning_options, [&](int step, double best_m_s) {
        if (step % 10 == 0) show(fmt::format("step {:3}  {:.4f} m/s\n", step, best_m_s));
      });
  const double before_m_s = perception::velocityError_m_s(pointersTo(held_out), start);
  const double after_m_s = perception::velocityError_m_s(pointersTo(held_out), tuning.config);
  show(
      fmt::format("RMS of the velocity error   by hand      learned\n"
                  "{:3} flights learned from     {:.4f} m/s   {:.4f} m/s\n"
                  "{:3} flights held out         {:.4f} m/s   {:.4f} m/s\n\n",
                  learned_from.size(), tuning.before_m_s, tuning.after_m_s, held_out.size(), before_m_s, after_m_s));
  for (const perception::NoiseParameter& parameter : perception::noiseParameters())
    show(fmt::format("{:<36} {:9.4g} -> {:9.4g}\n", parameter.name, start.*parameter.value,
                     tuning.config.*parameter.value));
  if (!options.out.empty()) {
    required(interfaces::writeAtomically(options.out, settingsYaml(tuning.config)));
    show(fmt::format("settings {}\n", options.out));
  }
  return after_m_s < before_m_s ? kDone : kFailed;
}

int tune(const TuneOptions& options) {
  if (options.gains.trial.empty()) return tuneNoise(options);
  if (!options.runs.empty() || !options.held_out.empty())
    throw common::InputError({}, "--gains", common::Message("tune.flies-its-own", "does not go with recorded flights"),
                             "it flies its own: leave out the runs and --held-out");
  TuneGainsOptions gains = options.gains;
  gains.system = options.system;
  gains.out = options.out;
  return tuneGains(gains);
}

}  // namespace

void addTune(Command& program) {
  auto options = std::make_shared<TuneOptions>();
  TuneGainsOptions& gains = options->gains;
  Command command = program.command(
      "tune",
      "Learn noise parameters of the filter from flights whose truth is known, or search a controller's gains.");
  command.optionalArguments("run", options->runs, "Folders of runs that were flown with --control-log, to learn from.");
  command.option("--held-out", options->held_out, "A run to judge the result by; may be given several times.");
  command.option("--system", options->system, "The profile whose parameters are the start.");
  command.option("--steps", options->steps, {1, 10'000}, "Steps of the stochastic descent.");
  command.option("--gains", gains.trial,
                 "Trial to fly: searches the gains of the profile's controller for the least cost, the mean of the "
                 "figures of its phases over their `max`.");
  command.option("--nature", gains.nature, "With --gains: nature to fly in, instead of the trial's.");
  command.option("--flights", gains.flights, {2, 100'000}, "With --gains: flights altogether.");
  command.option("--seeds", gains.seeds, {1, 1'000}, "With --gains: flights of each set of gains, all with the same.");
  command.option("--seed", gains.seed, {0, simulation::kGreatestSeed},
                 "With --gains: the first seed; score on others.");
  command.option("--only", gains.only, "With --gains: only gains whose names begin with this.");
  command.option("--jobs", gains.jobs, {1, 64}, "With --gains: flights at the same time.");
  command.option("--out", options->out, "File (YAML) of the noise parameters, or of the profile with its new gains.");
  command.footer(
      "Example: swiftlet tune runs/a runs/b --held-out runs/c --out tuned.yaml\n"
      "Example: swiftlet tune --gains trials/papers/gains.yaml --system unb --flights 120 --out unb_tuned.yaml");
  command.runs([options] { return tune(*options); });
}

}  // namespace swiftlet::apps
