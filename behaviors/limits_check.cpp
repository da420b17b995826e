#include "behaviors/limits_check.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "behaviors/follow_path.hpp"
#include "behaviors/leaf_traits.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/survey.hpp"
#include "common/goal.hpp"

namespace swiftlet::behaviors {
namespace {

/// What is wrong with the targets that a node names; nothing if they are looked for.
std::optional<tree::Message> targetProblem(const tree::Tree& tree, const tree::NodeRecord& record,
                                           const MissionLimits& limits) {
  if (!limits.has_camera || !limits.target_names || !traitsOf(record).about_targets) return std::nullopt;
  if (limits.target_names->empty())
    return tree::Message("mission.no-targets", "looks for targets, and the profile names none");
  for (const tree::Value& value : tree.knownValues(record.node->id(), "target"))
    if (const auto* name = std::get_if<std::string>(&value); name != nullptr && !name->empty())
      if (std::find(limits.target_names->begin(), limits.target_names->end(), *name) == limits.target_names->end())
        return tree::Message("mission.unknown-target", "the profile looks for no `{}`, only for {}", *name,
                             tree::quotedList(*limits.target_names));
  return std::nullopt;
}

constexpr const char* kHeightHint =
    "in a building that is high enough, TakeOff's max_height_m or the vehicle's max_height_m allows more";

std::string metres(double value) { return tree::toString(tree::Value(value)) + " m"; }

bool hasLeaf(const tree::Tree& tree, MapUse use) {
  return std::any_of(tree.nodes().begin(), tree.nodes().end(),
                     [use](const tree::NodeRecord& record) { return traitsOf(record).map == use; });
}

class LimitsCheck {
 public:
  LimitsCheck(const tree::Tree& tree, const MissionLimits& limits)
      : tree_(tree),
        limits_(limits),
        max_height_m_(maxHeightOf_m(tree).value_or(limits.max_height_m)),
        loads_map_(hasLeaf(tree, MapUse::kLoads)),
        in_take_off_frame_(!loads_map_ && !hasLeaf(tree, MapUse::kNeeds)) {}

  std::vector<tree::Problem> find() {
    for (const tree::NodeRecord& record : tree_.nodes()) {
      if (record.manifest == nullptr) continue;
      checkCamera(record);
      checkFileName(record);
      checkModes(record);
      checkClearance(record);
      checkPlaces(record);
    }
    for (const tree::NodeRecord& record : tree_.nodes())
      if (record.manifest != nullptr) checkMap(record);
    return std::move(problems_);
  }

 private:
  void report(const tree::NodeRecord& node, tree::Message message, std::string hint) {
    const int id = node.node->id();
    problems_.push_back(
        {tree_.locationOf(id), node.manifest->id, std::move(message), std::move(hint), tree_.pathOf(id)});
  }
  void report(const tree::NodeRecord& node, const char* port, tree::Message message, std::string hint = {}) {
    const int id = node.node->id();
    problems_.push_back({tree_.locationOf(id, port), node.manifest->id + "." + port, std::move(message),
                         std::move(hint), tree_.pathOf(id)});
  }

  /// Each value of that type that the port may have.
  template <typename T, typename Check>
  void forEachValue(const tree::NodeRecord& node, const char* port, Check check) const {
    for (const tree::Value& value : tree_.knownValues(node.node->id(), port))
      if (const T* known = std::get_if<T>(&value)) check(*known);
  }

  void checkCamera(const tree::NodeRecord& node) {
    if (traitsOf(node).needs_camera && !limits_.has_camera)
      report(node, tree::Message("mission.no-camera", "needs an RGB-D camera, and the vehicle has none"),
             "fly with a profile that has one: --system swiftlet_3d, or system: in a trial");
    if (auto problem = targetProblem(tree_, node, limits_))
      report(node, *std::move(problem), "name it in autonomy.estimator.targets.classes of the profile");
  }

  void checkFileName(const tree::NodeRecord& node) {
    if (!traitsOf(node).writes_file) return;
    forEachValue<std::string>(node, "file", [&](const std::string& file) {
      if (auto problem = fileNameProblem(file)) report(node, "file", *std::move(problem));
    });
  }

  void checkModes(const tree::NodeRecord& node) {
    forEachValue<std::string>(node, "modes", [&](const std::string& modes) {
      if (const auto read = modesOf(modes); !read) report(node, "modes", read.error());
    });
  }

  void checkClearance(const tree::NodeRecord& node) {
    if (!limits_.clearance_problems) return;
    forEachValue<double>(node, "clearance_m", [&](double clearance_m) {
      for (const common::Problem& problem : limits_.clearance_problems(clearance_m))
        report(node, "clearance_m",
               tree::Message("mission.clearance", "{} cannot be flown with this system: {}", metres(clearance_m),
                             toString(problem)),
               "raise it, or change that distance in the system profile");
    });
  }

