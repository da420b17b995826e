#include "behaviors/flight_order.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "behaviors/flight_leaf.hpp"
#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/outcomes.hpp"

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
    Exits exits = walkRule(node, entry);
    const tree::Conditions* conditions = tree_.conditionsOf(node.id());
    if (conditions == nullptr) return exits;
    if (conditions->has(tree::ConditionKind::kSuccessIf)) exits.success = either(exits.success, entry);
    if (conditions->has(tree::ConditionKind::kFailureIf)) exits.failure = either(exits.failure, entry);
    return exits;
  }

  bool takesOff() const { return takes_off_; }
  bool maySkip(const tree::Node& node) const { return skips_[static_cast<std::size_t>(node.id())]; }

 private:
  Exits walkRule(const tree::Node& node, Whereabouts entry) {
    const std::string_view id = typeNameOf(recordOf(node));
    if (node.children().empty()) return walkLeaf(node, id, entry);
    // AsyncSequence, ReactiveSequence and SequenceWithMemory differ only in when they tick their children again.
    if (id.find("Sequence") != std::string_view::npos) return walkChain(node, entry, true);
    if (id.find("Fallback") != std::string_view::npos) return walkChain(node, entry, false);
    if (id == "Priority") return walkPriority(node, entry);
    if (id == "IfThenElse") return walkIfThenElse(node, entry);
    if (node.children().size() > 1) return walkAnyOrder(node, entry, !id.starts_with("Parallel"));
    return walkDecorator(node, id, entry);
  }

  const tree::NodeRecord& recordOf(const tree::Node& node) const {
    return tree_.nodes()[static_cast<std::size_t>(node.id())];
  }

  /// Whether the node may answer that it does not want the vehicle.
  bool computeMaySkip(const tree::NodeRecord& record) const {
    const int id = record.node->id();
    const tree::Conditions* conditions = tree_.conditionsOf(id);
    if (conditions != nullptr &&
        (conditions->has(tree::ConditionKind::kSkipIf) || conditions->has(tree::ConditionKind::kWhile)))
      return true;
    const std::string_view type = typeNameOf(record);
    if (type == "Delay" || type == "KeepRunningUntilFailure") return false;
    if (type == "RunOnce") return mayBe(id, "then_skip", true);
    if (type == "SkipUnlessUpdated") return true;
    if (type == "Precondition" && mayBe(id, "else", std::string("SKIPPED"))) return true;
    const auto& children = record.node->children();
    if (children.empty()) return record.manifest != nullptr && record.manifest->may_skip;
    return std::all_of(children.begin(), children.end(), [&](const auto& child) { return maySkip(*child); });
  }

  bool mayBe(int id, std::string_view port, const tree::Value& value) const {
    const std::vector<tree::Value> values = tree_.knownValues(id, port);
    return std::find(values.begin(), values.end(), value) != values.end();
  }

  Exits walkLeaf(const tree::Node& node, std::string_view id, Whereabouts entry) {
    if (nowhere(entry)) return {};
    if (id == "TakeOff") {
      takes_off_ = true;
      return {{false, true}, {entry.ground, true}};
    }
    if (id == "AlwaysSuccess" || id == "SetBlackboard" || id == "LogEvent" || id == "SetFlightMode") return {entry, {}};
    if (id == "AlwaysFailure") return {{}, entry};
    // AvoidObstacle and Hold ask for the vehicle only in flight.
    const bool flies = dynamic_cast<const FlightLeaf*>(&node) != nullptr && !recordOf(node).manifest->may_skip;
    if (flies && !entry.air)
      problems_.push_back({tree_.locationOf(node.id()),
                           std::string(id),
                           "the vehicle stands on the floor here, expected a TakeOff before it",
                           {},
                           tree_.pathOf(node.id())});
    if (id == "Land" || id == "EmergencyLand") return {{true, false}, entry};
    if (neverSucceeds(tree_, recordOf(node))) return {{}, entry};
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
      problems_.push_back(
          {tree_.locationOf(child->id()), child->name(),
           "never answers SKIPPED, so that no child below it in the Priority gets the vehicle",
           "only what can be SKIPPED may stand above another child: AvoidObstacle, Hold, or a node with _skipIf",
           tree_.pathOf(child->id())});
    }
    exits.success = at;
    return exits;
  }

  Exits walkIfThenElse(const tree::Node& node, Whereabouts entry) {
    const auto& children = node.children();
    const Exits condition = walk(*children[0], entry);
    Exits exits = walkSkippable(*children[1], condition.success);
    if (children.size() == 2) return {exits.success, either(exits.failure, condition.failure)};
    const Exits other = walkSkippable(*children[2], condition.failure);
    return {either(exits.success, other.success), either(exits.failure, other.failure)};
  }

  /// A child that succeeds where it is when it is skipped.
  Exits walkSkippable(const tree::Node& node, Whereabouts entry) {
    const Exits exits = walk(node, entry);
    return {maySkip(node) ? either(exits.success, entry) : exits.success, exits.failure};
  }

  /// Parallel, Switch, WhileDoElse ...: a child may begin where the node began, or where any child before it has ended.
  /// With `one_ends` it succeeds where one of its children does.
  Exits walkAnyOrder(const tree::Node& node, Whereabouts entry, bool one_ends) {
    Whereabouts success, anywhere = entry;
    for (const auto& child : node.children()) {
      const Exits exits = walkSkippable(*child, anywhere);
      anywhere = either(anywhere, either(exits.success, exits.failure));
      const bool condition = child == node.children().front() && typeNameOf(recordOf(node)) == "WhileDoElse";
      if (!condition) success = either(success, exits.success);
    }
    return {one_ends ? success : anywhere, anywhere};
  }

  Exits walkDecorator(const tree::Node& node, std::string_view id, Whereabouts entry) {
    Exits exits = walk(*node.children().front(), entry);
    const Whereabouts both = either(exits.success, exits.failure);
    if (id == "Inverter") return {exits.failure, exits.success};
    if (id == "ForceSuccess") return {both, {}};
    if (id == "ForceFailure") return {{}, both};
    if (id == "KeepRunningUntilFailure" || isForever(node, id, "Repeat", "num_cycles")) return {{}, exits.failure};
    if (isForever(node, id, "RetryUntilSuccessful", "num_attempts")) return {exits.success, {}};
    if (id == "Precondition" || id == "RunOnce") return {either(entry, exits.success), either(entry, exits.failure)};
    if (id == "Timeout") return {exits.success, either(entry, both)};
    return exits;
  }

  bool isForever(const tree::Node& node, std::string_view id, std::string_view type, std::string_view port) const {
    return id == type && tree::isAlways(tree_, recordOf(node), port, -1);
  }

  const tree::Tree& tree_;
  std::vector<tree::Problem>& problems_;
  std::vector<bool> skips_;
  bool takes_off_ = false;
};

}  // namespace

bool neverSucceeds(const tree::Tree& tree, const tree::NodeRecord& leaf) {
  const std::string_view id = typeNameOf(leaf);
  return id == "OperatorCommand" || id == "FollowMe" || (id == "Patrol" && tree::isAlways(tree, leaf, "rounds", 0));
}

std::vector<tree::Problem> flightOrderProblems(const tree::Tree& tree) {
  std::vector<tree::Problem> problems;
  Walk walk(tree, problems);
  walk.walk(tree.root(), {true, false});
  if (!walk.takesOff() && problems.empty())
    problems.push_back(
        {tree.locationOf(0), tree.name(), "the mission never takes off, expected a TakeOff", {}, tree.pathOf(0)});
  return problems;
}

bool mayEndInTheAir(const tree::Tree& tree) {
  std::vector<tree::Problem> ignored;
  Walk walk(tree, ignored);
  return walk.walk(tree.root(), {true, false}).success.air;
}

}  // namespace swiftlet::behaviors
