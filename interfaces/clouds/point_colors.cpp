#include "interfaces/clouds/point_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

namespace swiftlet::interfaces {
namespace {

bool isFinite(const RawColor& color) {
  return std::all_of(color.begin(), color.end(), [](float channel) { return std::isfinite(channel); });
}

/// Of all channels of the colours that are finite, and how many colours are not.
struct ColorRange {
  float least = 0.0F, greatest = 0.0F;
  std::size_t not_finite = 0;
};

ColorRange rangeOf(const std::vector<RawColor>& colors) {
  ColorRange range;
  for (const RawColor& color : colors) {
    range.not_finite += isFinite(color) ? 0 : 1;
    if (!isFinite(color)) continue;
    range.least = std::min({range.least, color[0], color[1], color[2]});
    range.greatest = std::max({range.greatest, color[0], color[1], color[2]});
  }
  return range;
}

/// The number that stands for full brightness; 0 if no range fits.
float fullOf(float greatest, ColorType type) {
  for (const float full : {1.0F, 255.0F, 65535.0F})
    if (greatest <= 2.0F * full && (full > 1.0F || type == ColorType::kFloat)) return full;
  return 0.0F;
}

std::string noteOf(const ColorRange& range, float full, ColorType type) {
  if (full == 0.0F)
    return fmt::format("colours left out: they go up to {:g}, and no range of colours does", range.greatest);
  std::string note;
  const auto add = [&](const std::string& text) { note += (note.empty() ? "" : "; ") + text; };
  const float usual = type == ColorType::kFloat ? 1.0F : 255.0F;
  if (full != usual || range.greatest > full || type == ColorType::kShort)
    add(fmt::format("colours go up to {:g}: they are taken to be from 0 to {:g}", range.greatest, full));
  if (range.least < 0.0F) add(fmt::format("colours go down to {:g}: what is below 0 is taken as 0", range.least));
  if (range.not_finite > 0) add(fmt::format("colours left out: those of {} points are not finite", range.not_finite));
  return note;
}

}  // namespace

std::string setColors(const std::vector<RawColor>& colors, ColorType type, std::vector<common::SurfacePoint>& points) {
  const ColorRange range = rangeOf(colors);
  const float full = fullOf(range.greatest, type);
  for (std::size_t i = 0; full > 0.0F && i < colors.size(); ++i)
    if (isFinite(colors[i]))
      std::transform(colors[i].begin(), colors[i].end(), points[i].rgb.begin(), [full](float channel) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(channel / full, 0.0F, 1.0F)));
      });
  return noteOf(range, full, type);
}

}  // namespace swiftlet::interfaces
