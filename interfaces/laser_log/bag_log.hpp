// The laser scans of a rosbag 1 file, from the first topic that has some.
#pragma once

#include <filesystem>
#include <memory>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

std::unique_ptr<LaserLog> openBagLog(const std::filesystem::path& file, const LaserLogOptions& options);

}  // namespace swiftlet::interfaces
