#include "behaviors/tree/dry_run.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "behaviors/tree/documents.hpp"
#include "behaviors/tree/mocks.hpp"
#include "behaviors/tree/parser.hpp"

namespace swiftlet::tree {
namespace {

/// The answers of one stand-in.
struct Actor {
  std::vector<Status> usual = {};                ///< Of a leaf that the script does not name.
  const std::vector<Status>* answers = nullptr;  ///< Of the script; null: the usual ones.
  bool by_tick = false;                          ///< A condition: one for each tick of the tree.
  std::size_t next = 0;                          ///< Of the others: the next answer.
  bool was_skipped = false;                      ///< In this tick.
};

class Cast {
 public:
  Status answerOf(const Node& leaf, bool ticked) {
    const auto found = actors_.find(leaf.id());
    if (found == actors_.end()) return Status::kSuccess;  // Asked before the tree is built.
    Actor& actor = found->second;
    const std::vector<Status>& answers = actor.answers == nullptr ? actor.usual : *actor.answers;
    const std::size_t last = answers.size() - 1;
    const Status answer = answers[std::min(actor.by_tick ? tick_ : actor.next, last)];
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
    lines_.push_back(fmt::format("{}: {} -> {}", tree_.pathOf(node.id()), toString(from), toString(to)));
  }
  void onSwitch(const Switch& change) override {
    const std::string to = change.to->name(), from = change.from == nullptr ? "" : change.from->name();
    const std::string what = change.kind == Switch::Kind::kLetsGo  ? from + " yields to " + to
                             : change.kind == Switch::Kind::kKeeps ? to + " continues"
                             : from.empty()                        ? to + " takes control"
                                                                   : to + " takes over from " + from;
    lines_.push_back(what + (change.reason.empty() ? "" : " (" + change.reason + ")"));
  }
  void onFailure(const Node& node, std::string_view reason) override {
    lines_.push_back(fmt::format("{} fails: {}", tree_.pathOf(node.id()), reason));
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
  Casting(const Tree& tree, const OutcomeScript& script, Cast& cast, Problems& problems)
      : tree_(tree), script_(script), cast_(cast), problems_(problems), used_(script.leaves.size()) {
    for (std::size_t i = 0; i < script.leaves.size(); ++i) lines_.emplace(script.leaves[i].leaf, i);
  }

  /// Returns the leaves that the script does not name.
  std::vector<std::string> assign() {
    for (const NodeRecord& record : tree_.nodes())
      if (record.manifest != nullptr && record.node->children().empty()) {
        const bool of_engine = engine_.find(record.manifest->id) != nullptr;
        for (const std::string* name : {&record.node->name(), &record.manifest->id})
          of_engine_[*name] = of_engine || of_engine_[*name];
        if (!of_engine) assign(record);
      }
    for (std::size_t i = 0; i < used_.size() && !problems_.full(); ++i)
      if (!used_[i]) reportUnused(script_.leaves[i]);
    return std::move(unscripted_);
  }

 private:
  void assign(const NodeRecord& record) {
    const NodeManifest& manifest = *record.manifest;
    const bool condition = manifest.kind == NodeKind::kCondition;
    const std::string path = tree_.pathOf(record.node->id());
    const ScriptedAnswers* scripted = scriptOf(path, record.node->name(), manifest.id);
    if (scripted == nullptr) {
      const Status usual = manifest.may_skip ? Status::kSkipped : condition ? Status::kFailure : Status::kSuccess;
      cast_.add(record.node->id(), {.usual = {usual}, .by_tick = condition});
      unscripted_.push_back(path + ": " + toString(usual));
      return;
    }
    const auto given = [&](Status status) {
      return std::find(scripted->answers.begin(), scripted->answers.end(), status) != scripted->answers.end();
    };
    if (condition && (given(Status::kRunning) || given(Status::kSkipped)))
      report(*scripted, Message("tree.answers-of-condition", "a condition is true or false"), {}, path);
    else if (given(Status::kSkipped) && !manifest.may_skip)
      report(*scripted, Message("tree.answers-skipped", "`{}` is never SKIPPED", manifest.id), {}, path);
    cast_.add(record.node->id(), {.answers = &scripted->answers, .by_tick = condition});
  }

  /// The line that names the leaf best: by its path, by its name, by its type.
  const ScriptedAnswers* scriptOf(const std::string& path, const std::string& name, const std::string& type) {
    for (const std::string* key : {&path, &name, &type})
      if (const auto line = lines_.find(*key); line != lines_.end()) {
        used_[line->second] = true;
        return &script_.leaves[line->second];
      }
    return nullptr;
  }

  void reportUnused(const ScriptedAnswers& scripted) {
    const auto named = of_engine_.find(scripted.leaf);
    if (named != of_engine_.end())
      return report(scripted,
                    named->second
                        ? Message("tree.answers-of-engine", "it is a node of the engine, which is ticked as it is")
                        : Message("tree.answers-unused", "other lines name each of these leaves better"));
    std::vector<std::string> names;
    for (const auto& [name, of_engine] : of_engine_) names.push_back(name);
    report(scripted, Message("tree.unknown-leaf", "the mission has no such leaf"), didYouMean(scripted.leaf, names));
  }

  void report(const ScriptedAnswers& scripted, Message message, std::string hint = {}, std::string path = {}) {
    problems_.add({scripted.location, scripted.leaf, std::move(message), std::move(hint), std::move(path)});
  }

  const Tree& tree_;
  const OutcomeScript& script_;
  Cast& cast_;
  Problems& problems_;
  Registry engine_ = Registry::standard();
  std::map<std::string_view, std::size_t> lines_;       ///< Of the script, by what they name.
  std::map<std::string, bool, std::less<>> of_engine_;  ///< Names and types of leaves: whether one is of the engine.
  std::vector<std::string> unscripted_;
  std::vector<bool> used_;
};

}  // namespace

struct DryRun::Parts {
  OutcomeScript script;
  Cast cast;
  Registry registry;
  std::optional<Tree> tree;
  std::optional<Scribe> scribe;
  TickContext context;
  std::vector<Problem> problems;
  std::vector<std::string> unscripted;
  int ticks = 0;
  bool ended = false;
};

DryRun::DryRun(const std::string& path, const Registry& base, OutcomeScript script, bool mocks, ParseOptions options)
    : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.script = std::move(script);
  parts.problems = parts.script.problems;
  if (!parts.problems.empty()) return;
  const MockAnswer answer = [&parts](const Node& leaf, bool ticked) { return parts.cast.answerOf(leaf, ticked); };
  parts.registry = withStandInLeaves(base, answer);
  if (mocks) {
    MockedRegistry mocked = withMocks(path, parts.registry, options, answer);
    parts.registry = std::move(mocked.registry);
    options = std::move(mocked.options);
  }
  ParseResult parsed = parseFile(path, parts.registry, options);
  parts.problems = std::move(parsed.problems);
  if (!parsed.tree) return;
  parts.tree = std::move(parsed.tree);
  Problems problems(ParseLimits{}.problems);
  parts.unscripted = Casting(*parts.tree, parts.script, parts.cast, problems).assign();
  parts.problems = problems.take();
  parts.scribe.emplace(*parts.tree);
  parts.context.observer = &*parts.scribe;
}

DryRun::~DryRun() = default;
DryRun::DryRun(DryRun&&) noexcept = default;
DryRun& DryRun::operator=(DryRun&&) noexcept = default;

const std::vector<Problem>& DryRun::problems() const { return parts_->problems; }

const std::vector<std::string>& DryRun::unscripted() const { return parts_->unscripted; }

std::optional<DryRunTick> DryRun::tick() {
  Parts& parts = *parts_;
  if (!parts.problems.empty() || parts.ended || parts.ticks == parts.script.ticks) return std::nullopt;
  ++parts.ticks;
  parts.context.now_ns += std::int64_t{parts.script.tick_ms} * 1'000'000;
  const Status status = parts.tree->tick(parts.context);
  parts.cast.endTick();
  parts.ended = status == Status::kSuccess || status == Status::kFailure;
  return DryRunTick{parts.context.now_ns, status, parts.scribe->take()};
}

}  // namespace swiftlet::tree
