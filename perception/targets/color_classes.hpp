// Which class of targets a colour belongs to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "perception/targets/target_config.hpp"

namespace swiftlet::perception {

/// A table over all colours in steps of 1/64, so that a pixel costs one look-up and every processor gives the same
/// answer. Immutable; safe from any thread.
class ColorClasses {
 public:
  static constexpr std::uint8_t kNone = 255;

  /// At most 255 classes. A colour that several of them allow belongs to the one with the nearest hue.
  explicit ColorClasses(std::span<const TargetClassConfig> classes);

  /// The index of its class, or kNone.
  std::uint8_t of(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
    return table_[static_cast<std::size_t>(((red >> 2) << 12) | ((green >> 2) << 6) | (blue >> 2))];
  }

 private:
  std::vector<std::uint8_t> table_;
};

/// Hue in degrees in [0, 360), saturation and value in [0, 1] of a colour with channels in [0, 1]. Grey has hue 0.
std::array<double, 3> hueSaturationValue(double red, double green, double blue);

/// Difference between two hues, in [0, 180].
double hueDifference_deg(double a_deg, double b_deg);

}  // namespace swiftlet::perception
