// What a recording of an RGB-D camera holds: the pairs of images in the order of their stamps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/time.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {

/// Two topics of a rosbag.
struct BagImages {
  std::filesystem::path file;
  std::string color_topic, depth_topic;
};

struct RgbdListing {
  struct Pair {
    common::Time stamp;
    /// The files of the images. Of a bag, the names of the messages, whose numbers in their topics follow.
    std::filesystem::path color, depth;
    std::size_t color_message = 0, depth_message = 0;
    common::Duration depth_later = {};  ///< From the colour image to the depth image.
  };

  std::string format;           ///< For people: "TUM RGB-D".
  RgbdCalibration calibration;  ///< Of the format or of the recording, or that which the user gave.
  std::vector<Pair> pairs;
  /// Factor from the pairs' stamps to those in its lists: 1, or the frame rate where its lists number the
  /// frames.
  double stamps_per_s = 1.0;
  std::uint64_t unpaired = 0;    ///< Images of which the other one is not listed, or not at the same time.
  std::optional<BagImages> bag;  ///< Only of a bag.
  /// What was assumed where the recording says nothing, or found to be wrong with it; for people.
  std::vector<std::string> notes;
};

/// The frame rate of recordings that number their frames instead of giving their times: 7-Scenes, ICL-NUIM.
inline constexpr double kNumberedFrames_Hz = 30.0;

}  // namespace swiftlet::interfaces
