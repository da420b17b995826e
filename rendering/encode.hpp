// Encodes pictures for files: PNG (libpng), whose bytes are the same for the same picture (no time stamps, fixed
// compression). Streams take common/jpeg_encoder.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image.hpp"

namespace swiftlet::rendering {

using Bytes = std::vector<std::uint8_t>;

Bytes encodePng(const common::Image& image);

}  // namespace swiftlet::rendering
