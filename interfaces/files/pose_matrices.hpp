// Poses as matrices: twelve numbers a line (KITTI), sixteen in a line or in four lines, with or without a frame number.
// KITTI and the RGB-D data sets give the pose of the camera in the world.
//
//   12 numbers a line       the upper three rows: KITTI
//   16 numbers a line       all four rows
//   13 or 17 numbers a line the frame's number and the above: KITTI-360
//   4 lines of 4 numbers    one pose after the other: 7-Scenes, ScanNet
//   the same after 3 whole numbers, `i i j`, the first of which is the frame's: Open3D's .log
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"
#include "interfaces/files/text_file.hpp"

namespace swiftlet::interfaces {

/// The key by which poses of two files are paired.
enum class PoseOrder {
  kStamps,   ///< Stamps, in seconds.
  kNumbers,  ///< Frame numbers: frame n has the stamp n seconds.
  kLines,    ///< Only the order of the poses: the n-th has the stamp n seconds, counted from 0.
};

struct RecordedPoses {
  PoseOrder order = PoseOrder::kStamps;
  std::vector<common::StampedPose> poses;  ///< In the order of the file; stamps may repeat and go back.
  std::size_t without_pose = 0;            ///< Frames left out because their matrix holds no finite number (ScanNet).
};

/// Whether a file that begins with this line holds matrices.
bool areMatrices(const std::vector<Word>& words);

/// Throws InputError with file, line and column for anything else, for a matrix that is no pose, and for one that was
/// cut. Rotations are normalized. There is no pose if all frames are without one.
RecordedPoses readPoseMatrices(const std::filesystem::path& file);
/// Messages use `name` as the file.
RecordedPoses parsePoseMatrices(std::string_view text, const std::string& name);

/// Throws InputError if there is no pose.
void requireFinitePoses(const RecordedPoses& found, const std::filesystem::path& path);

}  // namespace swiftlet::interfaces
