// BreezySLAM's .dat logs, one scan a line: blank-separated numbers, of which the first is the time (us), the third and
// the fourth the ticks of the left and the right wheel, and all from the 25th on ranges (mm). They come from one rover,
// with a Hokuyo URG-04LX ahead of its axle. Source: the format as BreezySLAM's example documents it, and the data sheet
// of the laser.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "interfaces/laser_log/text_log.hpp"

namespace swiftlet::interfaces {

/// Whether a line can be one of such a log: numbers only, as many as a scan has at least, the first ones whole.
bool isBreezyLine(std::string_view line);

/// Odometry begins at the origin. Nothing in a line says whether it is whole, so that only lines of as many ranges as
/// most of the first ones of the file have are scans.
std::unique_ptr<LogFormat> breezyFormat(const std::filesystem::path& file, const LaserLogOptions& options);

}  // namespace swiftlet::interfaces
