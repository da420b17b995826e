// The poses of a data set that has one file with a 4x4 matrix for each frame, whose name holds the frame's number:
// frame-000123.pose.txt (7-Scenes), 123.txt or 000123.txt (ScanNet and others).
#pragma once

#include <filesystem>

#include "interfaces/files/pose_matrices.hpp"

namespace swiftlet::interfaces {

/// The poses in the order of the numbers. Throws InputError for a folder without such files, for two of one frame, and,
/// with file, line and column, for a file that is not one matrix.
RecordedPoses readNumberedFrames(const std::filesystem::path& folder);

}  // namespace swiftlet::interfaces
