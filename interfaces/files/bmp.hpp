// Pictures in the format BMP, of which map_server's maps may be. Source: Microsoft, "Bitmap Storage" and the structures
// BITMAPCOREHEADER to BITMAPV5HEADER.
#pragma once

#include <string_view>

#include <tl/expected.hpp>

#include "common/image_decoder.hpp"

namespace swiftlet::interfaces {

/// Pictures of 1, 4, 8, 16, 24 or 32 bits a pixel that are not compressed, from the bottom up or the top down.
tl::expected<common::GreyImage, common::ImageFault> decodeBmp(std::string_view bytes);

}  // namespace swiftlet::interfaces
