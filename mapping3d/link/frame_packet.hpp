// An RGB-D frame as it goes over the radio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "common/rgbd_frame.hpp"

namespace swiftlet::mapping3d {

/// Each packet stands for itself: what is lost or overtaken on the way changes no other frame.
struct FramePacket {
  common::Stamps stamps;
  common::Duration row_time;
  common::PinholeCamera camera;
  std::vector<std::uint8_t> color;  ///< JPEG.
  std::vector<std::uint8_t> depth;  ///< See encodeDepth.

  /// With stamps and camera, 64 bytes.
  std::size_t bytes() const { return 64 + color.size() + depth.size(); }
};

/// Depth without loss, colour by JPEG of that quality, 1 to 100. Both images must have the size of the camera. A pure
/// function.
FramePacket packed(const common::RgbdFrame& frame, int jpeg_quality);

/// The frame with half the pixels across and down: colours averaged, depths those of the nearest surface in whole
/// millimetres. A pure function.
common::RgbdFrame halved(const common::RgbdFrame& frame);

/// The reason of an error is for people.
tl::expected<common::RgbdFrame, std::string> unpacked(const FramePacket& packet);

/// What the frame takes unpacked: three bytes of colour and four of depth a pixel.
std::size_t rawBytes(const common::RgbdFrame& frame);

}  // namespace swiftlet::mapping3d
