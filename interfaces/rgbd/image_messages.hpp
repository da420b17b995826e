// sensor_msgs/Image, CompressedImage and CameraInfo as ROS 1 puts them on the wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "common/image.hpp"
#include "common/image_decoder.hpp"
#include "common/message.hpp"
#include "common/time.hpp"
#include "interfaces/laser_log/bag_reader.hpp"
#include "interfaces/rgbd/rgbd_calibration.hpp"

namespace swiftlet::interfaces {

/// Recognizes the three types by their names and the hashes of their definitions: another definition is another layout.
bool isImage(const BagConnection& connection);
bool isCompressedImage(const BagConnection& connection);
bool isCameraInfo(const BagConnection& connection);

/// The longest message of these types: an image of kMostImageSide_px with four bytes a pixel.
inline constexpr std::size_t kMostImageMessageBytes =
    std::size_t{4} * common::kMostImageSide_px * common::kMostImageSide_px + 4096;

enum class ImageKind {
  kColor,
  kGrey,  ///< One colour, as of an infrared camera.
  kDepth,
  kOther,  ///< Of an encoding that is not read.
};

/// What an image message says before its pixels.
struct ImageHeader {
  common::Time stamp;  ///< That of the recording where the message has none.
  std::string frame;   ///< Of the camera.
  std::string encoding;
  ImageKind kind = ImageKind::kOther;
};

/// nullopt if the message is cut. Of isImage() or isCompressedImage().
std::optional<ImageHeader> imageHeader(const BagMessage& message);

/// The pixels. Images are rgb8, bgr8, rgba8, bgra8 or mono8, or compressed as PNG or JPEG.
tl::expected<common::Image, common::ImageFault> colorOf(const BagMessage& message);

/// Depths of a 32FC1 image, which are metres, are stored as this many a metre: up to 13 m, to 0.2 mm.
inline constexpr double kFloatUnits_per_m = 5000.0;
/// Depths are 16UC1 or mono16, millimetres by REP 118, or 32FC1, metres or, plainly, millimetres; raw, or compressed by
/// the transport `compressedDepth`.
tl::expected<common::DepthCodes, common::ImageFault> depthOf(const BagMessage& message);

/// A camera as CameraInfo has it.
struct CameraInfo {
  LensCalibration raw;        ///< With its distortion: matrix K.
  LensCalibration rectified;  ///< Without: matrix P.
  std::string frame;
};

/// Fails for a distortion that is not Brown's (`plumb_bob`, or `rational_polynomial` without its last three numbers).
tl::expected<CameraInfo, common::Message> cameraInfoOf(const BagMessage& message);

}  // namespace swiftlet::interfaces