  /// All that can be judged without a map.
  void checkPlaces(const tree::NodeRecord& node) {
    const double least_m = limits_.least_measured_height_m;
    const auto checkGoal = [&](const char* port, const common::Goal& goal) {
      const auto verdict = common::judgeGoal(goal, {.greatest_height_m = max_height_m_}, nullptr);
      const bool height = !verdict && verdict.error().reason == common::GoalRefusal::Reason::kHeight;
      if (!verdict)
        report(node, port, tree::Message("mission.goal-refused", "{}", verdict.error().text),
               height ? kHeightHint : "");
      if (verdict && goal.height_m.value_or(least_m) < least_m)
        report(node, port,
               tree::Message("mission.height-low",
                             "{} is below {}, from which on the beams down of the laser measure the height "
                             "(range_min_m)",
                             metres(*goal.height_m), metres(std::ceil(100.0 * least_m) / 100.0)),
               "name a higher one, or fly with a laser of a smaller range_min_m");
    };
    // A height is judged as that of a goal above the take-off place.
    forEachValue<double>(node, "height_m", [&](double height_m) { checkGoal("height_m", {.height_m = height_m}); });
    forEachValue<double>(node, "max_height_m", [&](double height_m) {
      if (height_m > limits_.measured_height_m)
        report(node, "max_height_m",
               tree::Message("mission.height-unmeasured",
                             "{} is above {}, up to which the beams down of the laser measure the height",
                             metres(height_m), metres(std::floor(100.0 * limits_.measured_height_m) / 100.0)),
               "name a lower one, or fly with a laser that reaches farther");
    });
    forEachValue<tree::Points>(node, "polygon",
                               [&](const tree::Points& corners) { checkArea(node, polygonOf(corners)); });
    forEachValue<tree::Point>(node, "goal", [&](const tree::Point& goal) {
      checkGoal("goal", {.place_map_m = {goal.x, goal.y}, .height_m = goal.z});
    });
  }

  void checkArea(const tree::NodeRecord& node, const common::Polygon& area) {
    const bool keeps_out = traitsOf(node).keeps_out;
    if (const auto problem = problemOf(area))
      return report(node, "polygon", tree::Message("mission.polygon", "{}", problem->text()),
                    "give the corners in order along the edge");
    if (auto large = keeps_out ? std::nullopt : surveyProblem(area))
      return report(node, "polygon", *std::move(large), "survey it in parts");
    if (keeps_out && in_take_off_frame_ && area.contains(Eigen::Vector2d::Zero()))
      report(node, "polygon", tree::Message("mission.home-kept-out", "holds the take-off place 0;0"),
             "the vehicle could not fly home: leave the place out");
  }

  void checkMap(const tree::NodeRecord& node) {
    const MapUse use = traitsOf(node).map;
    if (use == MapUse::kNeeds && !limits_.has_map && !loads_map_)
      report(node, tree::Message("mission.no-map", "needs a map of the place, and the flight has none"),
             "give it one: LoadMap, swiftlet fly --map MAP.yaml, or map: in a trial");
    if (use != MapUse::kLoads || !limits_.map_problem) return;
    forEachValue<std::string>(node, "file", [&](const std::string& file) {
      std::optional<common::Problem> problem = limits_.map_problem(file, tree_.locationOf(node.node->id()).file);
      if (!problem) return;
      const std::string hint = std::exchange(problem->hint, {});
      std::string text = toString(*problem);
      if (text.find(file) == std::string::npos) text = "`" + file + "`: " + text;
      report(node, "file", tree::Message("mission.map-unusable", "{}", text),
             hint.empty() ? "a map is the YAML file of map_server, as a run writes map.yaml" : hint);
    });
  }

  const tree::Tree& tree_;
  const MissionLimits& limits_;
  double max_height_m_;
  bool loads_map_;
  bool in_take_off_frame_;  ///< Otherwise the places of the mission are those of a given map.
  std::vector<tree::Problem> problems_;
};

}  // namespace

std::vector<tree::Problem> limitProblems(const tree::Tree& tree, const MissionLimits& limits) {
  return LimitsCheck(tree, limits).find();
}

std::optional<double> maxHeightOf_m(const tree::Tree& tree) {
  std::optional<double> greatest_m;
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (traitsOf(record).vehicle != VehicleUse::kTakesOff) continue;
    for (const tree::Value& value : tree.knownValues(record.node->id(), "max_height_m"))
      if (const auto* height_m = std::get_if<double>(&value))
        greatest_m = std::max(greatest_m.value_or(*height_m), *height_m);
  }
  return greatest_m;
}

bool fliesHomeOnFailure(const tree::Tree& tree) {
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (traitsOf(record).vehicle != VehicleUse::kTakesOff) continue;
    for (const tree::Value& value : tree.knownValues(record.node->id(), "home_on_failure"))
      if (const auto* home = std::get_if<bool>(&value); home != nullptr && !*home) return false;
  }
  return true;
}

}  // namespace swiftlet::behaviors
