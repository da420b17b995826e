// Opens a recorded laser log of any format known here.
#pragma once

#include <filesystem>
#include <memory>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

/// Opens a log by what is in it; plain, or compressed by gzip, bzip2 or xz. Throws InputError when there is no such
/// file, or it is no log of a format known here. Of a bag, the first topic with laser scans is read.
std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& file, const LaserLogOptions& options = {});

}  // namespace swiftlet::interfaces
