// The grey values around a closed curve on a polar grid in its whitened frame. Two patches of the same thing differ by
// a turn, which is a shift of the grid.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "perception/recognition/closed_curves.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {

inline constexpr int kPatchAngles = 32;
/// Radii of the rings in units of the standard deviation of the area: the outline of a disc has 2, and the largest
/// circle in a square sqrt(3). The outer ones show what surrounds a plain shape.
inline constexpr std::array<double, 6> kPatchRadii = {0.5, 1.0, 1.6, 2.1, 2.7, 3.4};
inline constexpr int kPatchRings = static_cast<int>(kPatchRadii.size());
/// Fewer rings say too little.
inline constexpr int kLeastRings = 3;

struct PolarPatch {
  int rings = 0;  ///< The innermost of kPatchRadii that lie inside of the picture.
  /// Ring by ring, twice around. Of each ring only the first kPatchAngles count; the copy makes shifts contiguous.
  std::array<float, static_cast<std::size_t>(kPatchRings * 2 * kPatchAngles)> values{};
  /// Mean and standard deviation of each ring, and of the innermost n + 1 rings.
  std::array<float, kPatchRings> ring_mean{}, ring_sigma{}, disc_mean{}, disc_sigma{};
};

/// Reads at most `most_rings` rings. None if fewer than kLeastRings lie inside or they are plain.
std::optional<PolarPatch> polarPatch(const vision::GrayImage& gray, const ClosedCurve& curve, int most_rings);

/// The turn of `seen` against `known` by which they correlate best, and the normalized cross-correlation there.
struct PatchMatch {
  double turn_rad = 0.0;  ///< seen(angle + turn) = known(angle).
  float correlation = -1.0F;
};
/// Compares the rings that both have. Correlation -1 if it is certainly below `least`.
PatchMatch bestTurn(const PolarPatch& known, const PolarPatch& seen, float least);

}  // namespace swiftlet::perception
