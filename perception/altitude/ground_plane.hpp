// The plane through measured points of the ground.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace swiftlet::perception {

/// Sums over points for the least-squares plane z = c + g . (x, y).
class GroundPlane {
 public:
  /// Relative to a place nearby, so that the sums stay small.
  void add(const Eigen::Vector3d& point_m);

  /// The gradient g. None if the points do not determine it to kGradientSigma, as they are few or lie along a line, if
  /// they are not on a plane, or if it is steeper than ground.
  std::optional<Eigen::Vector2d> gradient() const;
  /// Of the points; there must be one.
  Eigen::Vector3d mean_m() const { return sum_m_ / points_; }
  int points() const { return points_; }

 private:
  int points_ = 0;
  Eigen::Vector3d sum_m_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products_m2_ = Eigen::Matrix3d::Zero();
};

}  // namespace swiftlet::perception
