// A message for the operator: a state change, a priority switch, a refusal, a fault. Events go to the page, to the
// terminal and to events.jsonl.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "common/time.hpp"

namespace swiftlet::common {

enum class Severity { kInfo, kWarning, kError };
inline constexpr std::array kSeverities{Severity::kInfo, Severity::kWarning, Severity::kError};
const char* toString(Severity severity);

/// What an event means for the safety of the flight. Its reporter names what it is about; alarmOf() alone decides
/// whether the operator is alarmed.
enum class Concern {
  kNone,
  kTurnBack,
  kLowBattery,
  kLanding,       ///< Before its end, or without being asked.
  kPosition,      ///< Position or height.
  kEstimate,      ///< The fusion of the sensors.
  kSurroundings,  ///< No sensor sees them.
  kPilot,
  kHome,  ///< It is not reached, or cannot be.
  kFlightEnded,
};

struct Event {
  Time stamp;
  Severity severity = Severity::kInfo;
  std::string source;        ///< The component that reports it: "mission", "flight", "slam2d", "avoidance" ...
  std::string text;          ///< What happened, with values.
  std::string reason;        ///< Why; may be empty.
  std::string vehicle = {};  ///< Name of the vehicle; empty if there is only one.
  Concern concern = Concern::kNone;
};

/// The alarm of the event, in a few words for the operator; empty without one. An alarm must not be missed: the
/// vehicle does what the operator did not ask for, or soon will. These are the concerns of warnings.
std::string_view alarmOf(const Event& event);

}  // namespace swiftlet::common
