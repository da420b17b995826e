#include "behaviors/mission.hpp"

#include <optional>
#include <utility>

#include "behaviors/flight_tick.hpp"
#include "behaviors/limits_check.hpp"
#include "behaviors/live_tree.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/narrator.hpp"
#include "behaviors/operator_command.hpp"
#include "behaviors/place_entries.hpp"
#include "behaviors/tree/observers.hpp"
#include "behaviors/tree/parser.hpp"
#include "behaviors/wait_for_operator.hpp"
#include "common/check.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {

using common::MissionState;
using tree::Status;

struct Mission::Impl {
  Impl(NodeTypes known, tree::Tree parsed)
      : types(std::move(known)), tree(std::move(parsed)), narrator(tree), live(tree), observers({&narrator, &live}) {}

  /// What `act` does to the tree in one tick, reported to the observers.
  template <typename Act>
  auto observed(Context& context, Act act) {
    FlightTick tick(context, memory);
    tick.observer = &observers;
    narrator.listen(&tick);
    live.setNow(context.now);
    const auto answer = act(tick);
    narrator.listen(nullptr);
    return answer;
  }
  void answerCommands(Context& context);
  std::string refusal(const Context& context, const common::OperatorCommand& command) const;
  std::string refusalOfGoal(const Context& context, const common::GoalCommand& command) const;
  TickResult resultOf(const Context& context, Status status);
  std::string question() const;
  static bool holds(const Context& context);

  NodeTypes types;  ///< Before the tree, which refers to it.
  tree::Tree tree;
  Narrator narrator;
  LiveTree live;
  tree::Observers observers;
  MissionMemory memory;
  std::vector<const OperatorCommand*> takers;   ///< The nodes that take goals and home commands.
  std::vector<const WaitForOperator*> waiters;  ///< Those that wait for "go on".
  TickResult result;
};

namespace {

/// Throws if there are problems.
tree::Tree sound(tree::ParseResult parsed) {
  if (!parsed.tree) throw common::InputError(toCommon(parsed.problems));
  return std::move(*parsed.tree);
}

/// Throws also for what cannot work in flight.
tree::Tree flyable(tree::ParseResult parsed, const MissionLimits& limits) {
  tree::Tree tree = sound(std::move(parsed));
  setPlaces(limits, tree);
  if (const auto problems = semanticProblems(tree, limits); !problems.empty())
    throw common::InputError(toCommon(problems));
  return tree;
}

}  // namespace

std::string flownAfterHold(const std::string& hold_reason) { return "flown after the hold: " + hold_reason; }

Mission::Mission(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  for (const tree::NodeRecord& record : impl_->tree.nodes()) {
    if (const auto* taker = dynamic_cast<const OperatorCommand*>(record.node)) impl_->takers.push_back(taker);
    if (const auto* waiter = dynamic_cast<const WaitForOperator*>(record.node)) impl_->waiters.push_back(waiter);
  }
}

Mission::Mission(Mission&&) noexcept = default;
Mission& Mission::operator=(Mission&&) noexcept = default;
Mission::~Mission() = default;

Mission Mission::fromFile(const std::string& path, const NodeTypes& types) {
  return Mission(std::make_unique<Impl>(types, sound(tree::parseFile(path, *types))));
}

Mission Mission::fromFile(const std::string& path, const MissionLimits& limits, const NodeTypes& types) {
  return Mission(std::make_unique<Impl>(types, flyable(tree::parseFile(path, *types, parseOptionsOf(limits)), limits)));
}

Mission Mission::fromText(const std::string& text, const std::string& name, const NodeTypes& types) {
  return Mission(std::make_unique<Impl>(types, sound(tree::parseText(text, name, *types))));
}

Mission Mission::fromText(const std::string& text, const std::string& name, const MissionLimits& limits,
                          const NodeTypes& types) {
  return Mission(
      std::make_unique<Impl>(types, flyable(tree::parseText(text, name, *types, parseOptionsOf(limits)), limits)));
}

TickResult Mission::tick(Context& context) {
  SWIFTLET_CHECK(context.world != nullptr);
  Impl& self = *impl_;
  context.intent.reset();
  self.answerCommands(context);
  if (common::isOver(self.result.state)) return self.result;

  for (common::MissionAnswer& answer : std::exchange(context.answers, {}))
    self.memory.answers.push_back(std::move(answer));
  const Status status = self.observed(context, [&](FlightTick& tick) { return self.tree.tick(tick); });
  if (status != Status::kRunning) context.intent.reset();  // A leaf that ended in this tick has no intent any more.
  self.result = self.resultOf(context, status);
  return self.result;
}

