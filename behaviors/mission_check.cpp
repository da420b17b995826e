#include "behaviors/mission_check.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/follow_path.hpp"
#include "behaviors/mission_warnings.hpp"
#include "behaviors/ports.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"
#include "common/goal.hpp"

namespace swiftlet::behaviors {
namespace {

/// Possible positions of the vehicle at a point of the tree: on the floor or in the air.
struct Whereabouts {
  bool ground = false;
  bool air = false;
};

Whereabouts either(Whereabouts a, Whereabouts b) { return {a.ground || b.ground, a.air || b.air}; }
bool nowhere(Whereabouts w) { return !w.ground && !w.air; }

/// Possible positions when a node ended, for each result.
struct Exits {
  Whereabouts success;
  Whereabouts failure;
};

/// Walks the tree in the order of ticking and tracks the possible positions of the vehicle.
class Walk {
 public:
  Walk(const tree::Tree& tree, std::vector<tree::Problem>& problems)
      : tree_(tree), problems_(problems), skips_(tree.nodes().size()) {
    // Preorder: children come after their parents.
    for (std::size_t i = tree.nodes().size(); i-- > 0;) skips_[i] = computeMaySkip(tree.nodes()[i]);
  }

  Exits walk(const tree::Node& node, Whereabouts entry) {
    const tree::NodeManifest* manifest = manifestOf(node);
    const std::string_view id = manifest == nullptr ? std::string_view("SubTree") : std::string_view(manifest->id);
    if (node.children().empty()) return walkLeaf(node, id, entry);
    // AsyncSequence, ReactiveSequence and SequenceWithMemory differ only in when they tick their children again.
    if (id.find("Sequence") != std::string_view::npos) return walkChain(node, entry, true);
    if (id.find("Fallback") != std::string_view::npos) return walkChain(node, entry, false);
    if (id == "Priority") return walkPriority(node, entry);
    if (node.children().size() > 1) return walkAnyOrder(node, entry);
    return walkDecorator(node, id, entry);
  }

  bool takesOff() const { return takes_off_; }
  bool maySkip(const tree::Node& node) const { return skips_[static_cast<std::size_t>(node.id())]; }

 private:
  const tree::NodeManifest* manifestOf(const tree::Node& node) const {
    return tree_.nodes()[static_cast<std::size_t>(node.id())].manifest;
  }

  bool computeMaySkip(const tree::NodeRecord& record) const {
    if (record.manifest != nullptr && record.manifest->id == "Delay") return false;
    const auto& children = record.node->children();
    if (children.empty()) return record.manifest != nullptr && record.manifest->may_skip;
    return std::all_of(children.begin(), children.end(), [&](const auto& child) { return maySkip(*child); });
  }

  Exits walkLeaf(const tree::Node& node, std::string_view id, Whereabouts entry) {
    if (nowhere(entry)) return {};
    if (id == "TakeOff") {
      takes_off_ = true;
      return {{false, true}, {entry.ground, true}};
    }
    if (id == "AlwaysSuccess" || id == "SetBlackboard" || id == "LogEvent" || id == "SetFlightMode") return {entry, {}};
    if (id == "AlwaysFailure") return {{}, entry};
    // Leaves that may be SKIPPED ask for the vehicle only in flight.
    const bool flies = dynamic_cast<const FlightLeaf*>(&node) != nullptr && !maySkip(node);
    if (flies && !entry.air)
      problems_.push_back({tree_.locationOf(node.id()),
                           std::string(id),
                           "the vehicle stands on the floor here, expected a TakeOff before it",
                           {},
                           tree_.pathOf(node.id())});
    if (id == "Land" || id == "EmergencyLand") return {{true, false}, entry};
    if (id == "OperatorCommand") return {{}, entry};
    return {entry, entry};
  }

  /// A Sequence continues after SUCCESS, a Fallback after FAILURE; both continue after SKIPPED.
  Exits walkChain(const tree::Node& node, Whereabouts entry, bool on_success) {
    Exits exits;
    Whereabouts at = entry;
    for (const auto& child : node.children()) {
      const Exits child_exits = walk(*child, at);
      Whereabouts& out = on_success ? exits.failure : exits.success;
      out = either(out, on_success ? child_exits.failure : child_exits.success);
      const Whereabouts on = on_success ? child_exits.success : child_exits.failure;
      at = maySkip(*child) ? either(at, on) : on;
    }
    (on_success ? exits.success : exits.failure) = at;
    return exits;
  }

