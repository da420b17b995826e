// Rules for the scans of every log, whatever its format.
#pragma once

#include <optional>
#include <string>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

/// Applies the geometry and the mount of `sensor`, if one is given, and converts the ranges to those of LaserScan: NaN
/// for negative ones, infinite at the laser's greatest range and beyond. Returns a problem if no laser can have such a
/// geometry; the scan must not be used then.
std::optional<common::Message> completeScan(const std::optional<common::LaserConfig>& sensor, LoggedScan& logged);

}  // namespace swiftlet::interfaces
