#include "common/world/mission_status.hpp"

#include "common/check.hpp"

namespace swiftlet::common {

const char* toString(MissionState state) {
  switch (state) {
    case MissionState::kReady:
      return "ready";
    case MissionState::kRunning:
      return "running";
    case MissionState::kHeld:
      return "held";
    case MissionState::kDone:
      return "done";
    case MissionState::kFailed:
      return "failed";
    case MissionState::kStopped:
      return "stopped";
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
}

const char* toString(FlownBy by) {
  switch (by) {
    case FlownBy::kMission:
      return "mission";
    case FlownBy::kOperator:
      return "operator";
    case FlownBy::kSupervisor:
      return "supervisor";
    case FlownBy::kPilot:
      return "pilot";
  }
  SWIFTLET_CHECK(false, static_cast<int>(by));
}

bool isOver(MissionState state) {
  return state == MissionState::kDone || state == MissionState::kFailed || state == MissionState::kStopped;
}

}  // namespace swiftlet::common
