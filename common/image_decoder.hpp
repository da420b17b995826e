// Decodes images of recorded frames, of textures and of maps: colour and brightness from PNG or JPEG, depth from 16-bit
// PNG. Bytes may be anything; what is not a whole image is an error with its reason, never a crash.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "common/image.hpp"
#include "common/message.hpp"

namespace swiftlet::common {

/// The numbers of a depth image as they are stored, row by row from the top left.
struct DepthCodes {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> codes;
};

/// Row by row from the top left.
struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> brightness;  ///< The mean of red, green and blue; 255 is white.
  std::vector<std::uint8_t> opacity;     ///< 255 is opaque; empty if every pixel is.
};

/// Images wider or higher than this are refused.
inline constexpr int kMostImageSide_px = 8192;
/// The same for images of which only the brightness is read.
inline constexpr int kMostGreySide_px = 1 << 15;

/// Why bytes are not an image that is read.
struct ImageFault {
  Message reason;           ///< "is cut off".
  bool is_damaged = false;  ///< Bytes are missing or changed, which no other program can mend.
};

tl::expected<Image, ImageFault> decodeColor(std::string_view bytes);
tl::expected<DepthCodes, ImageFault> decodeDepth(std::string_view bytes);
/// PNG of any colour type and depth, or JPEG.
tl::expected<GreyImage, ImageFault> decodeGrey(std::string_view bytes);

}  // namespace swiftlet::common
