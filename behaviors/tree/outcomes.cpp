#include "behaviors/tree/outcomes.hpp"

#include <algorithm>
#include <string_view>

#include "behaviors/tree/conditions.hpp"

namespace swiftlet::tree {
namespace {

constexpr Outcomes kAny{true, true, true};

Outcomes either(Outcomes a, Outcomes b) {
  return {a.success || b.success, a.failure || b.failure, a.skipped || b.skipped};
}

/// How a node asks its children one after the other.
enum class ChainRule : unsigned char { kNone, kSequence, kFallback };

ChainRule chainOf(std::string_view id) {
  if (id.find("Sequence") != std::string_view::npos) return ChainRule::kSequence;
  return id.find("Fallback") != std::string_view::npos ? ChainRule::kFallback : ChainRule::kNone;
}

/// Whether a chain goes on to its next child.
bool goesOn(ChainRule chain, Outcomes child) {
  return child.skipped || (chain == ChainRule::kSequence ? child.success : child.failure);
}

class OutcomeJudge {
 public:
  OutcomeJudge(const Tree& tree, const LeafOutcomes& leaf_outcomes)
      : tree_(tree), leaf_outcomes_(leaf_outcomes), outcomes_(tree.nodes().size()) {}

  std::vector<Outcomes> judge() {
    // Preorder: children come after their parents.
    for (std::size_t i = outcomes_.size(); i-- > 0;)
      outcomes_[i] = withConditions(static_cast<int>(i), ruleOf(tree_.nodes()[i]));
    return std::move(outcomes_);
  }

 private:
  const Outcomes& of(const Node& node) const { return outcomes_[static_cast<std::size_t>(node.id())]; }

  Outcomes ruleOf(const NodeRecord& record) const {
    const auto& children = record.node->children();
    if (record.manifest == nullptr) return children.empty() ? kAny : of(*children.front());
    const std::string_view id = record.manifest->id;
    if (children.empty()) return leafOutcomes(record, id);
    if (chainOf(id) != ChainRule::kNone) return chainOutcomes(record, chainOf(id));
    if (children.size() == 1) return decorated(record, id, of(*children.front()));
    return anyOrder(record, id);
  }

  Outcomes leafOutcomes(const NodeRecord& record, std::string_view id) const {
    if (id == "AlwaysFailure") return {false, true, false};
    for (const char* name : {"AlwaysSuccess", "SetBlackboard", "UnsetBlackboard", "Sleep"})
      if (id == name) return {true, false, false};
    if (leaf_outcomes_)
      if (const auto known = leaf_outcomes_(record)) return *known;
    return {true, true, record.manifest->may_skip};
  }

  Outcomes chainOutcomes(const NodeRecord& record, ChainRule chain) const {
    Outcomes all{false, false, true};
    bool reached = true, any_goes_on = false;
    for (const auto& child : record.node->children()) {
      const Outcomes& end = of(*child);
      all.skipped = all.skipped && end.skipped;
      if (!reached) continue;
      (chain == ChainRule::kSequence ? all.failure : all.success) |=
          chain == ChainRule::kSequence ? end.failure : end.success;
      any_goes_on = any_goes_on || (chain == ChainRule::kSequence ? end.success : end.failure);
      reached = goesOn(chain, end);
    }
    (chain == ChainRule::kSequence ? all.success : all.failure) = reached && any_goes_on;
    return all;
  }

  /// Priority, Parallel, IfThenElse, Switch ...: what their children may.
  Outcomes anyOrder(const NodeRecord& record, std::string_view id) const {
    Outcomes all;
    bool all_skip = true;
    for (const auto& child : record.node->children()) {
      all = either(all, of(*child));
      all_skip = all_skip && of(*child).skipped;
    }
    // A Priority ends as its last child, or well if that is SKIPPED after another one did something.
    if (id == "Priority") {
      const Outcomes& last = of(*record.node->children().back());
      all.success = last.success || (last.skipped && all.success);
    }
    if (id.starts_with("Parallel") || id == "IfThenElse" || id == "WhileDoElse")
      all.success = all.success || all.skipped;
    all.skipped = all_skip;
    return all;
  }

