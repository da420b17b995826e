// The reference of recorded RGB-D cameras, and lenses of theirs that their formats do not tell.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <fmt/format.h>

#include "common/trajectory.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"
#include "interfaces/rgbd/rgbd_listing.hpp"

namespace swiftlet::test_support {

/// The poses of 7-Scenes: a 4x4 matrix a frame, camera to world.
inline common::Trajectory sevenScenesPoses(const std::filesystem::path& folder) {
  std::map<int, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".pose.txt")) files[std::stoi(name.substr(std::string("frame-").size()))] = entry.path();
  }
  common::Trajectory poses;
  for (const auto& [number, path] : files) {
    std::ifstream file(path);
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) file >> matrix(row, column);
    if (!file) continue;
    poses.push_back({common::Time::fromSeconds(number / interfaces::kNumberedFrames_Hz),
                     {Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized(),
                      matrix.topRightCorner<3, 1>()}});
  }
  return poses;
}

/// groundtruth.txt of TUM RGB-D, or the pose files of 7-Scenes.
inline common::Trajectory recordedReference(const std::filesystem::path& folder) {
  const std::filesystem::path tum = folder / "groundtruth.txt";
  if (std::filesystem::exists(tum))
    return common::ordered(interfaces::readTum(tum, interfaces::StampOrder::kAny)).trajectory;
  return sevenScenesPoses(folder);
}

/// The lens of the first camera of TUM RGB-D ("freiburg1"), as the benchmark gives it.
inline interfaces::RgbdCalibration freiburg1Calibration() {
  interfaces::RgbdCalibration calibration = interfaces::tumCalibration();
  calibration.color = {640, 480, 517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  return calibration;
}

}  // namespace swiftlet::test_support
