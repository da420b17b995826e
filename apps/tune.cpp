// swiftlet tune: the noise parameters of the filter from flights with truth.
#include <memory>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/required.hpp"
#include "apps/run_logs.hpp"
#include "apps/show.hpp"
#include "apps/system.hpp"
#include "common/error.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "perception/fusion/noise_tuning.hpp"

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
};

std::vector<TapedFlight> readFlights(const std::vector<std::string>& runs, const common::VehicleConfig& vehicle) {
  std::vector<TapedFlight> flights;
  for (const std::string& run : runs) flights.push_back(readTapedFlight(run, vehicle));
  return flights;
}

std::vector<const TapedFlight*> pointersTo(const std::vector<TapedFlight>& flights) {
  std::vector<const TapedFlight*> pointers;
  for (const TapedFlight& flight : flights) pointers.push_back(&flight);
  return pointers;
}

std::string settingsYaml(const FusionConfig& config) {
  std::string text =
      "# Learned by `swiftlet tune`: put it into a system profile.\nautonomy:\n  estimator:\n    fusion:\n";
  for (const perception::NoiseParameter& parameter : perception::noiseParameters())
    text += fmt::format("      {}: {:.4g}\n", parameter.name, config.*parameter.value);
  return text;
}

int tune(const TuneOptions& options) {
  const System system = loadSystem(options.system);
  if (options.held_out.empty())
    throw common::InputError(common::Problem{
        {}, "--held-out", "names no flight", "parameters are judged on flights that they were not learned from"});
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

}  // namespace

void addTune(Command& program) {
  auto options = std::make_shared<TuneOptions>();
  Command command =
      program.command("tune", "Learn the noise parameters of the filter from flights whose truth is known.");
  command.arguments("run", options->runs, "Folders of runs that were flown with --control-log, to learn from.");
  command.option("--held-out", options->held_out, "A run to judge the result by; may be given several times.");
  command.option("--system", options->system, "The profile whose parameters are the start.");
  command.option("--steps", options->steps, {1, 10'000}, "Steps of the stochastic descent.");
  command.option("--out", options->out, "File of the settings (YAML), a part of a profile.");
  command.footer("Example: swiftlet tune runs/a runs/b --held-out runs/c --out tuned.yaml");
  command.runs([options] { return tune(*options); });
}

}  // namespace swiftlet::apps
