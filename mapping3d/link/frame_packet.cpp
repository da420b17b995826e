#include "mapping3d/link/frame_packet.hpp"

#include <cmath>
#include <string_view>
#include <utility>

#include "common/check.hpp"
#include "common/image_decoder.hpp"
#include "common/jpeg_encoder.hpp"
#include "mapping3d/link/depth_codec.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::mapping3d {
namespace {

/// Means of depths, as encodeDepth packs them best.
float inMillimetres_m(float depth_m) {
  return static_cast<float>(std::round(1000.0 * static_cast<double>(depth_m)) / 1000.0);
}

}  // namespace

FramePacket packed(const common::RgbdFrame& frame, int jpeg_quality) {
  const auto pixels = static_cast<std::size_t>(frame.camera.pixels());
  SWIFTLET_CHECK(pixels > 0 && frame.color.rgb.size() == 3 * pixels && frame.depth.depth_m.size() == pixels, pixels);
  common::JpegEncoder jpeg(common::ImageContent::kPhoto);
  return {frame.stamps, frame.row_time, frame.camera, jpeg.encode(frame.color, jpeg_quality), encodeDepth(frame.depth)};
}

common::RgbdFrame halved(const common::RgbdFrame& frame) {
  common::RgbdFrame half{
      frame.stamps, frame.row_time * 2, vision::halved(frame.camera), {}, vision::halved(frame.depth)};
  for (float& depth_m : half.depth.depth_m)
    if (common::isMeasured(depth_m)) depth_m = inMillimetres_m(depth_m);
  half.color = {half.camera.width_px, half.camera.height_px, {}};
  half.color.rgb.reserve(3 * half.depth.depth_m.size());
  const std::size_t row = 3 * static_cast<std::size_t>(frame.color.width_px);
  for (int v = 0; v < half.color.height_px; ++v)
    for (int u = 0; u < half.color.width_px; ++u) {
      const std::uint8_t* at =
          &frame.color.rgb[2 * (static_cast<std::size_t>(v) * row + 3 * static_cast<std::size_t>(u))];
      for (int c = 0; c < 3; ++c, ++at)
        half.color.rgb.push_back(static_cast<std::uint8_t>((at[0] + at[3] + at[row] + at[row + 3] + 2) >> 2));
    }
  return half;
}

tl::expected<common::RgbdFrame, std::string> unpacked(const FramePacket& packet) {
  auto color = common::decodeColor({reinterpret_cast<const char*>(packet.color.data()), packet.color.size()});
  if (!color) return tl::unexpected("colour " + color.error().reason.text());
  if (color->width_px != packet.camera.width_px || color->height_px != packet.camera.height_px)
    return tl::unexpected(std::string("colour does not have the size of the camera"));
  auto depth = decodeDepth(packet.depth, packet.camera.width_px, packet.camera.height_px);
  if (!depth) return tl::unexpected("depth " + depth.error());
  return common::RgbdFrame{packet.stamps, packet.row_time, packet.camera, std::move(*color), std::move(*depth)};
}

std::size_t rawBytes(const common::RgbdFrame& frame) {
  return frame.color.rgb.size() + sizeof(float) * frame.depth.depth_m.size();
}

}  // namespace swiftlet::mapping3d
