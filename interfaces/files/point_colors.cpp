#include "interfaces/files/point_colors.hpp"

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

float greatestOf(const std::vector<RawColor>& colors) {
  float greatest = 0.0F;
  for (const RawColor& color : colors)
    if (isFinite(color)) greatest = std::max({greatest, color[0], color[1], color[2]});
  return greatest;
}

/// The number that stands for full brightness; 0 if no range fits.
float fullOf(float greatest, ColorType type) {
  for (const float full : {1.0F, 255.0F, 65535.0F})
    if (greatest <= 2.0F * full && (full > 1.0F || type == ColorType::kFloat)) return full;
  return 0.0F;
}

std::string noteOf(float greatest, float full, ColorType type) {
  if (full == 0.0F) return fmt::format("colours left out: they go up to {:g}, and no range of colours does", greatest);
  const float usual = type == ColorType::kFloat ? 1.0F : 255.0F;
  if (full == usual && greatest <= full && type != ColorType::kShort) return "";
  return fmt::format("colours go up to {:g}: they are taken to be from 0 to {:g}", greatest, full);
}

}  // namespace

std::string setColors(const std::vector<RawColor>& colors, ColorType type, std::vector<common::SurfacePoint>& points) {
  const float greatest = greatestOf(colors), full = fullOf(greatest, type);
  for (std::size_t i = 0; full > 0.0F && i < colors.size(); ++i)
    if (isFinite(colors[i]))
      std::transform(colors[i].begin(), colors[i].end(), points[i].rgb.begin(), [full](float channel) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(channel / full, 0.0F, 1.0F)));
      });
  return noteOf(greatest, full, type);
}

}  // namespace swiftlet::interfaces