bool Mission::letGo(Context& context) {
  SWIFTLET_CHECK(context.world != nullptr);
  Impl& self = *impl_;
  context.intent.reset();
  const bool released =
      self.observed(context, [&](FlightTick& tick) { return self.tree.halt(tick) == tree::Release::kReleased; });
  if (released) {
    self.memory = {.last_intent_id = self.memory.last_intent_id};
    self.narrator.forget();
    self.result = {};
  }
  return released;
}

const common::TreeView& Mission::view() const { return impl_->live.view(); }

void Mission::continueIntentsOf(const Mission& before) {
  impl_->memory.last_intent_id = before.impl_->memory.last_intent_id;
}

std::optional<double> Mission::maxHeight_m() const { return maxHeightOf_m(impl_->tree); }

bool Mission::fliesHomeOnFailure() const { return behaviors::fliesHomeOnFailure(impl_->tree); }

std::vector<std::string> Mission::mapFiles() const { return mapFilesOf(impl_->tree); }

bool Mission::acceptsGoals() const { return !impl_->takers.empty(); }

std::optional<common::OperatorCommand> Mission::waitingCommand() const {
  if (impl_->memory.pending_command) return impl_->memory.pending_command;
  for (const OperatorCommand* taker : impl_->takers)
    if (taker->present()) return taker->present();
  return std::nullopt;
}

std::string Mission::question() const { return impl_->question(); }

std::string Mission::Impl::question() const {
  for (const WaitForOperator* waiter : waiters)
    if (std::string question = waiter->question(); !question.empty()) return question;
  return {};
}

const NodeTypes& Mission::types() const { return impl_->types; }

const std::string& Mission::name() const { return impl_->tree.name(); }

void Mission::Impl::answerCommands(Context& context) {
  for (const common::OperatorCommand& command : std::exchange(context.commands, {})) {
    std::string reason = refusal(context, command);
    const bool accepted = reason.empty();
    const bool goes_on = std::holds_alternative<common::GoOnCommand>(command.kind);
    if (accepted && context.hold && !goes_on) reason = flownAfterHold(context.hold_reason);
    context.results.push_back({command.id, accepted, std::move(reason)});
    if (accepted && goes_on) memory.go_on = true;
    if (accepted && !goes_on) memory.pending_command = command;
  }
}

std::string Mission::Impl::refusal(const Context& context, const common::OperatorCommand& command) const {
  if (std::holds_alternative<common::GoOnCommand>(command.kind))
    return question().empty() ? "the mission does not wait for the operator" : "";
  const auto* goal = std::get_if<common::GoalCommand>(&command.kind);
  if (goal == nullptr && !std::holds_alternative<common::HomeCommand>(command.kind))
    return "not a command for the mission";
  if (takers.empty()) return "the mission " + tree.name() + " has no OperatorCommand: it flies its own goals";
  if (common::isOver(result.state)) return "the mission has ended";
  return goal == nullptr ? std::string() : refusalOfGoal(context, *goal);
}

/// Why the goal is refused; empty if at least one of the nodes that may take it can fly to it with its tolerance and
/// clearance.
std::string Mission::Impl::refusalOfGoal(const Context& context, const common::GoalCommand& command) const {
  std::string first;
  for (const OperatorCommand* taker : takers) {
    const common::Goal goal = common::tappedGoalOf(taker->goalTo(command), context.world->map->names());
    const auto verdict = common::judgeGoal(goal, context.goal_limits, context.goal_map.get());
    if (verdict) return {};
    if (first.empty()) first = verdict.error().text;
  }
  return first;
}

TickResult Mission::Impl::resultOf(const Context& context, Status status) {
  switch (status) {
    case Status::kSuccess:
      return {MissionState::kDone, "done", {}};
    case Status::kFailure: {
      std::string cause = narrator.failure();
      return {MissionState::kFailed, "failed", cause.empty() ? "the tree answered FAILURE" : std::move(cause)};
    }
    case Status::kRunning:
    case Status::kSkipped:
    case Status::kIdle:
    case Status::kSuspended:
      break;
  }
  TickResult running{MissionState::kRunning,
                     context.intent ? toString(*context.intent, context.world->map->names()) : "nothing to do",
                     {}};
  if (holds(context)) {
    running.state = MissionState::kHeld;
    running.reason = context.hold_reason;
  }
  return running;
}

bool Mission::Impl::holds(const Context& context) {
  return context.hold && context.intent && std::holds_alternative<common::HoldIntent>(context.intent->kind);
}

}  // namespace swiftlet::behaviors
