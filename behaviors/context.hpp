// What a behaviour sees and says in one tick.
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
#include "common/time.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::behaviors {

/// Filled by the caller before each tick; the outputs are the caller's to take and clear after it.
struct Context {
  // In.
  std::shared_ptr<const common::World> world;  ///< Never null.
  common::IntentStatus status;                 ///< Of the intent emitted last; matched by its id.
  common::Time now;                            ///< Must not go back.
  bool hold = false;                           ///< The operator holds, or an emergency does.
  std::string hold_reason;                     ///< "the operator holds"; for events.
  common::GoalLimits goal_limits;              ///< Of the goals that are accepted.
  /// What goals of the operator are judged by; null while there is no map yet.
  std::shared_ptr<const common::GoalMap> goal_map;
  /// Goals and home that arrived since the last tick, in order. The mission empties it and answers each in `results`.
  std::vector<common::OperatorCommand> commands;

  // Out.
  /// The wish of this tick. The ids of one mission rise from 1; the same id is the same wish. None only when nothing in
  /// the tree has the vehicle (the mission has ended or all of it was skipped).
  std::optional<common::Intent> intent;
  std::vector<common::Event> events;           ///< Appended.
  std::vector<common::CommandResult> results;  ///< Appended.
};

}  // namespace swiftlet::behaviors
