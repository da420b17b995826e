// What holds for the scans of every log, whatever its format.
#pragma once

#include <optional>
#include <string>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

/// Takes the geometry and the mount of `sensor`, where one is given, and puts the ranges as LaserScan has them: NaN
/// where they are negative, infinite at the laser's greatest and beyond. Says what is wrong where no laser is like
/// that; the scan is not to be used then.
std::optional<std::string> completeScan(const std::optional<common::LaserConfig>& sensor, LoggedScan& logged);

}  // namespace swiftlet::interfaces
