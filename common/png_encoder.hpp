// Encodes images as PNG (libpng). The same image gives the same bytes: no time stamps, fixed compression.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image.hpp"
#include "common/image_decoder.hpp"

namespace swiftlet::common {

/// 8-bit RGB. Even areas of a drawing compress best and fastest as they are; a photo is predicted from neighbouring
/// pixels first. The image must have at least one pixel and as many bytes as its size says.
std::vector<std::uint8_t> encodePng(const Image& image, ImageContent content = ImageContent::kDrawing);
/// 16-bit grey.
std::vector<std::uint8_t> encodePng(const DepthCodes& depth);

}  // namespace swiftlet::common
