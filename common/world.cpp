#include "common/world.hpp"

#include "common/check.hpp"

namespace swiftlet::common {

const char* toString(FlightState state) {
  switch (state) {
    case FlightState::kPreparation:
      return "preparation";
    case FlightState::kPoweredOff:
      return "powered off";
    case FlightState::kLanded:
      return "landed";
    case FlightState::kTakingOff:
      return "taking off";
    case FlightState::kFlying:
      return "flying";
    case FlightState::kLanding:
      return "landing";
    case FlightState::kEmergencyLanding:
      return "emergency landing";
  }
  SWIFTLET_CHECK(false, static_cast<int>(state));
}

const char* toString(FrontierReason reason) {
  switch (reason) {
    case FrontierReason::kOpen:
      return "open";
    case FrontierReason::kTooSmall:
      return "too small";
    case FrontierReason::kUnreachable:
      return "unreachable";
    case FrontierReason::kOutOfBounds:
      return "out of bounds";
    case FrontierReason::kBlacklisted:
      return "blacklisted";
  }
  SWIFTLET_CHECK(false, static_cast<int>(reason));
}

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
