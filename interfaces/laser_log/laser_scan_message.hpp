// sensor_msgs/LaserScan as ROS 1 puts it on the wire.
#pragma once

#include <cstddef>
#include <string_view>

#include <tl/expected.hpp>

#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/log_fields.hpp"

namespace swiftlet::interfaces {

/// Header with its frame's name, seven numbers, ranges and intensities of kMaxBeams.
constexpr std::size_t kMostScanBytes = std::size_t{8} * kMaxBeams + 4096;

inline constexpr std::string_view kLaserScanType = "sensor_msgs/LaserScan";

/// By its type, and by the definition of it: another one is another layout.
bool isLaserScan(const BagConnection& connection);

/// Stamped as its header says, or as it was recorded where that says nothing. A fan that runs clockwise is turned
/// round. The mount is not known to it.
tl::expected<LoggedScan, RecordProblem> parseLaserScan(const BagMessage& message);

}  // namespace swiftlet::interfaces
