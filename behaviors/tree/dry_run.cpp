#include "behaviors/tree/dry_run.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::tree {
namespace {

/// The answers of one stand-in.
struct Actor {
  std::vector<Status> answers;
  bool by_tick = false;      ///< A condition: one for each tick of the tree.
  std::size_t next = 0;      ///< Of the others: the next answer.
  bool was_skipped = false;  ///< In this tick.
};

class Cast {
 public:
  Status answerOf(const Node& leaf, bool ticked) {
    const auto found = actors_.find(leaf.id());
    if (found == actors_.end()) return Status::kSuccess;  // Asked before the tree is built.
    Actor& actor = found->second;
    const std::size_t last = actor.answers.size() - 1;
    const Status answer = actor.answers[std::min(actor.by_tick ? tick_ : actor.next, last)];
    if (answer == Status::kSkipped)
      actor.was_skipped = true;
    else if (ticked)
      ++actor.next;
    return answer;
  }

  /// Answers of SKIPPED are used up by ticks of the tree, because a Priority may ask several times in one.
  void endTick() {
    ++tick_;
    for (auto& [id, actor] : actors_) actor.next += std::exchange(actor.was_skipped, false) ? 1 : 0;
  }

  void add(int id, Actor actor) { actors_[id] = std::move(actor); }

 private:
  std::map<int, Actor> actors_;
  std::size_t tick_ = 0;
};

/// Writes down what happens.
class Scribe final : public Observer {
 public:
  explicit Scribe(const Tree& tree) : tree_(tree) {}

  void onStatus(const Node& node, Status from, Status to) override {
    lines_.push_back(tree_.pathOf(node.id()) + ": " + toString(from) + " -> " + toString(to));
  }
  void onSwitch(const Switch& change) override {
    const std::string to = change.to->name(), from = change.from == nullptr ? "" : change.from->name();
    const std::string what = change.kind == Switch::Kind::kLetsGo  ? from + " lets go for " + to
                             : change.kind == Switch::Kind::kKeeps ? to + " goes on"
                             : from.empty()                        ? to + " has the vehicle"
                                                                   : to + " takes over from " + from;
    lines_.push_back(what + (change.reason.empty() ? "" : " (" + change.reason + ")"));
  }
  void onFailure(const Node& node, std::string_view reason) override {
    lines_.push_back(tree_.pathOf(node.id()) + " fails: " + std::string(reason));
  }
  std::vector<std::string> take() { return std::exchange(lines_, {}); }

 private:
  const Tree& tree_;
  std::vector<std::string> lines_;
};

/// `base` with stand-ins for the leaves that are not of the engine.
Registry withStandInLeaves(const Registry& base, const MockAnswer& answer) {
  const Registry engine = Registry::standard();
  Registry registry = base;
  for (const auto& [id, type] : base.types())
    if (type.manifest.maxChildren() == 0 && engine.find(id) == nullptr) addMockLeaf(registry, type.manifest, answer);
  return registry;
}

/// Gives each stand-in of a tree its answers.
class Casting {
 public:
  Casting(const Tree& tree, const OutcomeScript& script, Cast& cast, DryRun& run)
      : tree_(tree), script_(script), cast_(cast), run_(run), used_(script.leaves.size()) {}

  void assign() {
    const Registry engine = Registry::standard();
    for (const NodeRecord& record : tree_.nodes())
      if (record.manifest != nullptr && record.node->children().empty() && engine.find(record.manifest->id) == nullptr)
        assign(record);
    for (std::size_t i = 0; i < used_.size(); ++i)
      if (!used_[i]) reportUnused(script_.leaves[i], engine);
  }

 private:
  void assign(const NodeRecord& record) {
    const NodeManifest& manifest = *record.manifest;
    const bool condition = manifest.kind == NodeKind::kCondition;
    const std::string path = tree_.pathOf(record.node->id());
    const ScriptedAnswers* scripted = scriptOf(path, record.node->name(), manifest.id);
    if (scripted == nullptr) {
      const Status usual = manifest.may_skip ? Status::kSkipped : condition ? Status::kFailure : Status::kSuccess;
      cast_.add(record.node->id(), {{usual}, condition});
      run_.unscripted.push_back(path + ": " + toString(usual));
      return;
    }
    const auto given = [&](Status status) {
      return std::find(scripted->answers.begin(), scripted->answers.end(), status) != scripted->answers.end();
    };
    if (condition && (given(Status::kRunning) || given(Status::kSkipped)))
      run_.problems.push_back({scripted->location, scripted->leaf, "a condition is true or false", {}, path});
    else if (given(Status::kSkipped) && !manifest.may_skip)
      run_.problems.push_back({scripted->location, scripted->leaf, "`" + manifest.id + "` is never SKIPPED", {}, path});
    cast_.add(record.node->id(), {scripted->answers, condition});
  }

  /// The entry that names the leaf best: by its path, by its name, by its type.
  const ScriptedAnswers* scriptOf(const std::string& path, const std::string& name, const std::string& type) {
    for (const std::string* key : {&path, &name, &type})
      for (std::size_t i = 0; i < script_.leaves.size(); ++i) {
        if (script_.leaves[i].leaf != *key) continue;
        used_[i] = true;
        return &script_.leaves[i];
      }
    return nullptr;
  }

  void reportUnused(const ScriptedAnswers& scripted, const Registry& engine) {
    std::vector<std::string> names;
    bool of_engine = false, overridden = false;
    for (const NodeRecord& record : tree_.nodes()) {
      if (record.manifest == nullptr || !record.node->children().empty()) continue;
      const bool named = record.node->name() == scripted.leaf || record.manifest->id == scripted.leaf;
      of_engine = of_engine || (named && engine.find(record.manifest->id) != nullptr);
      overridden = overridden || named;
      names.push_back(record.node->name());
      names.push_back(record.manifest->id);
    }
    run_.problems.push_back({scripted.location, scripted.leaf,
                             of_engine    ? "it is a node of the engine, which is ticked as it is"
                             : overridden ? "other lines name each of these leaves better"
                                          : "the mission has no such leaf",
                             overridden ? "" : didYouMean(scripted.leaf, names)});
  }

  const Tree& tree_;
  const OutcomeScript& script_;
  Cast& cast_;
  DryRun& run_;
  std::vector<bool> used_;
};

}  // namespace

DryRun dryRun(const std::string& path, const Registry& base, const OutcomeScript& script, bool mocks) {
  DryRun run;
  run.problems = script.problems;
  if (!run.problems.empty()) return run;
  Cast cast;
  const MockAnswer answer = [&cast](const Node& leaf, bool ticked) { return cast.answerOf(leaf, ticked); };
  Registry registry = withStandInLeaves(base, answer);
  if (mocks) registry = withMocks(path, registry, {}, answer).registry;
  ParseResult parsed = parseFile(path, registry);
  run.problems = std::move(parsed.problems);
  if (!parsed.tree) return run;
  Casting(*parsed.tree, script, cast, run).assign();
  if (!run.problems.empty()) return run;

  Scribe scribe(*parsed.tree);
  TickContext context;
  context.observer = &scribe;
  for (int i = 0; i < script.ticks; ++i) {
    context.now_ns += std::int64_t{script.tick_ms} * 1'000'000;
    const Status status = parsed.tree->tick(context);
    cast.endTick();
    run.ticks.push_back({context.now_ns, status, scribe.take()});
    if (status == Status::kSuccess || status == Status::kFailure) break;
  }
  return run;
}

}  // namespace swiftlet::tree
