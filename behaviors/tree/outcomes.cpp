#include "behaviors/tree/outcomes.hpp"

#include <algorithm>
#include <string_view>

#include "behaviors/tree/conditions.hpp"
#include "behaviors/tree/nodes/loop.hpp"
#include "behaviors/tree/nodes/switch_node.hpp"

namespace swiftlet::tree {
namespace {

constexpr Outcomes kAny{true, true, true};

Outcomes either(Outcomes a, Outcomes b) {
  return {a.success || b.success, a.failure || b.failure, a.skipped || b.skipped};
}

/// Whether a chain goes on to its next child.
bool goesOn(ChainRule chain, Outcomes child) {
  return child.skipped || (chain == ChainRule::kSequence ? child.success : child.failure);
}

/// "its `_skipIf` is always true", if the node can never start; else empty.
std::string neverStarts(const Tree& tree, int id) {
  for (const ConditionKind kind : {ConditionKind::kFailureIf, ConditionKind::kSuccessIf, ConditionKind::kSkipIf})
    if (tree.constantTruth(id, attributeOf(kind)) == true)
      return "its `" + std::string(attributeOf(kind)) + "` is always true";
  if (tree.constantTruth(id, attributeOf(ConditionKind::kWhile)) == false) return "its `_while` is never true";
  return {};
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
    if (id == "IfThenElse" || id == "WhileDoElse") return choiceOutcomes(record);
    if (const auto* choice = dynamic_cast<const SwitchNode*>(record.node))
      if (const auto chosen = choice->alwaysChosen()) return of(*children[*chosen]);
    if (const ChainRule chain = chainOf(record); chain != ChainRule::kNone) return chainOutcomes(record, chain);
    if (children.size() == 1) return decorated(record, id, of(*children.front()));
    return anyOrder(record, id);
  }

