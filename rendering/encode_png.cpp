#include <png.h>

#include "common/check.hpp"
#include "rendering/encode.hpp"

namespace swiftlet::rendering {
namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* bytes = static_cast<Bytes*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), data, data + size);
}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  // Only memory can run out, because the arguments were checked and the output is a vector.
  common::checkFailed("libpng", __FILE__, __LINE__, std::string(" ") + message);
}

}  // namespace

Bytes encodePng(const common::Image& image) {
  SWIFTLET_CHECK(image.width_px > 0 && image.height_px > 0, image.width_px, image.height_px);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width_px), static_cast<png_uint_32>(image.height_px), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Maps are large even areas: no filter compresses them best and fastest.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 6);
  png_write_info(png, info);
  for (int y = 0; y < image.height_px; ++y)
    png_write_row(png, &image.rgb[3 * static_cast<std::size_t>(y) * image.width_px]);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace swiftlet::rendering
