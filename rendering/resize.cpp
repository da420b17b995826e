#include "rendering/resize.hpp"

#include <algorithm>
#include <array>

#include "common/check.hpp"

namespace swiftlet::rendering {
namespace {

/// Adds the part of source rows that new row `y` covers, weighted in units of 1 / new height.
void addRows(const common::Image& image, int y, int height_px, std::vector<std::uint32_t>& sum) {
  std::fill(sum.begin(), sum.end(), 0u);
  const long begin = static_cast<long>(y) * image.height_px, end = begin + image.height_px;
  for (long row = begin / height_px; row * height_px < end; ++row) {
    const long weight = std::min(end, (row + 1) * height_px) - std::max(begin, row * height_px);
    const std::uint8_t* source = &image.rgb[static_cast<std::size_t>(row) * sum.size()];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<std::uint32_t>(weight) * source[i];
  }
}

}  // namespace

common::Image shrinkToWidth(const common::Image& image, int width_px) {
  SWIFTLET_CHECK(width_px > 0 && image.width_px > 0 && image.height_px > 0, width_px);
  SWIFTLET_CHECK(image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) * image.height_px);
  if (image.width_px <= width_px) return image;
  const int height_px = std::max(1, static_cast<int>(static_cast<long>(image.height_px) * width_px / image.width_px));
  common::Image small{width_px, height_px, {}};
  small.rgb.resize(3 * static_cast<std::size_t>(width_px) * height_px);
  const std::uint64_t area = static_cast<std::uint64_t>(image.width_px) * image.height_px;
  std::vector<std::uint32_t> row(3 * static_cast<std::size_t>(image.width_px));
  for (int y = 0; y < height_px; ++y) {
    addRows(image, y, height_px, row);
    for (int x = 0; x < width_px; ++x) {
      std::array<std::uint64_t, 3> sum{};
      const long begin = static_cast<long>(x) * image.width_px, end = begin + image.width_px;
      for (long column = begin / width_px; column * width_px < end; ++column) {
        const long weight = std::min(end, (column + 1) * width_px) - std::max(begin, column * width_px);
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += static_cast<std::uint64_t>(weight) * row[3 * static_cast<std::size_t>(column) + c];
      }
      for (std::size_t c = 0; c < 3; ++c)
        small.rgb[3 * (static_cast<std::size_t>(y) * width_px + x) + c] =
            static_cast<std::uint8_t>((sum[c] + area / 2) / area);
    }
  }
  return small;
}

}  // namespace swiftlet::rendering
