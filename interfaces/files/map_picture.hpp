// The pictures of maps as map_server takes them, recognized by their bytes and not by their name: PGM and PPM of up to
// 16 bits, PNG of any kind, BMP and JPEG.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/image_decoder.hpp"

namespace swiftlet::interfaces {

struct MapPicture {
  common::GreyImage image;
  std::size_t left_over_bytes = 0;  ///< How many bytes follow the pixels of a PGM, PPM or PNG.
};

/// Messages use `name` as the file. Throws InputError.
MapPicture parsePicture(std::string_view bytes, const std::string& name);

/// Whether a file begins as such a picture does; false for one that cannot be read.
bool isPicture(const std::filesystem::path& file);

}  // namespace swiftlet::interfaces
