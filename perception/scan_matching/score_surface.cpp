#include "perception/scan_matching/score_surface.hpp"

#include <algorithm>

#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {
namespace {

/// Lower limit on the residual of the end points; the bytes of the field do not resolve a smaller one.
constexpr double kMinResidual_m = 0.004;

}  // namespace

Quadratic fitQuadratic(const ScoreSurface& surface) {
  // On a symmetric grid 1, u_i, u_i u_j and u_i^2 - mean(u^2) are orthogonal, so that each coefficient is one sum.
  constexpr int kHalf = ScoreSurface::kHalf;
  constexpr double kCount = ScoreSurface::kSize * ScoreSurface::kSize * ScoreSurface::kSize;
  double m2 = 0.0, m4 = 0.0;  // Mean of u^2 and u^4 along one axis.
  for (int u = -kHalf; u <= kHalf; ++u) {
    m2 += static_cast<double>(u) * u / ScoreSurface::kSize;
    m4 += static_cast<double>(u) * u * u * u / ScoreSurface::kSize;
  }

  double sum = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int rotation = -kHalf; rotation <= kHalf; ++rotation) {
    for (int y = -kHalf; y <= kHalf; ++y) {
      double of_row = 0.0, of_row_x = 0.0, of_row_xx = 0.0;
      for (int x = -kHalf; x <= kHalf; ++x) {
        const double score = surface.at(x, y, rotation);
        of_row += score;
        of_row_x += score * x;
        of_row_xx += score * x * x;
      }
      const Eigen::Vector2d others(y, rotation);
      sum += of_row;
      first(0) += of_row_x;
      first.tail<2>() += of_row * others;
      second(0, 0) += of_row_xx;
      second.block<2, 1>(1, 0) += of_row_x * others;
      second.bottomRightCorner<2, 2>() += of_row * others * others.transpose();
    }
  }
  second.block<1, 2>(0, 1) = second.block<2, 1>(1, 0).transpose();

  Quadratic q;
  q.gradient = first / (kCount * m2);
  q.hessian = second / (kCount * m2 * m2);
  q.constant = sum / kCount;
  for (int i = 0; i < 3; ++i) {
    q.hessian(i, i) = 2.0 * (second(i, i) - m2 * sum) / (kCount * (m4 - m2 * m2));
    q.constant -= 0.5 * q.hessian(i, i) * m2;
  }
  return q;
}

double logPerScore(const ScoreSurface& surface, const SurfaceScale& scale) {
  const double reach2 = scale.reach_m * scale.reach_m;
  const double height = surface.at(0, 0, 0) / (LikelihoodField::kTopValue * std::max(scale.supported, 1.0));
  const double residual2 = std::max(reach2 * (1.0 - height), kMinResidual_m * kMinResidual_m);
  return reach2 / (2.0 * LikelihoodField::kTopValue * residual2 * scale.covariance_scale);
}

Peak findPeak(const ScoreSurface& surface, const SurfaceScale& scale, const ExpectedPose& expected) {
  PeakScale peak_scale;
  peak_scale.step = {surface.step_m, surface.step_m, surface.step_rad};
  peak_scale.information_per_curvature = logPerScore(surface, scale) / (surface.step_m * surface.step_m);
  peak_scale.unobservable_sigma_m = scale.unobservable_sigma_m;
  peak_scale.reach_steps = ScoreSurface::kHalf;
  return findPeak(fitQuadratic(surface), peak_scale, expected);
}

}  // namespace swiftlet::perception
