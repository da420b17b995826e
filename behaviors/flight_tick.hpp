// What a mission passes down its tree: the engine's tick with the context of the flight.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "behaviors/context.hpp"
#include "behaviors/tree/node.hpp"

namespace swiftlet::behaviors {

/// What the mission remembers from tick to tick for its leaves.
struct MissionMemory {
  std::uint64_t last_intent_id = 0;
  /// The newest accepted goal or home command that no OperatorCommand has taken yet.
  std::optional<common::OperatorCommand> pending_command = {};
  common::FlightMode mode = common::FlightMode::kFast;  ///< Of leaves that name no mode.
  bool go_on = false;  ///< The operator said "go on", and no WaitForOperator has taken it yet.
  /// Answers to requests, until the leaf that asked takes its own: it may be suspended when the answer comes.
  std::vector<common::MissionAnswer> answers = {};
  std::vector<int> located_targets = {};  ///< The ids of those that a LocateTarget was about.
};

class FlightTick final : public tree::TickContext {
 public:
  FlightTick(Context& context, MissionMemory& memory)
      : tree::TickContext(context.now.nanoseconds()),
        flight(context),
        pending_command(memory.pending_command),
        mode(memory.mode),
        go_on(memory.go_on),
        located_targets(memory.located_targets),
        answers_(memory.answers),
        last_intent_id_(memory.last_intent_id) {}

  std::uint64_t newIntentId() { return ++last_intent_id_; }
  void emit(std::uint64_t id, common::IntentKind kind, std::uint64_t resumes = 0) {
    flight.intent = common::Intent{id, std::move(kind), resumes};
  }

  /// Appends the request; returns its id, to find its answer.
  std::uint64_t request(common::MissionRequestKind kind) {
    flight.requests.push_back({newIntentId(), std::move(kind)});
    return flight.requests.back().id;
  }

  /// The answer to that request, once it has come; taken by this call.
  std::optional<common::MissionAnswer> takeAnswer(std::uint64_t request_id) {
    const auto found = std::find_if(answers_.begin(), answers_.end(),
                                    [&](const common::MissionAnswer& answer) { return answer.id == request_id; });
    if (found == answers_.end()) return std::nullopt;
    common::MissionAnswer answer = std::move(*found);
    answers_.erase(found);
    return answer;
  }

  /// An event of the mission, now.
  void say(common::Severity severity, std::string text, std::string reason) {
    flight.events.push_back({flight.now, severity, "mission", std::move(text), std::move(reason)});
  }

  Context& flight;
  // See MissionMemory.
  std::optional<common::OperatorCommand>& pending_command;
  common::FlightMode& mode;
  bool& go_on;
  std::vector<int>& located_targets;

 private:
  std::vector<common::MissionAnswer>& answers_;
  std::uint64_t& last_intent_id_;
};

/// Trees of missions are ticked only by Mission, with a FlightTick.
inline FlightTick& flightTick(tree::TickContext& context) { return static_cast<FlightTick&>(context); }
inline const FlightTick& flightTick(const tree::TickContext& context) {
  return static_cast<const FlightTick&>(context);
}

}  // namespace swiftlet::behaviors
