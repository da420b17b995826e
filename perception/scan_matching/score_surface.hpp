// The scores around the best pose of the search. Their shape says where between the cells the pose lies and how
// certain it is (Bachrach 2009, section 5.1.3).
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "perception/scan_matching/quadratic_peak.hpp"

namespace swiftlet::perception {

/// Scores over (x, y, rotation), in steps from -kHalf to +kHalf of each.
struct ScoreSurface {
  static constexpr int kHalf = 3;
  static constexpr int kSize = 2 * kHalf + 1;

  double step_m = 0.0;
  double step_rad = 0.0;
  std::array<std::uint32_t, std::size_t{kSize} * kSize * kSize> scores{};  ///< [rotation][y][x]

  std::uint32_t& at(int x, int y, int rotation) { return scores[index(x, y, rotation)]; }
  std::uint32_t at(int x, int y, int rotation) const { return scores[index(x, y, rotation)]; }

  static constexpr std::size_t index(int x, int y, int rotation) {
    constexpr auto size = static_cast<std::size_t>(kSize);
    return (static_cast<std::size_t>(rotation + kHalf) * size + static_cast<std::size_t>(y + kHalf)) * size +
           static_cast<std::size_t>(x + kHalf);
  }
};

/// A quadratic through the surface by least squares.
Quadratic fitQuadratic(const ScoreSurface& surface);

/// What turns curvature into covariance.
struct SurfaceScale {
  double supported = 1.0;  ///< Points with support at the middle.
  double reach_m = 0.0;    ///< Distance at which a point loses its support.
  double covariance_scale = 1.0;
  double unobservable_sigma_m = 0.0;  ///< A direction less certain is not seen.
};

/// How much the logarithm of the likelihood of the middle pose grows with its score, by the same reasoning.
double logPerScore(const ScoreSurface& surface, const SurfaceScale& scale);

/// Each supported point adds -(d / reach)^2 to the score, with d along the normal of its contour; the curvature is
/// therefore the sum of n n', and with the spread of d, read off the height of the peak, the covariance follows as that
/// of least squares. Along what is not seen, the peak is where it is expected.
Peak findPeak(const ScoreSurface& surface, const SurfaceScale& scale, const ExpectedPose& expected);

}  // namespace swiftlet::perception
