// Trajectories to be compared, whoever wrote them: as the TUM benchmark does, or as reference poses of a laser log
// (`ipc_timestamp scan_index x y theta`: seconds, metres, radians, in the plane).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"

namespace swiftlet::interfaces {

/// The poses in the order of the file, plain or compressed; which of the two it is tells the number of words on its
/// first line. Stamps may repeat and go back. Throws InputError with file, line and column for anything that is not a
/// pose, and for a file without any.
std::vector<common::StampedPose> readPoses(const std::filesystem::path& file);

/// Reference poses alone; `name` stands for the file in messages.
std::vector<common::StampedPose> parseReferencePoses(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
