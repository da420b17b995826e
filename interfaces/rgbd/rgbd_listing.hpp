// What a folder of recorded RGB-D frames holds: the pairs of image files in the order of their stamps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/time.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {

struct RgbdListing {
  struct Pair {
    common::Time stamp;
    std::filesystem::path color, depth;
    common::Duration depth_later = {};  ///< From the colour image to the depth image.
  };

  std::string format;           ///< For people: "TUM RGB-D".
  RgbdCalibration calibration;  ///< Calibration of the format.
  std::vector<Pair> pairs;
  /// Factor from the pairs' stamps to those in its lists: 1, or the frame rate where its lists number the
  /// frames.
  double stamps_per_s = 1.0;
  std::uint64_t unpaired = 0;  ///< Images of which the other one is not listed, or not at the same time.
};

/// Recognizes folders in the format of TUM RGB-D (associations.txt, or rgb.txt and depth.txt) and of 7-Scenes
/// (frame-XXXXXX.color.png or .jpg, .depth.png). Throws InputError for any other folder, for a list that cannot be read
/// (with file, line and column), and for a folder without a single pair. A calibration file (YAML) holds what differs
/// from the calibration of the format; what it does not name stays. If none is given, a calibration.yaml in the folder
/// is read. Throws InputError for its mistakes, all at once.
RgbdListing listRgbdFolder(const std::filesystem::path& folder, const std::string& calibration_file = {});

/// TUM: two images are a pair if their stamps are at most this apart, as in the benchmark's associate.py.
inline constexpr double kPairedWithin_s = 0.02;
/// The frame rate of recordings that number their frames instead of giving their times: 7-Scenes, ICL-NUIM.
inline constexpr double kNumberedFrames_Hz = 30.0;

}  // namespace swiftlet::interfaces
