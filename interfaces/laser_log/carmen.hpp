// CARMEN's text logs, one message a line: scans in the old form (FLASER) and in the new one (ROBOTLASER1); metres and
// radians. Source: CARMEN's message definitions, conventions in docs/conventions.md.
#pragma once

#include <optional>
#include <string_view>

#include <tl/expected.hpp>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

/// Why a line could not be read, and where in it.
struct LineProblem {
  int column = 0;
  std::string element;
  std::string message;
};

/// The scan of a FLASER or ROBOTLASER1 line; nothing for any other line. Ranges that are NaN or negative are NaN;
/// those at the laser's "no return" value are infinite. An old line does not say what its laser is: 180 degrees spread
/// over its beams, as SICK lasers have them, and no return at 49.9 m or beyond.
tl::expected<std::optional<LoggedScan>, LineProblem> parseCarmenLine(std::string_view line,
                                                                     const LaserLogOptions& options);

/// Whether a line looks like one of CARMEN's.
bool isCarmenLine(std::string_view line);

}  // namespace swiftlet::interfaces
