// Trajectories to compare: a file of the TUM benchmark, of reference poses of a laser log (`ipc_timestamp scan_index x
// y theta`: seconds, metres, radians, in the plane) or of pose matrices, or a folder of a data set or of a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"
#include "interfaces/files/pose_matrices.hpp"

namespace swiftlet::interfaces {

/// The poses in the order of the file, plain or compressed. The number of words on line 1 decides the format. Of
/// a folder: its trajectory.tum, groundtruth.txt or trajectory.log, or else its numbered frames, which may be in pose/
/// (ScanNet). Throws InputError with file, line and column for anything that is not a pose, and if there is not a
/// single one.
RecordedPoses readRecordedPoses(const std::filesystem::path& path);

/// The poses of a file that has stamps. Throws InputError for one that has none.
std::vector<common::StampedPose> readPoses(const std::filesystem::path& file);

/// Reads reference poses only. Messages use `name` as the file.
std::vector<common::StampedPose> parseReferencePoses(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
