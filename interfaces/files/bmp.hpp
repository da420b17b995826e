// Pictures in the format BMP, of which map_server's maps may be. Source: Microsoft, "Bitmap Storage" and the structures
// BITMAPCOREHEADER to BITMAPV5HEADER.
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "common/image_decoder.hpp"

namespace swiftlet::interfaces {

/// Pictures of 1, 4, 8, 16, 24 or 32 bits a pixel that are not compressed, from the bottom up or the top down. The
/// reason of an error is for people: "is compressed by run lengths (RLE8)".
tl::expected<common::GreyImage, std::string> decodeBmp(std::string_view bytes);

}  // namespace swiftlet::interfaces
