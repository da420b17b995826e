#include "perception/altitude/ground_plane.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "common/square.hpp"
#include "perception/altitude/ground_limits.hpp"

namespace swiftlet::perception {
namespace {

constexpr int kParameters = 3;  ///< Of a plane.

}  // namespace

void GroundPlane::add(const Eigen::Vector3d& point_m) {
  ++points_;
  sum_m_ += point_m;
  products_m2_ += point_m * point_m.transpose();
}

std::optional<Eigen::Vector2d> GroundPlane::gradient() const {
  if (points_ <= kParameters) return std::nullopt;
  const Eigen::Matrix3d spread_m2 = products_m2_ / points_ - mean_m() * mean_m().transpose();
  const Eigen::Matrix2d across_m2 = spread_m2.topLeftCorner<2, 2>();
  const double half_trace_m2 = 0.5 * across_m2.trace();
  const double least_m2 =
      half_trace_m2 - std::sqrt(std::max(0.0, common::square(half_trace_m2) - across_m2.determinant()));
  // A line of points is broad only by their noise, however many they are.
  if (least_m2 < common::square(2.0 * kPlane_m)) return std::nullopt;
  const Eigen::Vector2d rising_m2(spread_m2(0, 2), spread_m2(1, 2));
  const Eigen::Vector2d gradient = across_m2.ldlt().solve(rising_m2);
  const double off_m2 = spread_m2(2, 2) - gradient.dot(rising_m2);
  const double variance =
      std::max(off_m2, common::square(kFlatness_m)) / ((points_ - kParameters) * least_m2);  // Where it is greatest.
  if (off_m2 > common::square(kPlane_m) || variance > common::square(kGradientSigma)) return std::nullopt;
  if (gradient.norm() > kSteepestGradient) return std::nullopt;
  return gradient;
}

}  // namespace swiftlet::perception
