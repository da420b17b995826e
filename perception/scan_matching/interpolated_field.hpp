// Bilinear interpolation of a likelihood field.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {

struct FieldSample {
  double value = 0.0;                                   ///< In (0, 1]; 1 on a contour.
  Eigen::Vector2d slope_1_m = Eigen::Vector2d::Zero();  ///< Exact derivative of `value`, per metre.
};

/// Interpolates between the centres of the four cells around a point of the reference frame. Returns nullopt where the
/// point has no support, outside the field, and for a point that is not finite. Inline because it is the inner loop.
inline std::optional<FieldSample> sampleField(const LikelihoodField& field, const Eigen::Vector2d& point_m) {
  constexpr double kPerByte = 1.0 / LikelihoodField::kTopValue;
  const double per_metre = 1.0 / field.resolution_m();
  const double u = point_m.x() * per_metre - field.beginX() - 0.5, v = point_m.y() * per_metre - field.beginY() - 0.5;
  // Also false for NaN. Contours are never drawn at the border of the array.
  if (!(u >= 0.0 && v >= 0.0 && u < field.width() - 1 && v < field.height() - 1)) return std::nullopt;
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const LikelihoodField::Level level = field.level(0);
  const std::uint8_t* low = level.cells + static_cast<std::ptrdiff_t>(y) * level.stride + x;
  const std::uint8_t* high = low + level.stride;
  if ((low[0] | low[1] | high[0] | high[1]) == 0) return std::nullopt;

  const double in_x = u - x, in_y = v - y;
  const double along_low = low[1] - low[0], along_high = high[1] - high[0];
  const double at_low = low[0] + in_x * along_low, at_high = high[0] + in_x * along_high;
  FieldSample sample;
  sample.value = kPerByte * (at_low + in_y * (at_high - at_low));
  sample.slope_1_m =
      kPerByte * per_metre * Eigen::Vector2d(along_low + in_y * (along_high - along_low), at_high - at_low);
  return sample;
}

}  // namespace swiftlet::perception
