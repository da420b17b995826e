// sensor_msgs/LaserScan as ROS 1 puts it on the wire.
#pragma once

#include <cstddef>
#include <string_view>

#include <tl/expected.hpp>

#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/laser_log/laser_log.hpp"
#include "interfaces/laser_log/log_fields.hpp"

namespace swiftlet::interfaces {

/// Size of the header with the name of its frame, seven numbers, and ranges and intensities of kMaxBeams.
constexpr std::size_t kMostScanBytes = std::size_t{8} * kMaxBeams + 4096;

inline constexpr std::string_view kLaserScanType = "sensor_msgs/LaserScan";

/// Recognizes the message by its type and by the hash of its definition: another definition is another layout.
bool isLaserScan(const BagConnection& connection);

/// The stamp is that of the header, or the time of recording if the header has none. Scans that run clockwise are
/// reversed, their time with them. The message does not contain the mount.
tl::expected<LoggedScan, RecordProblem> parseLaserScan(const BagMessage& message);

}  // namespace swiftlet::interfaces
