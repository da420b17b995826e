// Trajectories to compare, in one of two formats: that of the TUM benchmark, or reference poses of a laser log
// (`ipc_timestamp scan_index x y theta`: seconds, metres, radians, in the plane).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"

namespace swiftlet::interfaces {

/// The poses in the order of the file, plain or compressed. The number of words on the first line tells the format.
/// Stamps may repeat and go back. Throws InputError with file, line and column for anything that is not a pose, and for
/// a file without any.
std::vector<common::StampedPose> readPoses(const std::filesystem::path& file);

/// Reads reference poses only. Messages use `name` as the file.
std::vector<common::StampedPose> parseReferencePoses(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
