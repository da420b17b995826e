// Records the frames of an RGB-D camera as a folder in the format of TUM RGB-D, which `swiftlet map3d` and many other
// programs read:
//
//   rgb/<stamp>.png and depth/<stamp>.png (16 bits, 5000 a metre; 0: not measured, or too far), listed in rgb.txt and
//   depth.txt; calibration.yaml has the camera's intrinsics, groundtruth.txt the true poses where they are known.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>

#include "common/rgbd_frame.hpp"
#include "common/trajectory.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/tum.hpp"

namespace swiftlet::interfaces {

/// One thread. The lists name only images that are on the disk.
class RgbdRecorder {
 public:
  /// Makes the folder, whose parent must exist.
  [[nodiscard]] static tl::expected<RgbdRecorder, FileError> create(const std::filesystem::path& folder);

  /// Frames by rising stamps, all of the same camera. One whose images have fewer or more pixels than they say is left
  /// out and counted.
  [[nodiscard]] Written add(const common::RgbdFrame& frame);
  /// The true pose of the camera (frame `camera`) in the map. The file has it as the format does: x right, y down, z
  /// along the view.
  [[nodiscard]] Written addTruth(common::Time time, const common::Pose3& T_map_camera);

  std::size_t frames() const { return frames_; }
  std::size_t leftOut() const { return left_out_; }

 private:
  RgbdRecorder(std::filesystem::path folder, AppendFile colors, AppendFile depths)
      : folder_(std::move(folder)), colors_(std::move(colors)), depths_(std::move(depths)) {}

  std::filesystem::path folder_;
  AppendFile colors_;
  AppendFile depths_;
  std::optional<TumWriter> truth_;
  std::size_t frames_ = 0, left_out_ = 0;
};

}  // namespace swiftlet::interfaces
