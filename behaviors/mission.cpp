#include "behaviors/mission.hpp"

#include <optional>
#include <utility>

#include "behaviors/flight_tick.hpp"
#include "behaviors/goal_check.hpp"
#include "behaviors/mission_check.hpp"
#include "behaviors/narrator.hpp"
#include "behaviors/registry.hpp"
#include "behaviors/tree/parser.hpp"
#include "common/check.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"

namespace swiftlet::behaviors {

using common::MissionState;
using tree::Status;

struct Mission::Impl {
  explicit Impl(tree::Tree parsed) : tree(std::move(parsed)), narrator(tree) {}

  void answerCommands(Context& context);
  std::string refusal(const Context& context, const common::OperatorCommand& command) const;
  TickResult resultOf(const Context& context, Status status);
  static bool holds(const Context& context);

  tree::Tree tree;
  Narrator narrator;
  std::uint64_t last_intent_id = 0;
  std::optional<common::OperatorCommand> pending_command;
  bool accepts_goals = false;
  TickResult result;
};

namespace {

/// Throws when there are problems.
tree::Tree sound(tree::ParseResult parsed) {
  if (!parsed.tree) throw common::InputError(toCommon(parsed.problems));
  return std::move(*parsed.tree);
}

}  // namespace

Mission::Mission(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  for (const tree::NodeRecord& record : impl_->tree.nodes()) {
    if (record.manifest != nullptr && record.manifest->id == "OperatorCommand") impl_->accepts_goals = true;
  }
}

Mission::Mission(Mission&&) noexcept = default;
Mission& Mission::operator=(Mission&&) noexcept = default;
Mission::~Mission() = default;

Mission Mission::fromFile(const std::string& path) {
  return Mission(std::make_unique<Impl>(sound(tree::parseFile(path, missionRegistry()))));
}

Mission Mission::fromFile(const std::string& path, const MissionLimits& limits) {
  tree::Tree tree = sound(tree::parseFile(path, missionRegistry()));
  if (const auto problems = semanticProblems(tree, limits); !problems.empty())
    throw common::InputError(toCommon(problems));
  return Mission(std::make_unique<Impl>(std::move(tree)));
}

Mission Mission::fromText(const std::string& text, const std::string& name) {
  return Mission(std::make_unique<Impl>(sound(tree::parseText(text, name, missionRegistry()))));
}

TickResult Mission::tick(Context& context) {
  SWIFTLET_CHECK(context.world != nullptr);
  Impl& self = *impl_;
  context.intent.reset();
  self.answerCommands(context);
  if (common::isOver(self.result.state)) return self.result;

  FlightTick tick(context, self.last_intent_id, self.pending_command);
  tick.observer = &self.narrator;
  self.narrator.listen(&context);
  const Status status = self.tree.tick(tick);
  self.narrator.listen(nullptr);
  if (status != Status::kRunning) context.intent.reset();  // Whoever ended in this tick wishes nothing any more.
  self.result = self.resultOf(context, status);
  return self.result;
}

bool Mission::letGo(Context& context) {
  SWIFTLET_CHECK(context.world != nullptr);
  Impl& self = *impl_;
  context.intent.reset();
  FlightTick tick(context, self.last_intent_id, self.pending_command);
  tick.observer = &self.narrator;
  self.narrator.listen(&context);
  const bool released = self.tree.halt(tick) == tree::Release::kReleased;
  self.narrator.listen(nullptr);
  if (released) {
    self.pending_command.reset();
    self.result = {};
  }
  return released;
}

common::TreeView Mission::view() const {
  common::TreeView view;
  for (const tree::NodeView& node : impl_->tree.view())
    view.push_back({node.id, node.parent, node.name, toString(node.status)});
  return view;
}

bool Mission::acceptsGoals() const { return impl_->accepts_goals; }

const std::string& Mission::name() const { return impl_->tree.name(); }

void Mission::Impl::answerCommands(Context& context) {
  for (const common::OperatorCommand& command : std::exchange(context.commands, {})) {
    std::string reason = refusal(context, command);
    const bool accepted = reason.empty();
    context.results.push_back({command.id, accepted, std::move(reason)});
    if (accepted) pending_command = command;
  }
}

std::string Mission::Impl::refusal(const Context& context, const common::OperatorCommand& command) const {
  const auto* goal = std::get_if<common::GoalCommand>(&command.kind);
  if (goal == nullptr && !std::holds_alternative<common::HomeCommand>(command.kind))
    return "not a command for the mission";
  if (!accepts_goals) return "the mission " + tree.name() + " has no OperatorCommand: it flies its own goals";
  if (common::isOver(result.state)) return "the mission has ended";
  return goal == nullptr ? std::string()
                         : goalProblem(*context.world->map->grid, goal->goal_map_m, context.hull_radius_m);
}

TickResult Mission::Impl::resultOf(const Context& context, Status status) {
  switch (status) {
    case Status::kSuccess:
      return {MissionState::kDone, "done", {}};
    case Status::kFailure:
      return {MissionState::kFailed, "failed",
              narrator.failure().empty() ? "the tree answered FAILURE" : narrator.failure()};
    case Status::kRunning:
    case Status::kSkipped:
    case Status::kIdle:
    case Status::kSuspended:
      break;
  }
  TickResult running{MissionState::kRunning, context.intent ? toString(*context.intent) : "nothing to do", {}};
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
