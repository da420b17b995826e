// The scores around the best pose of the search. Their shape gives the pose between the cells and its uncertainty
// (Bachrach 2009, section 5.1.3).
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "perception/scan_matching/quadratic_peak.hpp"

namespace swiftlet::perception {

/// Scores over (x, y, rotation), from -kHalf to +kHalf steps along each axis.
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

/// Fits a quadratic to the surface by least squares.
Quadratic fitQuadratic(const ScoreSurface& surface);

/// Parameters that turn curvature into covariance.
struct SurfaceScale {
  double supported = 1.0;  ///< Points with support at the middle pose.
  double reach_m = 0.0;    ///< Distance beyond which a point has no support.
  double covariance_scale = 1.0;
  double unobservable_sigma_m = 0.0;  ///< A less certain direction is unobservable.
};

/// Derivative of the log-likelihood by the score at the middle pose. The spread of the points' distances comes from the
/// height of the peak.
double logPerScore(const ScoreSurface& surface, const SurfaceScale& scale);

/// The peak of the surface with its covariance. Each supported point adds -(d / reach)^2 to the score, with d along the
/// normal of its contour. The curvature is therefore proportional to the sum of n n', and with the spread of d, read
/// off the height of the peak, the covariance is that of least squares. Along unobservable directions the peak keeps
/// the expected pose.
Peak findPeak(const ScoreSurface& surface, const SurfaceScale& scale, const ExpectedPose& expected);

}  // namespace swiftlet::perception
