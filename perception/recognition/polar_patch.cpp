#include "perception/recognition/polar_patch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "perception/recognition/picture_pyramid.hpp"

namespace swiftlet::perception {
namespace {

constexpr auto kAngles = static_cast<std::size_t>(kPatchAngles);
/// Standard deviation of a patch, in grey levels, at least: less is noise.
constexpr float kPlainPatch = 4.0F;

struct Direction {
  double cosine, sine;
};
const std::array<Direction, kAngles>& directions() {
  static const auto kDirections = [] {
    std::array<Direction, kAngles> all{};
    for (std::size_t i = 0; i < kAngles; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPatchAngles;
      all[i] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return kDirections;
}

/// Whether a ring lies in the picture: the ellipse that it is there has this box.
bool liesInside(const vision::GrayImage& gray, const ClosedCurve& curve, const Eigen::Matrix2d& to_picture,
                double radius) {
  const double half_u = radius * to_picture.row(0).norm(), half_v = radius * to_picture.row(1).norm();
  return isInside(gray, curve.middle_px.x() - half_u, curve.middle_px.y() - half_v, 0.0) &&
         isInside(gray, curve.middle_px.x() + half_u, curve.middle_px.y() + half_v, 0.0);
}

}  // namespace

std::optional<PolarPatch> polarPatch(const vision::GrayImage& gray, const ClosedCurve& curve, int most_rings) {
  const Eigen::Matrix2d to_picture = curve.whitening.inverse();
  PolarPatch patch;
  float sum = 0.0F, squares = 0.0F;
  for (int ring = 0; ring < std::min(most_rings, kPatchRings); ++ring) {
    const auto r = static_cast<std::size_t>(ring);
    const double radius = kPatchRadii[r];
    if (!liesInside(gray, curve, to_picture, radius)) break;
    float* const values = patch.values.data() + r * 2 * kAngles;
    float ring_sum = 0.0F, ring_squares = 0.0F;
    for (std::size_t i = 0; i < kAngles; ++i) {
      const double x = radius * directions()[i].cosine, y = radius * directions()[i].sine;
      const float value =
          interpolated(gray, static_cast<float>(curve.middle_px.x() + to_picture(0, 0) * x + to_picture(0, 1) * y),
                       static_cast<float>(curve.middle_px.y() + to_picture(1, 0) * x + to_picture(1, 1) * y));
      values[i] = values[i + kAngles] = value;
      ring_sum += value;
      ring_squares += value * value;
    }
    constexpr float kCount = kPatchAngles;
    patch.ring_mean[r] = ring_sum / kCount;
    patch.ring_sigma[r] = std::sqrt(std::max(0.0F, ring_squares / kCount - patch.ring_mean[r] * patch.ring_mean[r]));
    sum += ring_sum;
    squares += ring_squares;
    const float count = kCount * static_cast<float>(ring + 1);
    patch.disc_mean[r] = sum / count;
    patch.disc_sigma[r] = std::sqrt(std::max(0.0F, squares / count - patch.disc_mean[r] * patch.disc_mean[r]));
    patch.rings = ring + 1;
  }
  if (patch.rings < kLeastRings || patch.disc_sigma[static_cast<std::size_t>(patch.rings - 1)] < kPlainPatch)
    return std::nullopt;
  return patch;
}

PatchMatch bestTurn(const PolarPatch& known, const PolarPatch& seen, float least) {
  const int rings = std::min(known.rings, seen.rings);
  if (rings < kLeastRings) return {};
  const auto last = static_cast<std::size_t>(rings - 1);
  const float scale = known.disc_sigma[last] * seen.disc_sigma[last] * static_cast<float>(rings);
  if (!(scale > 0.0F)) return {};
  // Of one ring no turn correlates more than means and standard deviations do (Cauchy and Schwarz).
  float bound = 0.0F;
  for (std::size_t r = 0; r <= last; ++r)
    bound += (known.ring_mean[r] - known.disc_mean[last]) * (seen.ring_mean[r] - seen.disc_mean[last]) +
             known.ring_sigma[r] * seen.ring_sigma[r];
  if (bound < least * scale) return {};

  std::array<float, kAngles> sums{};
  for (std::size_t r = 0; r <= last; ++r) {
    const float* const fixed = known.values.data() + r * 2 * kAngles;
    const float* const turned = seen.values.data() + r * 2 * kAngles;
    for (std::size_t i = 0; i < kAngles; ++i) {
      const float value = fixed[i] - known.disc_mean[last];
      for (std::size_t shift = 0; shift < kAngles; ++shift) sums[shift] += value * turned[i + shift];
    }
  }
  // The mean of `known` is 0, so that of `seen` does not matter.
  const auto best = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  const float before = sums[(best + kAngles - 1) % kAngles], after = sums[(best + 1) % kAngles];
  const float curvature = before - 2.0F * sums[best] + after;
  const float fraction = curvature < 0.0F ? 0.5F * (before - after) / curvature : 0.0F;
  return {2.0 * std::numbers::pi * (static_cast<double>(best) + static_cast<double>(fraction)) / kPatchAngles,
          sums[best] / (scale * static_cast<float>(kPatchAngles))};
}

}  // namespace swiftlet::perception
