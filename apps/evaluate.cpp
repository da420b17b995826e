// swiftlet evaluate: how good an estimated trajectory is, by the published metrics.
#include <memory>
#include <string>

#include "apps/command.hpp"
#include "apps/evaluate_logs.hpp"
#include "apps/evaluation_metrics.hpp"

namespace swiftlet::apps {
namespace {

/// A metric as a command of its own.
using Metric = int (*)(const EvaluateOptions&);

constexpr const char* kTum = "The estimated trajectory: TUM (t x y z qx qy qz qw).";
constexpr const char* kAnyPoses = "The estimated trajectory: TUM (t x y z qx qy qz qw), or as below.";
constexpr const char* kKnownPoses =
    "Either trajectory may be TUM, reference poses of a laser log (ipc_timestamp scan_index x y theta), KITTI (12 "
    "numbers a line),\n"
    "4x4 matrices (16 numbers a line, four lines each, or a .log of Open3D), the folder of a run, of TUM RGB-D, or of "
    "frames with a\n"
    "matrix each (frame-000000.pose.txt of 7-Scenes, 0.txt of ScanNet). Without stamps, poses are paired by the frame "
    "numbers, or,\n"
    "where there are none either, in their order: both need as many then. Poses of cameras have no vertical z: align "
    "them spatially.\n";

Command addMetric(Command& evaluate, const std::shared_ptr<EvaluateOptions>& options, Metric metric,
                  const std::string& name, const std::string& description, const char* estimate) {
  Command command = evaluate.command(name, description);
  command.argument("estimate", options->estimate, estimate);
  command.flag("--json", options->json, "Print the figures as JSON.");
  command.runs([options, metric] { return metric(*options); });
  return command;
}

void addReference(Command& command, EvaluateOptions& options) {
  command.argument("reference", options.against, "The reference, as below.");
  command.option("--max-difference", options.max_difference_s, {0.0, 1e6},
                 "Poses are paired whose stamps are at most so many seconds (or frame numbers) apart.");
}

}  // namespace

void addEvaluate(Command& program) {
  auto options = std::make_shared<EvaluateOptions>();
  Command command = program.command("evaluate", "Measure a trajectory by the published metrics.");
  command.requireCommand("A metric");
  command.footer(
      "Files may be compressed (.gz, .bz2, .xz). Stamps may go back: poses are taken in the order of their stamps, "
      "and\n"
      "of those with one stamp the last in the file; both are counted and said.\n"
      "Example: swiftlet evaluate relations intel.tum intel.relations.gz");

  Command relations = addMetric(command, options, evaluateRelations, "relations",
                                "Errors of known relations between poses (Kuemmerle et al. 2009).", kTum);
  relations.argument("relations", options->against, "Lines of `t1 t2 x y z roll pitch yaw`.");
  relations.flag("--allow-missing", options->allow_missing, "Exit with 0 although relations are missing.");
  relations.footer(
      "The error of a relation is relation^-1 * (x_t1^-1 * x_t2): its length, and its angle. Stamps are matched to "
      "the\n"
      "microsecond. A relation of which a stamp is not in the estimate is missing: it is counted and is in no figure, "
      "and\n"
      "as figures over fewer relations do not compare, the exit code is then 1.\n"
      "Example: swiftlet evaluate relations intel.tum intel.relations.gz");

  Command ate = addMetric(command, options, evaluateAte, "ate",
                          "Absolute trajectory error after alignment (Sturm et al. 2012).", kAnyPoses);
  addReference(ate, *options);
  ate.choice(
      "--align", options->align, kAlignments,
      "How the estimate is laid on the reference: not, by the first pair, by least squares over x, y and yaw (and "
      "the mean z), or over all six (Umeyama 1991).");
  ate.flag("--scale", options->scale, "Fit the scale as well; with --align planar or spatial.");
  ate.footer(std::string(kKnownPoses) +
             "Example: swiftlet evaluate ate trajectory.tum groundtruth.txt.gz --align planar");

  Command rpe =
      addMetric(command, options, evaluateRpe, "rpe",
                "Relative pose error over stretches (Sturm et al. 2012); alignment does not change it.", kAnyPoses);
  addReference(rpe, *options);
  rpe.option("--delta", options->delta, {1e-6, 1e9}, "From each pose to the first that is at least so far on.");
  rpe.choice("--unit", options->unit, kUnits, "Unit of --delta; metres are along the reference's path.");
  rpe.footer(std::string(kKnownPoses) +
             "Example: swiftlet evaluate rpe trajectory.tum groundtruth.txt.gz --delta 1 --unit seconds");
  addEvaluateLogs(command);
}

}  // namespace swiftlet::apps
