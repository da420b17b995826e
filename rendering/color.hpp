// Colours of pictures: 8-bit sRGB with opacity. Mixing is linear in the stored values, rounded, so that it is the same
// on every machine.
#pragma once

#include <cstdint>

namespace swiftlet::rendering {

struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;  ///< 0: invisible, 255: opaque.

  constexpr Color withAlpha(std::uint8_t a) const { return {red, green, blue, a}; }
  constexpr bool operator==(const Color&) const = default;
};

/// From 0xRRGGBB, opaque.
constexpr Color rgb(std::uint32_t hex) {
  return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8), static_cast<std::uint8_t>(hex)};
}

/// `a` at weight 0, `b` at weight 255; alpha is that of `a`.
constexpr Color mix(Color a, Color b, int weight) {
  const auto channel = [weight](int from, int to) {
    return static_cast<std::uint8_t>((from * (255 - weight) + to * weight + 127) / 255);
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue), a.alpha};
}

}  // namespace swiftlet::rendering
