// swiftlet evaluate: how good an estimated trajectory is, by the published metrics.
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/evaluation_metrics.hpp"
#include "apps/numbers.hpp"

namespace swiftlet::apps {
namespace {

/// A metric as a command of its own.
using Metric = int (*)(const EvaluateOptions&);

CLI::App& addMetric(CLI::App& evaluate, Run& run, const std::shared_ptr<EvaluateOptions>& options, Metric metric,
                    const std::string& name, const std::string& description) {
  auto* command = evaluate.add_subcommand(name, description);
  command->add_option("estimate", options->estimate, "The estimated trajectory: TUM (t x y z qx qy qz qw).")
      ->required();
  command->add_flag("--json", options->json, "Print the figures as JSON.");
  command->callback([&run, options, metric] { run = [options, metric] { return metric(*options); }; });
  return *command;
}

void addReference(CLI::App& command, EvaluateOptions& options) {
  command
      .add_option("reference", options.against,
                  "The reference: TUM, or reference poses of a laser log (ipc_timestamp scan_index x y theta).")
      ->required();
  command
      .add_option("--max-difference", options.max_difference_s,
                  "Poses are paired whose stamps are at most so far apart.")
      ->type_name("S")
      ->check(numberWithin(0.0, 1e6))
      ->capture_default_str();
}

}  // namespace

void addEvaluate(CLI::App& program, Run& run) {
  auto options = std::make_shared<EvaluateOptions>();
  auto* command = program.add_subcommand("evaluate", "Measure a trajectory by the published metrics.");
  command->require_subcommand(0, 1);  // A missing subcommand is reported below, so that an unknown one is named first.
  command->callback([&run, command] {
    if (command->get_subcommands().empty()) run = []() -> int { throw CLI::RequiredError("A metric"); };
  });
  command->footer(
      "Files may be compressed (.gz, .bz2, .xz). Stamps may go back: poses are taken in the order of their stamps, "
      "and\n"
      "of those with one stamp the last in the file; both are counted and said.\n"
      "Example: swiftlet evaluate relations intel.tum intel.relations.gz");

  CLI::App& relations = addMetric(*command, run, options, evaluateRelations, "relations",
                                  "Errors of known relations between poses (Kuemmerle et al. 2009).");
  relations.add_option("relations", options->against, "Lines of `t1 t2 x y z roll pitch yaw`.")->required();
  relations.add_flag("--allow-missing", options->allow_missing, "Exit with 0 although relations are missing.");
  relations.footer(
      "The error of a relation is relation^-1 * (x_t1^-1 * x_t2): its length, and its angle. Stamps are matched to "
      "the\n"
      "microsecond. A relation of which a stamp is not in the estimate is missing: it is counted and is in no figure, "
      "and\n"
      "as figures over fewer relations do not compare, the exit code is then 1.\n"
      "Example: swiftlet evaluate relations intel.tum intel.relations.gz");

  CLI::App& ate = addMetric(*command, run, options, evaluateAte, "ate",
                            "Absolute trajectory error after alignment (Sturm et al. 2012).");
  addReference(ate, *options);
  ate.add_option(
         "--align", options->align,
         "How the estimate is laid on the reference: not, by the first pair, by least squares over x, y and yaw "
         "(and the mean z), or over all six (Umeyama 1991).")
      ->check(CLI::IsMember(kAlignments))
      ->capture_default_str();
  ate.add_flag("--scale", options->scale, "Fit the scale as well; with --align planar or spatial.");
  ate.footer("Example: swiftlet evaluate ate trajectory.tum groundtruth.txt.gz --align planar");

  CLI::App& rpe = addMetric(*command, run, options, evaluateRpe, "rpe",
                            "Relative pose error over stretches (Sturm et al. 2012); alignment does not change it.");
  addReference(rpe, *options);
  rpe.add_option("--delta", options->delta, "From each pose to the first that is at least so far on.")
      ->check(numberWithin(1e-6, 1e9))
      ->capture_default_str();
  rpe.add_option("--unit", options->unit, "Of --delta; metres are along the reference's path.")
      ->check(CLI::IsMember(kUnits))
      ->capture_default_str();
  rpe.footer("Example: swiftlet evaluate rpe trajectory.tum groundtruth.txt.gz --delta 1 --unit seconds");
}

}  // namespace swiftlet::apps