  Exits walkPriority(const tree::Node& node, Whereabouts entry) {
    Exits exits;
    Whereabouts at = entry;
    for (const auto& child : node.children()) {
      const Exits child_exits = walk(*child, at);
      exits.failure = either(exits.failure, child_exits.failure);
      at = maySkip(*child) ? either(at, child_exits.success) : child_exits.success;
      if (child == node.children().back() || maySkip(*child)) continue;
      problems_.push_back({tree_.locationOf(child->id()), child->name(),
                           "never answers SKIPPED, so that no child below it in the Priority gets the vehicle",
                           "only a leaf that can be SKIPPED (AvoidObstacle, Hold) may stand above another child",
                           tree_.pathOf(child->id())});
    }
    exits.success = at;
    return exits;
  }

  /// Parallel, IfThenElse, Switch ...: a child may begin where the node began, or where any child before it has ended.
  Exits walkAnyOrder(const tree::Node& node, Whereabouts entry) {
    Exits all;
    Whereabouts anywhere = entry;
    for (const auto& child : node.children()) {
      const Exits exits = walk(*child, anywhere);
      anywhere = either(anywhere, either(exits.success, exits.failure));
    }
    all.success = all.failure = anywhere;
    return all;
  }

  Exits walkDecorator(const tree::Node& node, std::string_view id, Whereabouts entry) {
    Exits exits = walk(*node.children().front(), entry);
    const Whereabouts both = either(exits.success, exits.failure);
    if (id == "Inverter") return {exits.failure, exits.success};
    if (id == "ForceSuccess") return {both, {}};
    if (id == "ForceFailure") return {{}, both};
    if (id == "Timeout") return {exits.success, either(entry, both)};
    return exits;
  }

  const tree::Tree& tree_;
  std::vector<tree::Problem>& problems_;
  std::vector<bool> skips_;
  bool takes_off_ = false;
};

bool isAboutTargets(std::string_view id) {
  return id == "LocateTarget" || id == "IsTargetFound" || id == "ExploreUntilFound";
}
bool needsCamera(std::string_view id) {
  return id == "Photograph" || id == "Inspect" || id == "LookAround" || isAboutTargets(id);
}

/// "`red`, `blue`".
std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
  return text;
}

/// What is wrong with the targets that a node names; empty if nothing is.
std::string targetProblem(const tree::Tree& tree, const tree::NodeRecord& record, const MissionLimits& limits) {
  if (!limits.has_camera || !limits.target_names || !isAboutTargets(record.manifest->id)) return {};
  if (limits.target_names->empty()) return "looks for targets, and the profile names none";
  for (const tree::Value& value : tree.knownValues(record.node->id(), "target"))
    if (const auto* name = std::get_if<std::string>(&value); name != nullptr && !name->empty())
      if (std::find(limits.target_names->begin(), limits.target_names->end(), *name) == limits.target_names->end())
        return "the profile looks for no `" + *name + "`, only for " + joined(*limits.target_names);
  return {};
}

struct AreaProblem {
  std::string problem;  ///< Empty without one.
  const char* hint = "";
};
AreaProblem areaProblem(const common::Polygon& area, std::string_view id, bool in_take_off_frame) {
  if (std::string problem = problemOf(area); !problem.empty())
    return {std::move(problem), "give the corners in order along the edge"};
  if (in_take_off_frame && id == "KeepOut" && area.contains(Eigen::Vector2d::Zero()))
    return {"holds the take-off place 0;0", "the vehicle could not fly home: leave the place out"};
  return {};
}

constexpr const char* kHeightHint =
    "in a building that is high enough, TakeOff's max_height_m or the vehicle's max_height_m allows more";

std::string metres(double value) { return tree::toString(tree::Value(value)) + " m"; }

bool hasLeaf(const tree::Tree& tree, std::string_view id) {
  return std::any_of(tree.nodes().begin(), tree.nodes().end(), [id](const tree::NodeRecord& record) {
    return record.manifest != nullptr && record.manifest->id == id;
  });
}

void checkMaps(const tree::Tree& tree, const MissionLimits& limits, std::vector<tree::Problem>& problems) {
  const bool loads = hasLeaf(tree, "LoadMap");
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (record.manifest == nullptr) continue;
    const int id = record.node->id();
    const std::string& leaf = record.manifest->id;
    if ((leaf == "Localize" || leaf == "Relocalize") && !limits.has_map && !loads)
      problems.push_back({tree.locationOf(id), leaf, "needs a map of the place, and the flight has none",
                          "give it one: LoadMap, swiftlet fly --map MAP.yaml, or map: in a trial", tree.pathOf(id)});
    if (leaf != "LoadMap" || !limits.map_problem) continue;
    const std::vector<tree::Value> files = tree.knownValues(id, "file");
    for (const tree::Value& value : files)
      if (const auto* file = std::get_if<std::string>(&value))
        if (std::string problem = limits.map_problem(*file, tree.locationOf(id).file); !problem.empty())
          problems.push_back({tree.locationOf(id, "file"), "LoadMap.file", std::move(problem),
                              "a map is the YAML file of map_server, as a run writes map.yaml", tree.pathOf(id)});
  }
}

