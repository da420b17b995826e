// The inputs and outputs of a behaviour in one tick.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/command.hpp"
#include "common/event.hpp"
#include "common/goal.hpp"
#include "common/intent.hpp"
#include "common/mission_request.hpp"
#include "common/time.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::behaviors {

/// The caller fills in the inputs before each tick, and takes and clears the outputs after it.
struct Context {
  // In.
  std::shared_ptr<const common::World> world;  ///< Never null.
  common::IntentStatus status;                 ///< Status of the intent emitted last; matched by its id.
  common::Time now;                            ///< Present time; must not go back.
  bool hold = false;                           ///< The operator holds, or an emergency does.
  std::string hold_reason;                     ///< "the operator holds"; for events.
  common::GoalLimits goal_limits;              ///< Limits of the goals that are accepted.
  /// The map by which the operator's goals are judged; null before the first map.
  std::shared_ptr<const common::GoalMap> goal_map;
  /// Goals and home that arrived since the last tick, in order. The mission empties it and answers each in `results`.
  std::vector<common::OperatorCommand> commands;
  std::vector<common::MissionAnswer> answers;  ///< To requests, since the last tick.

  // Out.
  /// The intent of this tick. The ids of one mission rise from 1; the same id is the same intent. nullopt only if no
  /// node of the tree is active (the mission has ended, or all of it was skipped).
  std::optional<common::Intent> intent;
  std::vector<common::MissionRequest> requests;  ///< The mission appends its requests.
  std::vector<common::Event> events;             ///< The mission appends its events.
  std::vector<common::CommandResult> results;    ///< The mission appends its answers.
};

}  // namespace swiftlet::behaviors
