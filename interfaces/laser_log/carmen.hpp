// CARMEN's text logs, one message a line: scans in the old form (FLASER) and in the new one (ROBOTLASER1); metres and
// radians. Source: CARMEN's message definitions, conventions in docs/conventions.md.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include <tl/expected.hpp>

#include "interfaces/laser_log/text_log.hpp"

namespace swiftlet::interfaces {

/// As the line has it.
struct CarmenScan {
  common::LaserScan scan;
  common::Pose2 T_odom_laser, T_odom_robot;
};

/// The scan of a FLASER or ROBOTLASER1 line; nothing for any other line. An old line does not say what its laser is:
/// 180 degrees spread over its beams, as SICK lasers have them, and no return at 49.9 m or beyond.
tl::expected<std::optional<CarmenScan>, RecordProblem> parseCarmenLine(std::string_view line);

/// Whether a line looks like one of CARMEN's.
bool isCarmenLine(std::string_view line);

/// Whether a line without a scan is none that CARMEN writes: neither empty, nor a comment, nor a message, which is
/// plain text and begins with its name in capitals. A name that is that of a scan but for one letter is garbled too.
bool isGarbledCarmenLine(std::string_view line);

/// Reads the file's first records to see how the laser is mounted.
std::unique_ptr<LogFormat> carmenFormat(const std::filesystem::path& file, const LaserLogOptions& options);

}  // namespace swiftlet::interfaces