void checkLimits(const tree::Tree& tree, const MissionLimits& limits, std::vector<tree::Problem>& problems) {
  const double max_height_m = maxHeightOf_m(tree).value_or(limits.max_height_m);
  const auto report = [&](const tree::Node& node, const tree::NodeManifest& manifest, const char* port,
                          std::string message, const char* hint) {
    problems.push_back(
        {tree.locationOf(node.id(), port), manifest.id + "." + port, std::move(message), hint, tree.pathOf(node.id())});
  };
  // In a mission that localizes, the places are those of the given map.
  const bool in_take_off_frame = !hasLeaf(tree, "Localize") && !hasLeaf(tree, "LoadMap");
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (record.manifest == nullptr) continue;
    const int id = record.node->id();
    if (needsCamera(record.manifest->id) && !limits.has_camera)
      problems.push_back({tree.locationOf(id), record.manifest->id, "needs an RGB-D camera, and the vehicle has none",
                          "fly with a profile that has one: --system swiftlet_3d, or system: in a trial",
                          tree.pathOf(id)});
    if (const std::string problem = targetProblem(tree, record, limits); !problem.empty())
      problems.push_back({tree.locationOf(id), record.manifest->id, problem,
                          "name it in autonomy.estimator.targets.classes of the profile", tree.pathOf(id)});
    const bool names_file = record.manifest->id == "Photograph" || record.manifest->id == "SaveMap";
    for (const tree::Value& value : tree.knownValues(id, "file"))
      if (const auto* file = std::get_if<std::string>(&value); names_file && file != nullptr)
        if (const std::string problem = fileNameProblem(*file); !problem.empty())
          report(*record.node, *record.manifest, "file", problem, "");
    for (const tree::Value& value : tree.knownValues(id, "modes"))
      if (const auto* modes = std::get_if<std::string>(&value))
        if (const auto read = modesOf(*modes); !read) report(*record.node, *record.manifest, "modes", read.error(), "");
    for (const tree::Value& value : tree.knownValues(id, "clearance_m"))
      if (const auto* clearance_m = std::get_if<double>(&value); clearance_m != nullptr && limits.clearance_problems)
        for (const std::string& problem : limits.clearance_problems(*clearance_m))
          report(*record.node, *record.manifest, "clearance_m",
                 metres(*clearance_m) + " cannot be flown with this system: " + problem,
                 "raise it, or change that distance in the system profile");
    // Goals, and the place above the floor where it takes off: all that can be judged without a map.
    const auto checkGoal = [&](const char* port, const common::Goal& goal) {
      const auto verdict = common::judgeGoal(goal, {.greatest_height_m = max_height_m}, nullptr);
      const bool height = !verdict && verdict.error().reason == common::GoalRefusal::Reason::kHeight;
      if (!verdict) report(*record.node, *record.manifest, port, verdict.error().text, height ? kHeightHint : "");
    };
    for (const tree::Value& value : tree.knownValues(id, "height_m"))
      if (const auto* height_m = std::get_if<double>(&value)) checkGoal("height_m", {.height_m = *height_m});
    for (const tree::Value& value : tree.knownValues(id, "polygon"))
      if (const auto* corners = std::get_if<tree::Points>(&value))
        if (const auto [problem, hint] = areaProblem(polygonOf(*corners), record.manifest->id, in_take_off_frame);
            !problem.empty())
          report(*record.node, *record.manifest, "polygon", problem, hint);
    for (const tree::Value& value : tree.knownValues(id, "goal"))
      if (const auto* goal = std::get_if<tree::Point>(&value))
        checkGoal("goal", {.place_map_m = {goal->x, goal->y}, .height_m = goal->z});
  }
}

MissionVerdict verdictOf(tree::ParseResult parsed, const MissionLimits& limits) {
  if (parsed.tree) {
    parsed.problems = semanticProblems(*parsed.tree, limits);
    const std::vector<tree::Problem> found = missionWarnings(*parsed.tree);
    parsed.warnings.insert(parsed.warnings.end(), found.begin(), found.end());
  }
  return {std::move(parsed.problems), std::move(parsed.warnings), {}};
}

