#include "perception/scan_matching/score_surface.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "perception/scan_matching/likelihood_field.hpp"

namespace swiftlet::perception {
namespace {

/// Least spread of the end points that is believed; the field's bytes resolve no finer.
constexpr double kMinResidual_m = 0.004;
/// No pose is better than this, whatever the number of points.
constexpr double kFloorSigma_m = 0.0005;
constexpr double kFloorSigma_rad = 0.0001;
/// The uncertainty given along what is not seen.
constexpr double kUnseenSigma_m = 1.0;

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
      for (int x = -kHalf; x <= kHalf; ++x) {
        const double score = surface.at(x, y, rotation);
        const Eigen::Vector3d u(x, y, rotation);
        sum += score;
        first += score * u;
        second += score * u * u.transpose();
      }
    }
  }

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

SurfacePeak findPeak(const ScoreSurface& surface, const SurfaceScale& scale, const Eigen::Vector3d& guess_offset) {
  const Quadratic q = fitQuadratic(surface);
  const Eigen::Vector3d step(surface.step_m, surface.step_m, surface.step_rad);
  const double step2 = surface.step_m * surface.step_m, reach2 = scale.reach_m * scale.reach_m;
  const double height = surface.at(0, 0, 0) / (LikelihoodField::kTopValue * std::max(scale.supported, 1.0));
  const double residual2 = std::max(reach2 * (1.0 - height), kMinResidual_m * kMinResidual_m);
  const double information_per_curvature =
      reach2 / (2.0 * LikelihoodField::kTopValue * residual2 * scale.covariance_scale) / step2;
  const double unseen_information = 1.0 / (kUnseenSigma_m * kUnseenSigma_m);

  // In units of one step, where all three axes move the points by about as much.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(-q.hessian);
  const Eigen::Vector3d guess_steps = guess_offset.cwiseQuotient(step);
  Eigen::Vector3d peak_steps = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_steps = Eigen::Matrix3d::Zero(), peak_of_gradient = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = eigen.eigenvectors().col(i);
    const double curvature = eigen.eigenvalues()(i);
    const double information = std::max(curvature * information_per_curvature, unseen_information);  // 1 / m^2
    covariance_steps += axis * axis.transpose() / (information * step2);
    if (information * scale.unobservable_sigma_m * scale.unobservable_sigma_m > 1.0) {
      const double along = axis.dot(q.gradient) / curvature;
      peak_steps += axis * std::clamp<double>(along, -ScoreSurface::kHalf, ScoreSurface::kHalf);
      peak_of_gradient += axis * axis.transpose() / curvature;
    } else {
      peak_steps += axis * axis.dot(guess_steps);
    }
  }

  SurfacePeak peak;
  peak.gradient = q.gradient;
  peak.peak_of_gradient = step.asDiagonal() * peak_of_gradient;
  peak.offset = peak_steps.cwiseProduct(step);
  peak.covariance = step.asDiagonal() * covariance_steps * step.asDiagonal();
  peak.covariance.diagonal() +=
      Eigen::Vector3d(kFloorSigma_m * kFloorSigma_m, kFloorSigma_m * kFloorSigma_m, kFloorSigma_rad * kFloorSigma_rad);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> translation(peak.covariance.topLeftCorner<2, 2>().eval());
  if (translation.eigenvalues()(1) > scale.unobservable_sigma_m * scale.unobservable_sigma_m)
    peak.unobservable_direction = translation.eigenvectors().col(1);
  return peak;
}

void holdAlong(const Eigen::Vector2d& direction, const Eigen::Vector3d& guess_offset, SurfacePeak& peak) {
  const Eigen::Vector2d axis = direction.normalized();
  peak.offset.head<2>() += axis * axis.dot(guess_offset.head<2>() - peak.offset.head<2>());
  peak.covariance.topLeftCorner<2, 2>() += kUnseenSigma_m * kUnseenSigma_m * axis * axis.transpose();
  peak.unobservable_direction = axis;
}

}  // namespace swiftlet::perception