  Outcomes decorated(const NodeRecord& record, std::string_view id, Outcomes child) const {
    const bool ends = child.success || child.failure;
    if (id == "Inverter") return {child.failure, child.success, child.skipped};
    if (id == "ForceSuccess") return {ends, false, child.skipped};
    if (id == "ForceFailure") return {false, ends, child.skipped};
    if (id == "KeepRunningUntilFailure") return {false, child.failure, false};
    if (id == "Repeat") return {child.success && !isForever(record, "num_cycles"), child.failure, child.skipped};
    if (id == "RetryUntilSuccessful")
      return {child.success, child.failure && !isForever(record, "num_attempts"), child.skipped};
    if (id == "Timeout") return {child.success, true, child.skipped};
    if (id == "Delay") return child;
    if (id == "RunOnce" || id == "SkipUnlessUpdated") return {child.success, child.failure, true};
    if (id == "Priority" || id.starts_with("Parallel") || id == "WaitValueUpdate") return child;
    return kAny;
  }

  bool isForever(const NodeRecord& record, std::string_view port) const { return isAlways(tree_, record, port, -1); }

  Outcomes withConditions(int id, Outcomes outcomes) const {
    const Conditions* conditions = tree_.conditionsOf(id);
    if (conditions == nullptr) return outcomes;
    return either(outcomes, {conditions->has(ConditionKind::kSuccessIf), conditions->has(ConditionKind::kFailureIf),
                             conditions->has(ConditionKind::kSkipIf) || conditions->has(ConditionKind::kWhile)});
  }

  const Tree& tree_;
  const LeafOutcomes& leaf_outcomes_;
  std::vector<Outcomes> outcomes_;
};

std::string neverText(const Node& blocker, Outcomes end, ChainRule chain) {
  const bool runs_forever = end == Outcomes{};
  return "`" + blocker.name() + "` before it never " +
         (runs_forever                    ? "ends"
          : chain == ChainRule::kSequence ? "succeeds"
                                          : "fails");
}

}  // namespace

bool isAlways(const Tree& tree, const NodeRecord& record, std::string_view port, std::int64_t number) {
  const std::vector<Value> values = tree.knownValues(record.node->id(), port);
  return !values.empty() && std::all_of(values.begin(), values.end(), [&](const Value& value) {
    const auto* whole = std::get_if<std::int64_t>(&value);
    return whole != nullptr && *whole == number;
  });
}

std::vector<Outcomes> outcomesOf(const Tree& tree, const LeafOutcomes& leaf_outcomes) {
  return OutcomeJudge(tree, leaf_outcomes).judge();
}

std::vector<Unreached> unreachedNodes(const Tree& tree, const std::vector<Outcomes>& outcomes) {
  std::vector<Unreached> found;
  std::vector<bool> listed(tree.nodes().size());  // Itself, or a node above it.
  for (const NodeRecord& record : tree.nodes()) {
    const auto id = static_cast<std::size_t>(record.node->id());
    if (record.parent >= 0 && listed[static_cast<std::size_t>(record.parent)]) listed[id] = true;
    const ChainRule chain = record.manifest == nullptr ? ChainRule::kNone : chainOf(record.manifest->id);
    if (listed[id] || chain == ChainRule::kNone) continue;
    const Node* blocker = nullptr;
    for (const auto& child : record.node->children()) {
      const auto child_id = static_cast<std::size_t>(child->id());
      if (blocker != nullptr) {
        listed[child_id] = true;
        found.push_back({child->id(), neverText(*blocker, outcomes[static_cast<std::size_t>(blocker->id())], chain)});
      } else if (!goesOn(chain, outcomes[child_id])) {
        blocker = child.get();
      }
    }
  }
  return found;
}

}  // namespace swiftlet::tree
