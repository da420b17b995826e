#include "perception/targets/color_classes.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::perception {
namespace {

constexpr int kSteps = 64;  ///< Of each channel in the table, which has a byte for each colour: 256 kB.

}  // namespace

std::array<double, 3> hueSaturationValue(double red, double green, double blue) {
  const double greatest = std::max({red, green, blue}), least = std::min({red, green, blue});
  const double range = greatest - least;
  if (!(range > 0.0)) return {0.0, 0.0, greatest};
  double sixths = 0.0;
  if (greatest == red)
    sixths = (green - blue) / range;
  else if (greatest == green)
    sixths = 2.0 + (blue - red) / range;
  else
    sixths = 4.0 + (red - green) / range;
  return {60.0 * (sixths < 0.0 ? sixths + 6.0 : sixths), range / greatest, greatest};
}

double hueDifference_deg(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360.0)); }

ColorClasses::ColorClasses(std::span<const TargetClassConfig> classes) {
  table_.reserve(static_cast<std::size_t>(kSteps) * kSteps * kSteps);
  const auto middle = [](int step) { return (step + 0.5) / kSteps; };
  for (int red = 0; red < kSteps; ++red)
    for (int green = 0; green < kSteps; ++green)
      for (int blue = 0; blue < kSteps; ++blue) {
        const auto [hue_deg, saturation, value] = hueSaturationValue(middle(red), middle(green), middle(blue));
        std::uint8_t best = kNone;
        double nearest_deg = 360.0;
        for (std::size_t i = 0; i < std::min<std::size_t>(classes.size(), kNone); ++i) {
          const double off_deg = hueDifference_deg(hue_deg, classes[i].hue_deg);
          if (off_deg > classes[i].hue_tolerance_deg || off_deg >= nearest_deg) continue;
          if (saturation < classes[i].saturation_min || value < classes[i].value_min) continue;
          best = static_cast<std::uint8_t>(i);
          nearest_deg = off_deg;
        }
        table_.push_back(best);
      }
}

}  // namespace swiftlet::perception