  Outcomes leafOutcomes(const NodeRecord& record, std::string_view id) const {
    if (id == "ScriptCondition")
      if (const auto holds = tree_.constantTruth(record.node->id(), "code")) return {*holds, !*holds, false};
    if (leaf_outcomes_)
      if (const auto known = leaf_outcomes_(record)) return *known;
    return {record.manifest->may_succeed, record.manifest->may_fail, record.manifest->may_skip};
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

  /// IfThenElse, WhileDoElse: SUCCESS where the child that was chosen is SKIPPED.
  Outcomes choiceOutcomes(const NodeRecord& record) const {
    const auto& children = record.node->children();
    const Outcomes& condition = of(*children.front());
    Outcomes all{false, condition.failure && children.size() == 2, false};
    if (condition.success) all = either(all, of(*children[1]));
    if (condition.failure && children.size() > 2) all = either(all, of(*children[2]));
    return {all.success || all.skipped, all.failure, condition.skipped};
  }

  /// Priority, Parallel, Switch ...: what their children may.
  Outcomes anyOrder(const NodeRecord& record, std::string_view id) const {
    Outcomes all;
    bool all_skip = true;
    for (const auto& child : record.node->children()) {
      all = either(all, of(*child));
      const bool asked = id != "TryCatch" || child != record.node->children().back();
      all_skip = all_skip && (of(*child).skipped || !asked);
    }
    // A Priority ends as its last child, or well if that is SKIPPED after another one did something.
    if (id == "Priority") {
      const Outcomes& last = of(*record.node->children().back());
      all.success = last.success || (last.skipped && all.success);
    }
    if (id.starts_with("Parallel")) all.success = all.success || all.skipped;
    // A Switch is SKIPPED as the child that it chooses is.
    if (dynamic_cast<const SwitchNode*>(record.node) == nullptr) all.skipped = all_skip;
    return all;
  }

  Outcomes decorated(const NodeRecord& record, std::string_view id, Outcomes child) const {
    const bool ends = child.success || child.failure;
    if (id == "Inverter") return {child.failure, child.success, child.skipped};
    if (id == "ForceSuccess") return {ends, false, child.skipped};
    if (id == "ForceFailure") return {false, ends, child.skipped};
    if (id == "KeepRunningUntilFailure") return {false, child.failure, false};
    if (id == "Repeat" && isAlways(tree_, record, "num_cycles", 0)) return {true, false, false};
    if (id == "RetryUntilSuccessful" && isAlways(tree_, record, "num_attempts", 0)) return {false, true, false};
    if (id == "Precondition") return preconditioned(record, child);
    if (dynamic_cast<const Loop*>(record.node) != nullptr) return looped(record);
    if (id == "Repeat") return {child.success && !isForever(record, "num_cycles"), child.failure, child.skipped};
    if (id == "RetryUntilSuccessful")
      return {child.success, child.failure && !isForever(record, "num_attempts"), child.skipped};
    if (id == "Timeout") return {child.success, true, child.skipped};
    if (id == "Delay") return {child.success || child.skipped, child.failure || child.skipped, false};
    if (id == "RunOnce") return {child.success, child.failure, child.skipped || mayBe(record, "then_skip", true)};
    if (id == "SkipUnlessUpdated") return {child.success, child.failure, true};
    if (id == "Priority" || id.starts_with("Parallel") || id == "WaitValueUpdate") return child;
    return kAny;
  }

  Outcomes preconditioned(const NodeRecord& record, Outcomes child) const {
    const auto holds = tree_.constantTruth(record.node->id(), "if");
    if (holds == true) return child;
    const Outcomes otherwise = answersOf(record, "else");
    // A script that cannot be evaluated is FAILURE.
    return holds == false ? otherwise : either(either(child, otherwise), {.failure = true});
  }

  /// FAILURE of a child is that of a Loop, and so is an element of another type.
  Outcomes looped(const NodeRecord& record) const { return either(answersOf(record, "if_empty"), {.failure = true}); }

  /// The statuses that a port may name.
  Outcomes answersOf(const NodeRecord& record, std::string_view port) const {
    const auto may = [&](const char* status) { return mayBe(record, port, std::string(status)); };
    return {may("SUCCESS"), may("FAILURE"), may("SKIPPED")};
  }

  bool mayBe(const NodeRecord& record, std::string_view port, const Value& value) const {
    const std::vector<Value> values = tree_.knownValues(record.node->id(), port);
    return !tree_.knowsEveryValue(record.node->id(), port) ||
           std::find(values.begin(), values.end(), value) != values.end();
  }

  bool isForever(const NodeRecord& record, std::string_view port) const { return isAlways(tree_, record, port, -1); }

  Outcomes withConditions(int id, Outcomes outcomes) const {
    const Conditions* conditions = tree_.conditionsOf(id);
    if (conditions == nullptr) return outcomes;
    const auto may = [&](ConditionKind kind) {
      return conditions->has(kind) && tree_.constantTruth(id, attributeOf(kind)).value_or(true);
    };
    const bool may_stop = conditions->has(ConditionKind::kWhile) &&
                          !tree_.constantTruth(id, attributeOf(ConditionKind::kWhile)).value_or(false);
    const Outcomes at_start{may(ConditionKind::kSuccessIf), may(ConditionKind::kFailureIf),
                            may(ConditionKind::kSkipIf) || may_stop};
    return neverStarts(tree_, id).empty() ? either(outcomes, at_start) : at_start;
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

ChainRule chainOf(const NodeRecord& record) {
  const std::string_view id = typeNameOf(record);
  if (id.find("Sequence") != std::string_view::npos) return ChainRule::kSequence;
  return id.find("Fallback") != std::string_view::npos ? ChainRule::kFallback : ChainRule::kNone;
}

bool isAlways(const Tree& tree, const NodeRecord& record, std::string_view port, std::int64_t number) {
  const std::vector<Value> values = tree.knownValues(record.node->id(), port);
  return !values.empty() && tree.knowsEveryValue(record.node->id(), port) &&
         std::all_of(values.begin(), values.end(), [&](const Value& value) {
           const auto* whole = std::get_if<std::int64_t>(&value);
           return whole != nullptr && *whole == number;
         });
}

std::vector<Outcomes> outcomesOf(const Tree& tree, const LeafOutcomes& leaf_outcomes) {
  return OutcomeJudge(tree, leaf_outcomes).judge();
}

namespace {

class UnreachedFinder {
 public:
  UnreachedFinder(const Tree& tree, const std::vector<Outcomes>& outcomes)
      : tree_(tree), outcomes_(outcomes), listed_(tree.nodes().size()) {}

  std::vector<Unreached> find() {
    for (const NodeRecord& record : tree_.nodes()) {
      const int id = record.node->id();
      if (record.parent >= 0 && isListed(record.parent)) listed_[static_cast<std::size_t>(id)] = true;
      if (!isListed(id)) list(*record.node, neverStarts(tree_, id));
      if (!isListed(id) && record.manifest != nullptr) judgeChildren(record, record.manifest->id);
    }
    return std::move(found_);
  }

 private:
  bool isListed(int id) const { return listed_[static_cast<std::size_t>(id)]; }
  const Outcomes& of(const Node& node) const { return outcomes_[static_cast<std::size_t>(node.id())]; }

  void list(const Node& node, const std::string& why) {
    if (why.empty()) return;
    listed_[static_cast<std::size_t>(node.id())] = true;
    found_.push_back({node.id(), why});
  }

  void judgeChildren(const NodeRecord& record, std::string_view id) {
    const auto& children = record.node->children();
    const std::string name = "`" + record.node->name() + "`";
    if (const ChainRule chain = chainOf(record); chain != ChainRule::kNone) return judgeChain(*record.node, chain);
    if (id == "IfThenElse" || id == "WhileDoElse") {
      const Outcomes& condition = of(*children.front());
      const std::string asked = "`" + children.front()->name() + "`, which is asked before it, never ";
      if (!condition.success) list(*children[1], asked + "succeeds");
      if (!condition.failure && children.size() > 2) list(*children[2], asked + "fails");
    }
    if (const auto* choice = dynamic_cast<const SwitchNode*>(record.node))
      if (const auto chosen = choice->alwaysChosen())
        for (std::size_t i = 0; i < children.size(); ++i)
          if (i != *chosen) list(*children[i], name + " always chooses `" + children[*chosen]->name() + "`");
    if (id == "Precondition" && tree_.constantTruth(record.node->id(), "if") == false)
      list(*children.front(), "the `if` of " + name + " is never true");
    if (id == "Repeat" && isAlways(tree_, record, "num_cycles", 0))
      list(*children.front(), "the num_cycles of " + name + " is 0");
    if (id == "RetryUntilSuccessful" && isAlways(tree_, record, "num_attempts", 0))
      list(*children.front(), "the num_attempts of " + name + " is 0");
  }

  void judgeChain(const Node& node, ChainRule chain) {
    const Node* blocker = nullptr;
    for (const auto& child : node.children()) {
      if (blocker != nullptr)
        list(*child, neverText(*blocker, of(*blocker), chain));
      else if (!goesOn(chain, of(*child)))
        blocker = child.get();
    }
  }

  const Tree& tree_;
  const std::vector<Outcomes>& outcomes_;
  std::vector<bool> listed_;  ///< By node id: itself, or a node above it.
  std::vector<Unreached> found_;
};

}  // namespace

std::vector<Unreached> unreachedNodes(const Tree& tree, const std::vector<Outcomes>& outcomes) {
  return UnreachedFinder(tree, outcomes).find();
}

}  // namespace swiftlet::tree
