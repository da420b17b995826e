// links: interfaces common
// Any bytes as the images of an RGB-D frame: an error with its reason, or an image of as many pixels as it says.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "common/image_decoder.hpp"

namespace {

std::size_t pixels(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto color = common::decodeColor(bytes)) {
    if (color->rgb.size() != 3 * pixels(color->width_px, color->height_px)) std::abort();
  } else if (color.error().reason.text().empty()) {
    std::abort();
  }
  if (const auto depth = common::decodeDepth(bytes)) {
    if (depth->codes.size() != pixels(depth->width_px, depth->height_px)) std::abort();
  } else if (depth.error().reason.text().empty()) {
    std::abort();
  }
  if (const auto grey = common::decodeGrey(bytes)) {
    const std::size_t count = pixels(grey->width_px, grey->height_px);
    if (grey->brightness.size() != count || (!grey->opacity.empty() && grey->opacity.size() != count)) std::abort();
  } else if (grey.error().reason.text().empty()) {
    std::abort();
  }
  return 0;
}
