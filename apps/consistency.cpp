// swiftlet consistency: whether the filter's errors agree with its covariance.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "apps/command.hpp"
#include "apps/output_file.hpp"
#include "apps/run_logs.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/rounding.hpp"
#include "flight/system.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/required.hpp"
#include "perception/fusion/consistency.hpp"
#include "perception/fusion/inertial_drift.hpp"
#include "rendering/plot_svg.hpp"

namespace swiftlet::apps {
namespace {

using perception::Consistency;
using perception::ConsistencyFigure;
using perception::TapedFlight;

/// The errors are compared once a second, and the best constant covariance needs some of them.
constexpr double kLeast_s = 5.0;

struct ConsistencyOptions {
  std::vector<std::string> runs;
  std::string system = "swiftlet";
  std::string drift;
  bool judge = false;
  bool json = false;
};

nlohmann::json jsonOf(const ConsistencyFigure& figure, const char* mean) {
  using common::rounded;
  nlohmann::json json = {{"name", figure.name},
                         {"degrees", figure.degrees},
                         {mean, rounded(figure.mean)},
                         {"lower", rounded(figure.lower)},
                         {"upper", rounded(figure.upper)},
                         {"inside_share", rounded(figure.inside_share)}};
  if (figure.sigma_ratio > 0.0) json["sigma_ratio"] = rounded(figure.sigma_ratio);
  return json;
}

nlohmann::json jsonOf(const Consistency& consistency) {
  auto errors = nlohmann::json::array(), innovations = nlohmann::json::array();
  for (const ConsistencyFigure& figure : consistency.errors) errors.push_back(jsonOf(figure, "nees"));
  for (const ConsistencyFigure& figure : consistency.innovations) innovations.push_back(jsonOf(figure, "nis"));
  return {{"flights", consistency.flights},
          {"instants", consistency.instants},
          {"diverged", consistency.diverged},
          {"errors", errors},
          {"innovations", innovations}};
}

void print(const Consistency& consistency) {
  show(fmt::format("{} flights, {} instants each{}\n\n", consistency.flights, consistency.instants,
                   consistency.diverged > 0 ? fmt::format(", {} left out: diverged", consistency.diverged) : ""));
  show("for each degree of freedom        mean    bounds of 95 %   instants within   sigma over the best constant\n");
  const auto row = [](const char* kind, const ConsistencyFigure& figure) {
    show(fmt::format("{} {:<28} {:6.2f}    {:.2f} to {:.2f}     {:5.0f} %           {}\n", kind, figure.name,
                     figure.mean, figure.lower, figure.upper, 100.0 * figure.inside_share,
                     figure.sigma_ratio > 0.0 ? fmt::format("{:.2f}", figure.sigma_ratio) : "-"));
  };
  for (const ConsistencyFigure& figure : consistency.errors) row("NEES", figure);
  for (const ConsistencyFigure& figure : consistency.innovations) row("NIS ", figure);
}

/// What is not as it must be; empty if all is.
std::vector<std::string> missed(const Consistency& consistency) {
  std::vector<std::string> missed;
  for (const auto* figures : {&consistency.errors, &consistency.innovations})
    for (const ConsistencyFigure& figure : *figures) {
      if (!figure.consistent())
        missed.push_back(fmt::format("{}: the mean {:.2f} is not within {:.2f} to {:.2f}", figure.name, figure.mean,
                                     figure.lower, figure.upper));
      if (!figure.well_sized())
        missed.push_back(fmt::format("{}: the variance is {:.2f} times the best constant one, 0.5 to 2 was asked for",
                                     figure.name, figure.sigma_ratio * figure.sigma_ratio));
    }
  return missed;
}

/// Fig. 3a of Bachrach 2009, of the first flight: the velocity by the accelerometer alone.
void plotDrift(const TapedFlight& flight, const flight::System& system, const ConsistencyOptions& options) {
  rendering::Plot plot;
  plot.title = "Forward velocity";
  plot.x_label = "time (s)";
  plot.y_label = "velocity (m/s)";
  rendering::Series truth{"truth", {}}, filter{"filter", {}}, integrated{"integrated acceleration", {}, true};
  const auto velocities = perception::inertialDrift(flight, system.config.autonomy.estimator.fusion);
  for (const perception::ForwardVelocity& v : velocities) {
    truth.points.emplace_back(v.time_s, v.true_m_s);
    filter.points.emplace_back(v.time_s, v.filtered_m_s);
    integrated.points.emplace_back(v.time_s, v.integrated_m_s);
  }
  if (velocities.empty())
    throw common::InputError({options.runs.front()}, "--drift",
                             common::Message("drift.no-filter", "its filter never started while the truth was known"),
                             "put a run first that took off, flown with --control-log");
  plot.series = {std::move(integrated), std::move(filter), std::move(truth)};
  required(interfaces::writeAtomically(options.drift, rendering::plotSvg(plot)));
  if (options.json) return;
  const perception::ForwardVelocity& last = velocities.back();
  show(fmt::format(
      "after {:.0f} s the integrated acceleration is off by {:.2f} m/s, the filter by {:.3f} m/s\nplot {}\n",
      last.time_s, std::abs(last.integrated_m_s - last.true_m_s), std::abs(last.filtered_m_s - last.true_m_s),
      options.drift));
}

int consistencyOfRuns(const ConsistencyOptions& options) {
  const flight::System system = flight::loadSystem(options.system);
  if (!options.drift.empty()) requireWritable(options.drift, "--drift");
  std::vector<TapedFlight> flights;
  refuseRunsGivenTwice(options.runs, "run");
  for (const std::string& run : options.runs)
    flights.push_back(readTapedFlight(run, {system.vehicle, kSystemOfVehicle}, kLeast_s));
  const Consistency consistency = perception::consistencyOf(flights, system.config.autonomy.estimator.fusion);
  if (options.json)
    showJson(jsonOf(consistency).dump(2) + "\n");
  else
    print(consistency);
  if (!options.drift.empty()) plotDrift(flights.front(), system, options);
  if (consistency.flights == 0) return kFailed;
  if (!options.judge) return kDone;
  const std::vector<std::string> failures = missed(consistency);
  if (!options.json)
    for (const std::string& failure : failures) show(fmt::format("missed: {}\n", failure));
  return failures.empty() ? kDone : kFailed;
}

}  // namespace

void addConsistency(Command& program) {
  auto options = std::make_shared<ConsistencyOptions>();
  Command command = program.command(
      "consistency",
      "Compare the errors of the filter with its covariance (NEES, NIS), in flights whose truth is known.");
  command.arguments("run", options->runs, "Folders of runs that were flown with --control-log.");
  command.option("--system", options->system, "The profile whose filter is replayed.");
  command.option("--drift", options->drift,
                 "File (SVG) for a plot of the first flight's velocity by integrated acceleration alone, by the filter "
                 "and in truth.");
  command.flag("--judge", options->judge,
               "Fail unless each mean is within its bounds, and each variance within twice the best constant one.");
  command.flag("--json", options->json, "Print the figures as JSON.");
  command.footer("Example: swiftlet consistency runs/a runs/b runs/c");
  command.runs([options] { return consistencyOfRuns(*options); });
}

}  // namespace swiftlet::apps
