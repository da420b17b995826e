// The relative pose by pairs of points that are both uncertain.
//
// Source: H. Hirschmueller, P. Innocent, J. Garibaldi, "Fast, unconstrained camera motion estimation from stereo
// without tracking and robust statistics", ICARCV 2002, which Tomic 2012 uses: the ellipsoid error of corresponding
// points, by iteration. The covariance follows from the curvature at the minimum.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "vision/features.hpp"

namespace swiftlet::perception {

/// The same corner, seen by the camera at two times.
struct PointPair {
  vision::GaussianPoint from, to;
};

struct GaussianRegistration {
  common::Pose3 T_from_to;
  /// Of the error (position, rotation vector) with the axes of the camera at `to`: T_from_to * exp(error).
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  int pairs = 0;              ///< Those that agree.
  double chi2_per_dof = 0.0;  ///< Of these; 1 where the points are as uncertain as they say.
};

/// Starts from T_from_to. Pairs whose Mahalanobis distance is improbable count for nothing. None if fewer than
/// `least_pairs` remain, or these leave a direction open.
std::optional<GaussianRegistration> refined(const std::vector<PointPair>& pairs, const common::Pose3& T_from_to,
                                            int least_pairs);

}  // namespace swiftlet::perception
