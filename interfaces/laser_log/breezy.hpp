// BreezySLAM's .dat logs, one scan a line: numbers separated by blanks. The first is the time (us), the third and the
// fourth are the ticks of the left and the right wheel, and all from the 25th on are ranges (mm). They come from one
// rover, with a Hokuyo URG-04LX ahead of its axle. Source: the format as BreezySLAM's example documents it, and the
// data sheet of the laser.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "interfaces/laser_log/text_log.hpp"

namespace swiftlet::interfaces {

/// Whether a line can be from such a log: only numbers, at least as many as a scan has, the first ones integers.
bool isBreezyLine(std::string_view line);

/// Odometry starts at the origin. Nothing in a line says whether it is complete, so only lines with as many ranges as
/// most of the first lines of the file are scans.
std::unique_ptr<LogFormat> breezyFormat(const std::filesystem::path& file, const LaserLogOptions& options);

}  // namespace swiftlet::interfaces
