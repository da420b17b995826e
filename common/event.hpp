// A message for the operator: a state change, a priority switch, a refusal, a fault. Events go to the page, to the
// terminal and to events.jsonl.
#pragma once

#include <array>
#include <string>

#include "common/time.hpp"

namespace swiftlet::common {

enum class Severity { kInfo, kWarning, kError };
inline constexpr std::array kSeverities{Severity::kInfo, Severity::kWarning, Severity::kError};
const char* toString(Severity severity);

struct Event {
  Time stamp;
  Severity severity = Severity::kInfo;
  std::string source;        ///< The component that reports it: "mission", "flight", "slam2d", "avoidance" ...
  std::string text;          ///< What happened, with values.
  std::string reason;        ///< Why; may be empty.
  std::string vehicle = {};  ///< Name of the vehicle; empty if there is only one.
};

}  // namespace swiftlet::common
