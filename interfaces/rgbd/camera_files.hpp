// The calibration of a recorded RGB-D camera as other programs write it beside their images.
//
//   camera_intrinsic.json, intrinsic.json        Open3D: width, height, intrinsic_matrix (column after column), and the
//                                                depth_scale of its recorders, units a metre
//   camera-intrinsics.txt                        tsdf-fusion: 3 x 3, of colours and depths alike
//   intrinsic/intrinsic_{color,depth}.txt        ScanNet: 4 x 4, each of its own images
//   intrinsic/extrinsic_{color,depth}.txt        ScanNet: the poses of both cameras
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {

/// The sizes of the images of the recording, for files that do not say to which size their numbers belong: they are
/// left out if no image can be read.
struct ImageSizes {
  int color_width_px = 0, color_height_px = 0;
  int depth_width_px = 0, depth_height_px = 0;
};

/// A calibration, and what it comes from.
struct CameraFile {
  std::string format;  ///< "Open3D", "ScanNet", "tsdf-fusion"; empty if the folder has no such file.
  std::filesystem::path file;
  RgbdCalibration calibration;
  bool has_units = false;  ///< The file says how depths are stored.
};

/// Looks for these files in the order above. Throws InputError with the place for one that cannot be read, that says
/// something impossible, or whose numbers belong to images of another size.
CameraFile findCameraFile(const std::filesystem::path& folder, const ImageSizes& sizes);

/// The same from the bytes of a file; messages use `name` as the file.
CameraFile parseOpen3dCamera(std::string_view json, const std::string& name);

/// The rows of a square matrix of 3 or 4 rows, one a line.
std::vector<double> parseCameraMatrix(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
