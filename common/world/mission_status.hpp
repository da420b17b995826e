// The status of the mission.
#pragma once

#include <string>

#include "common/world/tree_view.hpp"

namespace swiftlet::common {

/// kStopped: the operator landed the vehicle before the mission's end.
enum class MissionState { kReady, kRunning, kHeld, kDone, kFailed, kStopped };
const char* toString(MissionState state);
bool isOver(MissionState state);

/// What controls the vehicle: the mission, or what overrides it. kOperator: a hold, a flight home or a landing that the
/// operator requested. kSupervisor: the supervisor, without a request.
enum class FlownBy { kMission, kOperator, kSupervisor, kPilot };
const char* toString(FlownBy by);

struct MissionStatus {
  MissionState state = MissionState::kReady;
  std::string name;  ///< The ID of its tree.
  FlownBy flown_by = FlownBy::kMission;
  std::string phase;   ///< What the vehicle does, in words: the intent of `flown_by`.
  std::string reason;  ///< Why it does that, where it is not the mission's own; why the mission failed or holds.
  bool accepts_goals = true;
  std::string question;  ///< What the mission waits for the operator to confirm by "go on"; empty if it does not.
  TreeView tree;

  bool operator==(const MissionStatus&) const = default;
};

}  // namespace swiftlet::common
