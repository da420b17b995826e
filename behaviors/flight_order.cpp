#include "behaviors/flight_order.hpp"

#include <string>
#include <string_view>

#include "behaviors/leaf_traits.hpp"
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
      : tree_(tree), problems_(problems), outcomes_(missionOutcomes(tree)), reported_(tree.nodes().size()) {}

  Exits walk(const tree::Node& node, Whereabouts entry) {
    Exits exits = walkRule(node, entry);
    if (const tree::Conditions* conditions = tree_.conditionsOf(node.id())) {
      if (conditions->has(tree::ConditionKind::kSuccessIf)) exits.success = either(exits.success, entry);
      if (conditions->has(tree::ConditionKind::kFailureIf)) exits.failure = either(exits.failure, entry);
    }
    const tree::Outcomes& may = outcomesOf(node);
    return {may.success ? exits.success : Whereabouts{}, may.failure ? exits.failure : Whereabouts{}};
  }

  bool takesOff() const { return takes_off_; }

 private:
  Exits walkRule(const tree::Node& node, Whereabouts entry) {
    const std::string_view id = typeNameOf(recordOf(node));
    if (node.children().empty()) return walkLeaf(node, id, entry);
    if (const tree::ChainRule chain = tree::chainOf(recordOf(node)); chain != tree::ChainRule::kNone)
      return walkChain(node, entry, chain == tree::ChainRule::kSequence);
    if (id == "Priority") return walkPriority(node, entry);
    if (id == "IfThenElse") return walkIfThenElse(node, entry);
    if (node.children().size() > 1) return walkAnyOrder(node, entry, !id.starts_with("Parallel"));
    return walkDecorator(node, id, entry);
  }

  const tree::NodeRecord& recordOf(const tree::Node& node) const {
    return tree_.nodes()[static_cast<std::size_t>(node.id())];
  }

  const tree::Outcomes& outcomesOf(const tree::Node& node) const {
    return outcomes_[static_cast<std::size_t>(node.id())];
  }

  /// Whether the node may be SKIPPED.
  bool maySkip(const tree::Node& node) const { return outcomesOf(node).skipped; }

  Exits walkLeaf(const tree::Node& node, std::string_view id, Whereabouts entry) {
    if (nowhere(entry)) return {};
    const auto use = traitsOf(recordOf(node)).vehicle;
    if (use == VehicleUse::kNone) return {entry, entry};
    if (use == VehicleUse::kTakesOff) {
      takes_off_ = true;
      return {{false, true}, {entry.ground, true}};
    }
    if (!entry.air && !reported_[static_cast<std::size_t>(node.id())]) {
      reported_[static_cast<std::size_t>(node.id())] = true;
      problems_.push_back(
          {tree_.locationOf(node.id()),
           std::string(id),
           tree::Message("mission.on-the-floor", "the vehicle stands on the floor {}, expected a TakeOff before it",
                         in_next_round_ ? "when this is repeated" : "here"),
           {},
           tree_.pathOf(node.id())});
    }
    return {use == VehicleUse::kLands ? Whereabouts{true, false} : entry, entry};
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
           tree::Message("mission.never-skipped",
                         "never answers SKIPPED, so that no child below it in the Priority gets the vehicle"),
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
    const tree::Node& child = *node.children().front();
    // After its time a Delay ends without a move if its child is SKIPPED.
    const bool stays = id == "Precondition" || id == "RunOnce" || (id == "Delay" && maySkip(child));
    const Exits exits = walk(child, entry);
    walkNextRound(node, id, exits);
    const Whereabouts both = either(exits.success, exits.failure);
    if (id == "Inverter") return {exits.failure, exits.success};
    if (id == "ForceSuccess" || id == "ForceFailure") return {both, both};
    if (stays) return {either(entry, exits.success), either(entry, exits.failure)};
    if (id == "Timeout") return {exits.success, either(entry, both)};
    return exits;
  }

  /// A node that repeats its child begins again where the child has ended. Repeats inside of that round are walked
  /// once, so that nested ones do not double the walk at each level.
  void walkNextRound(const tree::Node& node, std::string_view id, const Exits& first) {
    const bool after_failure = id == "RetryUntilSuccessful";
    const bool repeats = after_failure || id == "Repeat" || id == "KeepRunningUntilFailure" || id.starts_with("Loop");
    if (!repeats || in_next_round_) return;
    if (tree::isAlways(tree_, recordOf(node), after_failure ? "num_attempts" : "num_cycles", 1)) return;
    in_next_round_ = true;
    walk(*node.children().front(), after_failure ? first.failure : first.success);
    in_next_round_ = false;
  }

  const tree::Tree& tree_;
  std::vector<tree::Problem>& problems_;
  std::vector<tree::Outcomes> outcomes_;  ///< By node id.
  std::vector<bool> reported_;            ///< Leaves, by node id.
  bool takes_off_ = false;
  bool in_next_round_ = false;
};

}  // namespace

std::vector<tree::Problem> flightOrderProblems(const tree::Tree& tree) {
  std::vector<tree::Problem> problems;
  Walk walk(tree, problems);
  walk.walk(tree.root(), {true, false});
  if (!walk.takesOff() && problems.empty())
    problems.push_back({tree.locationOf(0),
                        tree.name(),
                        tree::Message("mission.no-take-off", "the mission never takes off, expected a TakeOff"),
                        {},
                        tree.pathOf(0)});
  return problems;
}

bool mayEndInTheAir(const tree::Tree& tree) {
  std::vector<tree::Problem> ignored;
  Walk walk(tree, ignored);
  return walk.walk(tree.root(), {true, false}).success.air;
}

}  // namespace swiftlet::behaviors
