// A colour picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace swiftlet::common {

/// An 8-bit RGB picture, row by row from the top left.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width_px * height_px bytes.
};

/// What an image shows, for its encoder. A drawing has even areas and thin coloured lines, a photo has neither.
enum class ImageContent { kDrawing, kPhoto };

}  // namespace swiftlet::common
