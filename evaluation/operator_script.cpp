#include "evaluation/operator_script.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"
#include "common/world.hpp"
#include "evaluation/phase_words.hpp"

namespace swiftlet::evaluation {
namespace {

using common::Message;

/// The ids of the script's commands. Those of pages count from 1.
constexpr std::uint64_t kFirstId = std::uint64_t{1} << 62;

common::Polygon polygonOf(const std::vector<double>& flat_map_m) {
  common::Polygon polygon;
  for (std::size_t i = 0; i + 1 < flat_map_m.size(); i += 2)
    polygon.corners_map_m.emplace_back(flat_map_m[i], flat_map_m[i + 1]);
  return polygon;
}

common::OperatorCommand commandOf(const OperatorStep& step) {
  switch (step.command) {
    case OperatorAction::kGoal:
      return {0, common::GoalCommand{{step.goal_map_m[0], step.goal_map_m[1]}}};
    case OperatorAction::kHold:
      return {0, common::HoldCommand{}};
    case OperatorAction::kResume:
      return {0, common::ResumeCommand{}};
    case OperatorAction::kHome:
      return {0, common::HomeCommand{}};
    case OperatorAction::kLand:
      return {0, common::LandCommand{}};
    case OperatorAction::kKeepOut:
      return {0, common::KeepOutCommand{polygonOf(step.polygon_map_m)}};
    case OperatorAction::kClearKeepOut:
      return {0, common::ClearKeepOutCommand{}};
    case OperatorAction::kGoOn:
      return {0, common::GoOnCommand{}};
    case OperatorAction::kController:
      return {0, common::ControllerCommand{step.controller}};
  }
  return {0, common::LandCommand{}};
}

}  // namespace

void OperatorStep::describe(common::config::Fields& fields) {
  fields.choice("command", command,
                {"goal", "hold", "resume", "home", "land", "keep_out", "clear_keep_out", "go_on", "controller"},
                "What the operator asks for.");
  fields("goal_map_m", goal_map_m, {-1e4, 1e4}, "For command goal: the place x, y in the vehicle's frame `map`.");
  fields("polygon_map_m", polygon_map_m, {-1e4, 1e4},
         "For command keep_out: the corners x, y, x, y ... in the vehicle's frame `map`.");
  fields("controller", controller, "For command controller: the kind that takes over in flight.");
  fields("at_s", at_s, {0, 1e6}, "Time before which the command is not given.");
  fields("after_phase", after_phase,
         "The command is given when the flight's state, the mission's phase or reason, or a running behaviour begins "
         "with this text: `taking off`, `explore`, `GoHome`; empty for any.");
  fields("after_event", after_event,
         "The command is given when an event holds this text, in itself or its reason; empty for none.");
  fields("after_goals", after_goals, {0, 10'000},
         "The command is given when this many goals have been reached in all.");
  fields("delay_s", delay_s, {0, 1e6}, "Time from when the command could be given until it is.");
  fields.choice("expect", expect, {"accepted", "refused", "any"},
                "Answer to the command without which the flight fails.");
  fields("vehicle", vehicle, "Name of the vehicle that is commanded; empty for every vehicle.");
}

std::vector<common::Problem> OperatorStep::validate() const {
  const bool is_goal = command == OperatorAction::kGoal;
  const bool is_zone = command == OperatorAction::kKeepOut;
  const common::Polygon area = polygonOf(polygon_map_m);
  return common::Validation()
      .require(!is_goal || goal_map_m.size() == 2, "goal_map_m", Message("config.no-place", "is not one place x, y"))
      .require((command == OperatorAction::kController) == !controller.empty(), "controller",
               Message("operator.controller", "is for the command controller, which needs it"))
      .require(is_goal || goal_map_m.empty(), "goal_map_m",
               Message("operator.goal-alone", "is for the command goal alone"))
      .require(!is_zone || polygon_map_m.size() % 2 == 0, "polygon_map_m",
               Message("operator.half-corner", "has a corner without y"))
      .require(!is_zone || !problemOf(area), "polygon_map_m", problemOf(area).value_or(Message()))
      .require(is_zone || polygon_map_m.empty(), "polygon_map_m",
               Message("operator.keep-out-alone", "is for the command keep_out alone"))
      .problems();
}

std::string OperatorAnswer::failure() const {
  if (!given) return fmt::format("operator: {}: what it waits for never came", command);
  if (expected == ExpectedAnswer::kAny) return "";
  if (!accepted) return fmt::format("operator: {} at {:.1f} s: no answer", command, given->seconds());
  if (*accepted == (expected == ExpectedAnswer::kAccepted)) return "";
  return fmt::format("operator: {} at {:.1f} s: {}{}{}", command, given->seconds(), *accepted ? "accepted" : "refused",
                     reason.empty() ? "" : ", ", reason);
}

OperatorScript::OperatorScript(const std::vector<OperatorStep>& steps, const std::string& vehicle) {
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(steps_),
               [&](const OperatorStep& step) { return step.vehicle.empty() || step.vehicle == vehicle; });
  for (const OperatorStep& step : steps_) answers_.push_back({toString(commandOf(step)), step.expect, {}, {}, {}});
}

void OperatorScript::event(const common::Event& event) {
  if (next_ == steps_.size()) return;
  const std::string& text = steps_[next_].after_event;
  if (event.text.find(text) != std::string::npos || event.reason.find(text) != std::string::npos) event_came_ = true;
}

void OperatorScript::world(const common::World& world) {
  if (next_ == steps_.size()) return;
  if (anyBeginsWith(phaseWords(world), steps_[next_].after_phase)) phase_came_ = true;
}

void OperatorScript::intent(const common::Intent& intent, const common::IntentStatus& status) {
  if (!std::holds_alternative<common::GoToIntent>(intent.kind) || status.id != intent.id) return;
  if (status.state != common::IntentState::kSucceeded || counted_intent_ == intent.id) return;
  counted_intent_ = intent.id;
  ++goals_;
}

bool OperatorScript::conditionHolds(const OperatorStep& step, common::Time now) const {
  return now.seconds() >= step.at_s && (step.after_phase.empty() || phase_came_) &&
         (step.after_event.empty() || event_came_) && goals_ >= step.after_goals;
}

std::vector<common::OperatorCommand> OperatorScript::due(common::Time now) {
  std::vector<common::OperatorCommand> commands;
  while (next_ < steps_.size()) {
    const OperatorStep& step = steps_[next_];
    if (!holds_since_ && conditionHolds(step, now)) holds_since_ = now;
    if (!holds_since_ || (now - *holds_since_).seconds() < step.delay_s) break;
    commands.push_back(begin(next_++, now));
    holds_since_.reset();
    phase_came_ = event_came_ = false;
  }
  return commands;
}

common::OperatorCommand OperatorScript::begin(std::size_t step, common::Time now) {
  answers_[step].given = now;
  common::OperatorCommand command = commandOf(steps_[step]);
  command.id = kFirstId + step;
  return command;
}

void OperatorScript::result(const common::CommandResult& result) {
  if (result.id < kFirstId || result.id - kFirstId >= answers_.size()) return;
  OperatorAnswer& answer = answers_[result.id - kFirstId];
  answer.accepted = result.accepted;
  answer.reason = result.reason;
}

}  // namespace swiftlet::evaluation
