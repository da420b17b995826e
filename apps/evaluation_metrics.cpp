#include "apps/evaluation_metrics.hpp"

#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "apps/command.hpp"
#include "apps/error_figures.hpp"
#include "apps/pose_order.hpp"
#include "apps/show.hpp"
#include "common/error.hpp"
#include "common/median_step.hpp"
#include "common/rounding.hpp"
#include "evaluation/relations.hpp"
#include "interfaces/files/relations.hpp"
#include "interfaces/files/stamp_units.hpp"
#include "interfaces/files/text_file.hpp"
#include "interfaces/files/trajectory_file.hpp"

namespace swiftlet::apps {
namespace {

using common::InputError;
using common::Message;
using common::Ordered;
using evaluation::Alignment;
using evaluation::PosePair;
using evaluation::Stretch;
using interfaces::PoseOrder;

constexpr double kDegPerRad = 1.0 / common::kRadPerDeg;

void print(const nlohmann::json& json) {
  showJson(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

/// Rounded to the microsecond, as in logs and relations.
std::string textOf(common::Time stamp) {
  const std::string text = interfaces::stampText(stamp);
  return text.substr(0, text.size() - 3);
}

Ordered read(const std::string& file) { return common::ordered(interfaces::readPoses(file)); }

/// What is odd about the steps of the stamps; empty if they are regular.
std::string stepNote(const Ordered& poses) {
  return interfaces::stampStepNote(
      common::medianStep_s(poses.trajectory, [](const common::StampedPose& pose) { return pose.stamp; }));
}

/// Notes about the stamps of a file, for the reader of the figures.
void noteStamps(const std::string& file, const Ordered& poses) {
  if (poses.went_back > 0)
    show(fmt::format("{}: {} stamps go back in time; the poses are taken in the order of their stamps\n", file,
                     poses.went_back));
  if (poses.repeated > 0)
    show(fmt::format("{}: {} stamps occur again; the last pose of each is taken\n", file, poses.repeated));
  if (const std::string note = stepNote(poses); !note.empty()) show(fmt::format("{}: {}\n", file, note));
}

void addStamps(nlohmann::json& json, const std::string& whose, const Ordered& poses) {
  json[whose + "_poses"] = poses.trajectory.size();
  json[whose + "_stamps_back"] = poses.went_back;
  json[whose + "_stamps_repeated"] = poses.repeated;
}

std::vector<ErrorFigures> figuresOf(const evaluation::RelationErrors& errors) {
  return {{"translation", "translational_", "m", errors.translation_m},
          {"rotation", "rotational_", "deg", inUnit(errors.rotation_rad, kDegPerRad)},
          {"translation squared", "translational_squared_", "m2", errors.translation_squared_m2},
          {"rotation squared", "rotational_squared_", "deg2",
           inUnit(errors.rotation_squared_rad2, kDegPerRad * kDegPerRad)}};
}

/// An estimate with its reference.
struct Compared {
  Ordered estimate, reference;
  PoseOrder order = PoseOrder::kStamps;
  std::size_t without_pose = 0;  ///< Frames of both files without a pose.
  std::vector<PosePair> pairs;   ///< Not empty.
};

Compared read(const EvaluateOptions& options) {
  interfaces::RecordedPoses estimate = interfaces::readRecordedPoses(options.estimate);
  interfaces::RecordedPoses reference = interfaces::readRecordedPoses(options.against);
  const PoseOrder order = giveOneClock(options.estimate, estimate, options.against, reference);
  return {common::ordered(std::move(estimate.poses)),
          common::ordered(std::move(reference.poses)),
          order,
          estimate.without_pose + reference.without_pose,
          {}};
}

/// That the stamps of one file look like another unit, if they do; else `otherwise`.
std::string unitHint(const Compared& compared, const std::string& otherwise) {
  if (compared.order != PoseOrder::kStamps) return otherwise;
  const std::string of_estimate = stepNote(compared.estimate), of_reference = stepNote(compared.reference);
  if (!of_estimate.empty()) return "in the first file " + of_estimate;
  return of_reference.empty() ? otherwise : "in the second file " + of_reference;
}

Compared compare(const EvaluateOptions& options) {
  Compared compared = read(options);
  const common::Trajectory &estimate = compared.estimate.trajectory, &reference = compared.reference.trajectory;
  compared.pairs = evaluation::associate(estimate, reference, common::Duration::fromSeconds(options.max_difference_s));
  if (compared.pairs.empty())
    throw InputError({options.estimate}, "",
                     Message("evaluation.no-pairs", "no pose is within {} {} of one of {}: {} to {} against {} to {}",
                             options.max_difference_s, compared.order == PoseOrder::kStamps ? "s" : "frames",
                             options.against, textOf(estimate.front().stamp), textOf(estimate.back().stamp),
                             textOf(reference.front().stamp), textOf(reference.back().stamp)),
                     unitHint(compared, "see --max-difference"));
  return compared;
}

void requireAlignable(const EvaluateOptions& options, const Compared& compared) {
  const Alignment alignment = kAlignments.at(options.align);
  if (evaluation::align(compared.pairs, alignment)) return;
  throw InputError(
      {options.estimate}, "--align",
      Message("evaluation.not-aligned", "the {} pairs do not determine the {} alignment: too few, or on one {}",
              compared.pairs.size(), options.align, alignment == Alignment::kSpatial ? "line" : "spot"),
      unitHint(compared, "see `--align first` and `--align none`"));
}

void report(const EvaluateOptions& options, const Compared& compared, nlohmann::json json, const std::string& title,
            const std::vector<ErrorFigures>& figures) {
  if (options.json) {
    for (const ErrorFigures& figure : figures) addTo(json, figure);
    json["pairs"] = compared.pairs.size();
    json["paired_by"] = toString(compared.order);
    json["frames_without_pose"] = compared.without_pose;
    addStamps(json, "estimate", compared.estimate);
    addStamps(json, "reference", compared.reference);
    print(json);
    return;
  }
  fmt::print("{}", toText(tableOf(title, figures)));
  fmt::print("{} pairs, by {}, of {} estimated and {} reference poses\n", compared.pairs.size(),
             toString(compared.order), compared.estimate.trajectory.size(), compared.reference.trajectory.size());
  if (compared.without_pose > 0)
    show(fmt::format("{} frames have no pose: their matrices are not finite\n", compared.without_pose));
  if (compared.order == PoseOrder::kLines) return;
  noteStamps(options.estimate, compared.estimate);
  noteStamps(options.against, compared.reference);
}

}  // namespace

int evaluateRelations(const EvaluateOptions& options) {
  const std::vector<common::Relation> relations = interfaces::readRelations(options.against);
  if (relations.empty())
    throw InputError({options.against}, "", Message("evaluation.no-relations", "holds no relations"),
                     "a line of them is `from to x y z roll pitch yaw`, with stamps in seconds");
  const Ordered estimate = read(options.estimate);
  const evaluation::RelationErrors errors = evaluation::relationErrors(estimate.trajectory, relations);
  const std::size_t missing = errors.missing.size(), compared = relations.size() - missing;
  if (compared == 0)
    throw InputError(
        {options.estimate}, "",
        Message("evaluation.no-poses-of-relations", "has no pose at the stamps of any relation, such as {} and {}",
                textOf(relations[0].from), textOf(relations[0].to)),
        "stamps are those of the log, to the microsecond");

  const std::vector<ErrorFigures> figures = figuresOf(errors);
  if (options.json) {
    nlohmann::json json{{"relations", compared}, {"missing", missing}};
    for (const ErrorFigures& figure : figures) addTo(json, figure);
    addStamps(json, "estimate", estimate);
    print(json);
  } else {
    fmt::print("{}", toText(tableOf(fmt::format("{} relations", compared), figures)));
    noteStamps(options.estimate, estimate);
  }
  if (missing > 0)
    fmt::print(stderr, "{} of {} relations are missing: no pose has their stamps; the first is from {} to {}\n",
               missing, relations.size(), textOf(relations[errors.missing[0]].from),
               textOf(relations[errors.missing[0]].to));
  return missing == 0 || options.allow_missing ? kDone : kFailed;
}

int evaluateAte(const EvaluateOptions& options) {
  const Alignment alignment = kAlignments.at(options.align);
  if (options.scale && alignment != Alignment::kPlanar && alignment != Alignment::kSpatial)
    throw InputError({}, "--scale", Message("evaluation.scale-alone", "is fitted with the alignment"),
                     "use --align planar or spatial");
  Compared compared = compare(options);
  requireAlignable(options, compared);
  double scale = 1.0;
  if (options.scale) {
    const auto best = evaluation::bestScale(compared.pairs, alignment);
    if (!best)
      throw InputError({options.estimate}, "--scale", Message("evaluation.no-scale", "no scale above zero fits"),
                       "it moves against the reference: compare without --scale, or turn its axes");
    scale = *best;
    compared.pairs = evaluation::scaled(std::move(compared.pairs), scale);
  }
  const auto error = evaluation::absoluteTrajectoryError(compared.pairs, alignment);
  if (!error)
    throw InputError({options.estimate}, "--scale",
                     Message("evaluation.scaled-to-nothing", "shrinks the estimate to nothing"),
                     "the shapes do not agree: compare without --scale");
  std::string title = "Absolute trajectory error, aligned: " + options.align;
  if (options.scale) title += fmt::format(", estimate scaled by {:.6f}", scale);
  report(options, compared, {{"align", options.align}, {"scale", common::rounded(scale, 9)}}, title,
         {{"translation", "ate_", "m", error->translation_m},
          {"rotation", "ate_rotational_", "deg", inUnit(error->rotation_rad, kDegPerRad)}});
  return kDone;
}

int evaluateRpe(const EvaluateOptions& options) {
  const Stretch stretch{kUnits.at(options.unit), options.delta};
  if (stretch.unit == Stretch::Unit::kFrames && std::floor(options.delta) != options.delta)
    throw InputError({}, "--delta", Message("evaluation.not-whole", "{} is no number of frames", options.delta),
                     "give a whole one, or --unit seconds or metres");
  const Compared compared = compare(options);
  if (stretch.unit == Stretch::Unit::kSeconds && compared.order != PoseOrder::kStamps)
    throw InputError({}, "--unit", Message("evaluation.no-times", "the poses have no times in seconds"),
                     "give --unit frames or --unit metres");
  const evaluation::RelativeError error = evaluation::relativePoseError(compared.pairs, stretch);
  const std::size_t stretches = error.translation_m.count;
  if (stretches == 0)
    throw InputError({options.estimate}, "--delta",
                     Message("evaluation.no-stretch", "no stretch of {} {} lies within the {} pairs", options.delta,
                             options.unit, compared.pairs.size()),
                     "give a shorter one");
  report(options, compared, {{"delta", options.delta}, {"unit", options.unit}, {"stretches", stretches}},
         fmt::format("Relative pose error over {} {}, {} stretches", options.delta, options.unit, stretches),
         {{"translation", "rpe_translational_", "m", error.translation_m},
          {"rotation", "rpe_rotational_", "deg", inUnit(error.rotation_rad, kDegPerRad)}});
  return kDone;
}

}  // namespace swiftlet::apps
