#include "common/png_encoder.hpp"

#include <png.h>

#include "common/check.hpp"

namespace swiftlet::common {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* bytes = static_cast<Bytes*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), data, data + size);
}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  // Only memory can run out, because the arguments were checked and the output is a vector.
  checkFailed("libpng", __FILE__, __LINE__, std::string(" ") + message);
}

struct Format {
  int width_px, height_px;
  int bits;
  int color;
  int filters;
  int level;  ///< Of compression, 1 to 9.
};

/// `row(y)` points to the bytes of row y, in the byte order of PNG.
template <typename Row>
Bytes encode(const Format& format, const Row& row) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(format.width_px), static_cast<png_uint_32>(format.height_px),
               format.bits, format.color, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, format.filters);
  png_set_compression_level(png, format.level);
  png_write_info(png, info);
  for (int y = 0; y < format.height_px; ++y) png_write_row(png, row(y));
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

Bytes encodePng(const Image& image, ImageContent content) {
  SWIFTLET_CHECK(image.width_px > 0 && image.height_px > 0, image.width_px, image.height_px);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  const bool drawn = content == ImageContent::kDrawing;
  const Format format{image.width_px, image.height_px, 8, PNG_COLOR_TYPE_RGB, drawn ? PNG_FILTER_NONE : PNG_FILTER_UP,
                      drawn ? 6 : 3};
  return encode(format, [&](int y) { return &image.rgb[3 * static_cast<std::size_t>(y) * image.width_px]; });
}

Bytes encodePng(const DepthCodes& depth) {
  SWIFTLET_CHECK(depth.width_px > 0 && depth.height_px > 0, depth.width_px, depth.height_px);
  SWIFTLET_CHECK(depth.codes.size() == static_cast<std::size_t>(depth.width_px) * depth.height_px);
  Bytes line(2 * static_cast<std::size_t>(depth.width_px));
  const Format format{depth.width_px, depth.height_px, 16, PNG_COLOR_TYPE_GRAY, PNG_FILTER_UP, 3};
  return encode(format, [&](int y) {
    const std::uint16_t* codes = &depth.codes[static_cast<std::size_t>(y) * depth.width_px];
    for (std::size_t i = 0; i < line.size() / 2; ++i) {  // The high byte first.
      line[2 * i] = static_cast<std::uint8_t>(codes[i] >> 8);
      line[2 * i + 1] = static_cast<std::uint8_t>(codes[i] & 0xFF);
    }
    return line.data();
  });
}

}  // namespace swiftlet::common
