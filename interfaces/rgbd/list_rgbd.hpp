// Recognizes recordings of RGB-D cameras.
//
//   associations.txt, or rgb.txt and depth.txt         TUM RGB-D
//   frame-000000.color.png or .jpg, .depth.png         7-Scenes; tsdf-fusion with camera-intrinsics.txt
//   color/ (or rgb/, image/) and depth/                Open3D and Redwood: camera_intrinsic.json, trajectory.log
//   the same with intrinsic/intrinsic_depth.txt        ScanNet, as its SensReader exports it
//   a rosbag 1                                         topics with images, depths and sensor_msgs/CameraInfo
#pragma once

#include <filesystem>
#include <string>

#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::interfaces {

/// `recording` is a folder, or the file of a bag. Throws InputError for any other folder or file, for one that lacks a
/// part of its format (with that part), for a list that cannot be read (with file, line and column), and for a
/// recording without a single pair. A calibration file (YAML) holds what differs from the calibration of the recording;
/// what it does not name stays. If none is given, a calibration.yaml in the folder is read. Throws InputError for its
/// mistakes, all at once. Where no calibration says otherwise, the unit of the depths is told from some of them if the
/// usual one makes them implausible.
RgbdListing listRgbdFolder(const std::filesystem::path& recording, const std::string& calibration_file = {});

}  // namespace swiftlet::interfaces
