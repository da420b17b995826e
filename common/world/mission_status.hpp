// The status of the mission and of its tree.
#pragma once

#include <string>
#include <vector>

namespace swiftlet::common {

/// One node of the mission tree, for the page.
struct TreeNodeView {
  int id = 0;
  int parent = -1;  ///< -1 for the root.
  std::string name;
  std::string status;  ///< IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED, SUSPENDED.

  bool operator==(const TreeNodeView&) const = default;
};
using TreeView = std::vector<TreeNodeView>;

/// kStopped: the operator landed the vehicle before the mission's end.
enum class MissionState { kReady, kRunning, kHeld, kDone, kFailed, kStopped };
const char* toString(MissionState state);
bool isOver(MissionState state);

struct MissionStatus {
  MissionState state = MissionState::kReady;
  std::string phase;   ///< The intent in words.
  std::string reason;  ///< Why it failed or holds.
  bool accepts_goals = true;
  std::string question;  ///< What the mission waits for the operator to confirm by "go on"; empty if it does not.
  TreeView tree;

  bool operator==(const MissionStatus&) const = default;
};

}  // namespace swiftlet::common
