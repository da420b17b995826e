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

bool isOver(MissionState state) {
  return state == MissionState::kDone || state == MissionState::kFailed || state == MissionState::kStopped;
}

}  // namespace swiftlet::common
