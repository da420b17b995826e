// CARMEN's text logs, one message a line: scans in the old form (FLASER) and in the new one (ROBOTLASER1); metres and
// radians. Source: CARMEN's message definitions, conventions in docs/conventions.md.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include <tl/expected.hpp>

#include "interfaces/laser_log/text_log.hpp"

namespace swiftlet::interfaces {

/// The value in the line.
struct CarmenScan {
  common::LaserScan scan;
  common::Pose2 T_odom_laser, T_odom_robot;
};

/// The scan of a FLASER or ROBOTLASER1 line; nullopt for any other line. An old line does not describe its laser: 180
/// degrees are spread over its beams, as for SICK lasers, and 49.9 m or more is no return.
tl::expected<std::optional<CarmenScan>, RecordProblem> parseCarmenLine(std::string_view line);

/// Whether a line looks like one of a CARMEN log.
bool isCarmenLine(std::string_view line);

/// Whether a line without a scan is one that CARMEN does not write: neither empty, nor a comment, nor a message, which
/// is plain text and begins with its name in capitals. A name with one letter different from that of a scan also counts
/// as garbled.
bool isGarbledCarmenLine(std::string_view line);

/// Reads the file's first records to find the mount of the laser.
std::unique_ptr<LogFormat> carmenFormat(const std::filesystem::path& file, const LaserLogOptions& options);

}  // namespace swiftlet::interfaces
