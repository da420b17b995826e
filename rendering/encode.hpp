// Encodes pictures for files: PNG (libpng), whose bytes are the same for the same picture (no time stamps, fixed
// compression), and Base64. Streams take common/jpeg_encoder.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/image.hpp"

namespace swiftlet::rendering {

using Bytes = std::vector<std::uint8_t>;

Bytes encodePng(const common::Image& image);

/// Base64, for pictures inside HTML and SVG.
std::string base64(const Bytes& bytes);

}  // namespace swiftlet::rendering
