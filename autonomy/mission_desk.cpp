#include "autonomy/mission_desk.hpp"

#include <utility>

#include "common/error.hpp"
#include "common/operator_text.hpp"

namespace swiftlet::autonomy {

std::optional<common::CommandResult> MissionDesk::take(const common::OperatorCommand& command) {
  if (const auto* wanted = std::get_if<common::StartMissionCommand>(&command.kind)) return start(command.id, *wanted);
  if (std::holds_alternative<common::StopMissionCommand>(command.kind)) return stop(command.id);
  return std::nullopt;
}

common::CommandResult MissionDesk::start(std::uint64_t id, const common::StartMissionCommand& command) {
  try {
    next_ = behaviors::Mission::fromText(command.xml, command.name, limits_, mission_.types());
  } catch (const common::InputError& wrong) {
    return {id, false, forOperator(wrong)};
  }
  leaves_ = leaves_ || !waits_;
  return {id, true, leaves_ ? "when the vehicle has stopped" : ""};
}

common::CommandResult MissionDesk::stop(std::uint64_t id) {
  if (waits_) return {id, false, "no mission is being flown"};
  next_.reset();
  leaves_ = true;
  return {id, true, "the vehicle holds until a mission is started, or it lands"};
}

std::optional<common::OperatorCommand> MissionDesk::waitingCommand() const {
  return waits_ || leaves_ ? std::nullopt : mission_.waitingCommand();
}

behaviors::TickResult MissionDesk::tick(behaviors::Context& context) {
  if (leaves_) {
    refuseCommands(context, "the mission is being changed");
    if (!mission_.letGo(context)) return {common::MissionState::kRunning, "stop the mission", {}};
    leaves_ = false;
    waits_ = true;
  }
  if (next_) {
    next_->continueIntentsOf(mission_);
    mission_ = std::move(*next_);
    next_.reset();
    waits_ = false;
  }
  if (!waits_) return mission_.tick(context);
  context.intent.reset();
  refuseCommands(context, "no mission is being flown");
  return {common::MissionState::kReady, "wait for a mission", {}};
}

void MissionDesk::refuseCommands(behaviors::Context& context, const std::string& reason) {
  for (const common::OperatorCommand& command : std::exchange(context.commands, {}))
    context.results.push_back({command.id, false, reason});
}

}  // namespace swiftlet::autonomy
