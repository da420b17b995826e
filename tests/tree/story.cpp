#include "tests/tree/story.hpp"

#include <stdexcept>
#include <utility>

#include "behaviors/tree/leaf.hpp"

namespace swiftlet::tree::testing {
namespace {

class StandIn final : public Leaf {
 public:
  StandIn(const NodeSetup& setup, std::string actor, Stage& stage)
      : Leaf(setup), actor_(std::move(actor)), stage_(stage) {}

 private:
  std::string whyItWants(const TickContext&) const override {
    throwAt("explaining");
    return actor_ + " wants";
  }
  void throwAt(const char* when) const {
    if (actor().throws_at == when) throw std::runtime_error("boom");
    if (actor().throws_at == std::string("a number ") + when) throw 42;
  }
  Actor& actor() const { return stage_.actors[actor_]; }
  void log(const std::string& text) { stage_.log.push_back(text); }

  bool onAsked(const TickContext&) const override {
    throwAt("asked");
    return actor().wants;
  }
  void onStart(TickContext&) override {
    verb_ = "start ";
    to_stop_ = -1;
  }
  void onResume(TickContext&) override {
    verb_ = "resume ";
    to_stop_ = -1;
  }
  Status act(TickContext&) override {
    log(std::exchange(verb_, "") + actor_);
    throwAt("ticked");
    return actor().answer;
  }
  Release letGo(const char* verb) {
    throwAt("letting go");
    if (to_stop_ < 0) to_stop_ = actor().ticks_to_stop;
    const bool stopped = to_stop_-- <= 0;
    log(actor_ + " " + verb + (stopped ? "ed" : "ing"));
    return stopped ? Release::kReleased : Release::kLettingGo;
  }
  Release onSuspend(TickContext&) override { return letGo("suspend"); }
  Release onHalt(TickContext&) override { return letGo("halt"); }

  std::string actor_;
  Stage& stage_;
  std::string verb_;
  int to_stop_ = -1;
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void tell(Actor& actor, std::string_view what) {
  constexpr std::string_view kStops = "stops in ", kThrows = "throws ";
  if (what.starts_with(kThrows)) {
    actor.throws_at = what.substr(kThrows.size());
    return;
  }
  actor.wants = actor.wants || !what.starts_with(kStops);
  if (what == "SUCCESS")
    actor.answer = Status::kSuccess;
  else if (what == "FAILURE")
    actor.answer = Status::kFailure;
  else if (what == "RUNNING")
    actor.answer = Status::kRunning;
  else if (what == "nothing")
    actor.wants = false;
  else if (what.starts_with(kStops))
    actor.ticks_to_stop = std::stoi(std::string(what.substr(kStops.size())));
  else
    throw std::invalid_argument("a stand-in cannot say " + std::string(what));
}

}  // namespace

Registry withStandIns(Stage& stage, const Registry& base) {
  Registry registry = base;
  for (const char* name : {"A", "B", "C", "D", "E"}) {
    NodeManifest manifest{
        .id = name, .kind = NodeKind::kAction, .ports = {}, .description = "A stand-in.", .may_skip = true};
    registry.add(manifest,
                 [name, &stage](const NodeSetup& setup) { return std::make_unique<StandIn>(setup, name, stage); });
  }
  return registry;
}

std::vector<Problem> problemsInside(std::string_view inside) { return Story(inside).problems(); }

std::string file(std::string_view inside, std::string_view more) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">\n<BehaviorTree ID=\"Main\">\n" + std::string(inside) +
         "\n</BehaviorTree>\n" + std::string(more) + "</root>\n";
}

Story::Story(std::string_view inside, std::string_view more) { read(file(inside, more), Registry::standard()); }

Story::Story(std::string_view whole_file, const Registry& base) { read(std::string(whole_file), base); }

void Story::read(std::string text, const Registry& base) {
  registry_ = withStandIns(stage_, base);
  ParseResult parsed = parseText(std::move(text), "story.xml", registry_);
  problems_ = std::move(parsed.problems);
  tree_ = std::move(parsed.tree);
}

Story& Story::says(std::string_view actor, std::string_view what) {
  while (!what.empty()) {
    const std::size_t comma = what.find(", ");
    tell(stage_.actors[std::string(actor)], what.substr(0, comma));
    what = comma == std::string_view::npos ? std::string_view() : what.substr(comma + 2);
  }
  return *this;
}

std::string Story::happened() {
  const std::vector<std::string> log = std::exchange(stage_.log, {});
  return log.empty() ? std::string() : ": " + joined(log);
}

std::string Story::tick(int milliseconds) {
  if (!tree_) throw std::logic_error(toString(problems_));
  now_ns_ += std::int64_t{milliseconds} * 1'000'000;
  TickContext context(now_ns_);
  context.observer = &witness_;
  const Status status = tree_->tick(context);
  return toString(status) + happened();
}

std::string Story::halt() {
  TickContext context(now_ns_);
  context.observer = &witness_;
  const Release release = tree_->halt(context);
  return (release == Release::kReleased ? "let go" : "not yet") + happened();
}

std::string Story::view() const {
  std::vector<std::string> words;
  for (const NodeView& node : tree_->view()) words.push_back(node.name + " " + toString(node.status));
  return joined(words);
}

std::vector<std::string> Story::switches() { return std::exchange(witness_.switches, {}); }
std::vector<std::string> Story::failures() { return std::exchange(witness_.failures, {}); }

void Story::Witness::onSwitch(const Switch& change) {
  const std::string from = change.from == nullptr ? "nobody" : change.from->name();
  const std::string reason = " (" + change.reason + ")";
  switch (change.kind) {
    case Switch::Kind::kLetsGo:
      switches.push_back(from + " yields to " + change.to->name() + reason);
      break;
    case Switch::Kind::kTakes:
      switches.push_back(change.to->name() + " takes over from " + from + reason);
      break;
    case Switch::Kind::kKeeps:
      switches.push_back(change.to->name() + " continues" + reason);
      break;
  }
}

void Story::Witness::onFailure(const Node& node, std::string_view reason) {
  failures.push_back(node.name() + ": " + std::string(reason));
}

std::vector<Problem> problemsWithStandIns(const std::string& text) {
  Stage stage;
  return parseText(text, "f.xml", withStandIns(stage)).problems;
}

}  // namespace swiftlet::tree::testing
