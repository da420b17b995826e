#include "common/event.hpp"

namespace swiftlet::common {

const char* toString(Severity severity) {
  switch (severity) {
    case Severity::kInfo:
      return "info";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      return "error";
  }
  return "unknown";
}

std::string_view alarmOf(const Event& event) {
  if (event.severity == Severity::kInfo) return {};
  switch (event.concern) {
    case Concern::kNone:
      return {};
    case Concern::kTurnBack:
      return "turn back";
    case Concern::kLowBattery:
      return "low battery";
    case Concern::kLanding:
      return "landing";
    case Concern::kPosition:
      return "position lost";
    case Concern::kEstimate:
      return "estimate degraded";
    case Concern::kSurroundings:
      return "surroundings not seen";
    case Concern::kPilot:
      return "pilot";
    case Concern::kHome:
      return "home not reached";
    case Concern::kFlightEnded:
      return "flight ended";
  }
  return {};
}

}  // namespace swiftlet::common