/// "3 of the engine: Sequence, Timeout", one line for each owner that has a node in the tree.
std::vector<std::string> ownersOf(const tree::Tree& tree, const std::vector<tree::Mock>& mocks) {
  struct Owner {
    const char* title;
    int nodes = 0;
    std::map<std::string, std::string> types = {};  ///< With a remark.
  };
  std::array<Owner, 3> owners = {{{"of the engine"}, {"of Swiftlet"}, {"mocks"}}};
  const tree::Registry engine = tree::Registry::standard();
  for (const tree::NodeRecord& record : tree.nodes()) {
    const std::string id = record.manifest == nullptr ? "SubTree" : record.manifest->id;
    const auto mock = std::find_if(mocks.begin(), mocks.end(), [&](const tree::Mock& known) { return known.id == id; });
    Owner& owner = owners[mock != mocks.end() ? 2 : record.manifest == nullptr || engine.find(id) != nullptr ? 0 : 1];
    ++owner.nodes;
    std::string& remark = owner.types[id];
    if (mock == mocks.end()) continue;
    if (!mock->instead_of_port.empty())
      remark = " (Swiftlet's has no port `" + mock->instead_of_port + "`)";
    else if (!record.node->children().empty())
      remark = " (as a Sequence)";
  }
  std::vector<std::string> lines;
  for (const Owner& owner : owners) {
    if (owner.nodes == 0) continue;
    std::string line = std::to_string(owner.nodes) + " " + owner.title + ":";
    for (const auto& [id, remark] : owner.types) line += (line.ends_with(':') ? " " : ", ") + std::string(id) + remark;
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

MissionVerdict judgeMission(const std::string& path, const MissionLimits& limits) {
  return verdictOf(tree::parseFile(path, missionRegistry()), limits);
}

MissionVerdict judgeMissionWithMocks(const std::string& path, const MissionLimits& limits) {
  const tree::MockedRegistry mocked = tree::withMocks(path, missionRegistry());
  tree::ParseResult parsed = tree::parseFile(path, mocked.registry);
  std::vector<std::string> whose;
  if (parsed.tree) whose = ownersOf(*parsed.tree, mocked.mocks);
  if (parsed.tree && !mocked.mocks.empty()) return {{}, std::move(parsed.warnings), std::move(whose)};
  MissionVerdict verdict = verdictOf(std::move(parsed), limits);
  if (verdict.problems.empty()) verdict.whose = std::move(whose);
  return verdict;
}

MissionVerdict judgeMissionText(const std::string& text, const std::string& name, const MissionLimits& limits) {
  return verdictOf(tree::parseText(text, name, missionRegistry()), limits);
}

std::vector<common::Problem> toCommon(const std::vector<tree::Problem>& problems) {
  std::vector<common::Problem> result;
  for (const tree::Problem& problem : problems)
    result.push_back({{problem.location.file, problem.location.line, problem.location.column},
                      problem.element,
                      problem.message,
                      problem.hint});
  return result;
}

std::optional<double> maxHeightOf_m(const tree::Tree& tree) {
  std::optional<double> greatest_m;
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (record.manifest == nullptr || record.manifest->id != "TakeOff") continue;
    for (const tree::Value& value : tree.knownValues(record.node->id(), "max_height_m"))
      if (const auto* height_m = std::get_if<double>(&value))
        greatest_m = std::max(greatest_m.value_or(*height_m), *height_m);
  }
  return greatest_m;
}

std::vector<std::string> mapFilesOf(const tree::Tree& tree) {
  std::vector<std::string> files;
  for (const tree::NodeRecord& record : tree.nodes()) {
    if (record.manifest == nullptr || record.manifest->id != "LoadMap") continue;
    for (const tree::Value& value : tree.knownValues(record.node->id(), "file"))
      if (const auto* file = std::get_if<std::string>(&value))
        if (std::find(files.begin(), files.end(), *file) == files.end()) files.push_back(*file);
  }
  return files;
}

std::vector<tree::Problem> semanticProblems(const tree::Tree& tree, const MissionLimits& limits) {
  std::vector<tree::Problem> problems;
  Walk walk(tree, problems);
  walk.walk(tree.root(), {true, false});
  if (!walk.takesOff() && problems.empty())
    problems.push_back({tree.locationOf(0), tree.name(), "the mission never takes off, expected a TakeOff", {}});
  checkLimits(tree, limits, problems);
  checkMaps(tree, limits, problems);
  return problems;
}

std::vector<common::Problem> checkMission(const std::string& path, const MissionLimits& limits) {
  return toCommon(judgeMission(path, limits).problems);
}

std::vector<common::Problem> checkMissionText(const std::string& text, const std::string& name,
                                              const MissionLimits& limits) {
  return toCommon(judgeMissionText(text, name, limits).problems);
}

}  // namespace swiftlet::behaviors
