// The status of the mission.
#pragma once

#include <string>

#include "common/world/tree_view.hpp"

namespace swiftlet::common {

/// kStopped: the operator landed the vehicle before the mission's end.
enum class MissionState { kReady, kRunning, kHeld, kDone, kFailed, kStopped };
const char* toString(MissionState state);
bool isOver(MissionState state);

struct MissionStatus {
  MissionState state = MissionState::kReady;
  std::string name;    ///< The ID of its tree.
  std::string phase;   ///< The intent in words.
  std::string reason;  ///< Why it failed or holds.
  bool accepts_goals = true;
  std::string question;  ///< What the mission waits for the operator to confirm by "go on"; empty if it does not.
  TreeView tree;

  bool operator==(const MissionStatus&) const = default;
};

}  // namespace swiftlet::common
