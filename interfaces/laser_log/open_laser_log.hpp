// Opens a recorded laser log of any supported format.
#pragma once

#include <filesystem>
#include <memory>

#include "interfaces/laser_log/laser_log.hpp"

namespace swiftlet::interfaces {

/// The content decides the format; the file is plain, or compressed by gzip, bzip2 or xz. Throws InputError if there is
/// no such file, or if its format is not supported. In a bag, the first topic with laser scans is read.
std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& file, const LaserLogOptions& options = {});

}  // namespace swiftlet::interfaces
