// The scores around the best pose of the search, and what follows from their shape: the pose between the cells, its
// covariance, and the direction that the scene does not hold (Bachrach 2009, section 5.1.3).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <Eigen/Core>

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

/// A quadratic c + g'u + u'Hu/2 through the surface by least squares, u in steps.
struct Quadratic {
  double constant = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
Quadratic fitQuadratic(const ScoreSurface& surface);

/// What turns curvature into covariance.
struct SurfaceScale {
  double supported = 1.0;  ///< Points with support at the middle.
  double reach_m = 0.0;    ///< Distance at which a point loses its support.
  double covariance_scale = 1.0;
  double unobservable_sigma_m = 0.0;  ///< A direction less certain is not seen.
};

/// The peak relative to the middle of the surface; axes of the reference frame.
struct SurfacePeak {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< (x_m, y_m, yaw_rad)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::optional<Eigen::Vector2d> unobservable_direction;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();          ///< Of the fitted quadratic, per step,
  Eigen::Matrix3d peak_of_gradient = Eigen::Matrix3d::Zero();  ///< and how the peak (m, m, rad) follows it.
};

/// Each supported point adds -(d / reach)^2 to the score, with d along the normal of its contour; the curvature is
/// therefore the sum of n n', and with the spread of d, read off the height of the peak, the covariance follows as that
/// of least squares. Along what is not seen, the peak is where the guess is.
SurfacePeak findPeak(const ScoreSurface& surface, const SurfaceScale& scale, const Eigen::Vector3d& guess_offset);

/// Marks a direction as not seen: the peak keeps the guess along it, and the covariance says so.
void holdAlong(const Eigen::Vector2d& direction, const Eigen::Vector3d& guess_offset, SurfacePeak& peak);

}  // namespace swiftlet::perception
