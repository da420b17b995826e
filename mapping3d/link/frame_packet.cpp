#include "mapping3d/link/frame_packet.hpp"

#include <string_view>
#include <utility>

#include "common/check.hpp"
#include "common/image_decoder.hpp"
#include "common/jpeg_encoder.hpp"
#include "mapping3d/link/depth_codec.hpp"

namespace swiftlet::mapping3d {
FramePacket packed(const common::RgbdFrame& frame, int jpeg_quality) {
  const auto pixels = static_cast<std::size_t>(frame.camera.pixels());
  SWIFTLET_CHECK(pixels > 0 && frame.color.rgb.size() == 3 * pixels && frame.depth.depth_m.size() == pixels, pixels);
  common::JpegEncoder jpeg(common::JpegContent::kPhoto);
  return {frame.stamps, frame.row_time, frame.camera, jpeg.encode(frame.color, jpeg_quality), encodeDepth(frame.depth)};
}

tl::expected<common::RgbdFrame, std::string> unpacked(const FramePacket& packet) {
  auto color = common::decodeColor({reinterpret_cast<const char*>(packet.color.data()), packet.color.size()});
  if (!color) return tl::unexpected("colour " + color.error());
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
