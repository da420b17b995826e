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
  std::array<std::uint32_t, kSize * kSize * kSize> scores{};  ///< [rotation][y][x]

  std::uint32_t& at(int x, int y, int rotation) {
    return scores[static_cast<std::size_t>(((rotation + kHalf) * kSize + y + kHalf) * kSize + x + kHalf)];
  }
  std::uint32_t at(int x, int y, int rotation) const {
    return scores[static_cast<std::size_t>(((rotation + kHalf) * kSize + y + kHalf) * kSize + x + kHalf)];
  }
};

/// A quadratic c + g'u + u'Hu/2 through the surface by least squares, u in steps.
struct Quadratic {
  double constant = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};
Quadratic fitQuadratic(const ScoreSurface& surface);

}  // namespace swiftlet::perception
