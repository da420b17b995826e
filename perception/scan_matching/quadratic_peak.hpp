// The peak of a quadratic in the pose. The quadratic is fitted to the scores about the best pose of a search, or made
// from the normal equations of a least-squares match. Where the scene does not constrain the pose, the peak keeps the
// guess and the covariance is large (Bachrach 2009, section 5.1.3).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// c + g'u + u'Hu/2, where u is the offset of the pose (x, y, rotation) in steps. H is negative definite at a peak.
struct Quadratic {
  double constant = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// Parameters that turn curvature into covariance.
struct PeakScale {
  /// (x_m, y_m, yaw_rad). One step along each axis moves the points by about the same distance.
  Eigen::Vector3d step = Eigen::Vector3d::Ones();
  double information_per_curvature = 1.0;  ///< In 1 / m^2, for a displacement of the points.
  double unobservable_sigma_m = 0.0;       ///< A less certain direction is unobservable.
  double reach_steps = 0.0;                ///< The quadratic is valid only this far from u = 0.
};

/// The peak relative to u = 0, along the axes of the reference frame.
struct Peak {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< (x_m, y_m, yaw_rad)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::optional<common::UnobservableMotion> unobservable_motion;  ///< Along the axes of the reference.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();             ///< Gradient of the quadratic, per step.
  Eigen::Matrix3d peak_of_gradient = Eigen::Matrix3d::Zero();  ///< Derivative of the peak (m, m, rad) by that gradient.
};

/// The expected pose relative to u = 0, along the axes of the reference frame.
struct ExpectedPose {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< (x_m, y_m, yaw_rad)
  Eigen::Vector3d spread = Eigen::Vector3d::Ones();  ///< Uncertainty of each, > 0. Only the ratios matter.
};

/// The guess of a search, relative to `pose`.
ExpectedPose expectedFrom(const common::Pose2& pose, const common::Pose2& guess, const SearchWindow& window);

/// Along unobservable directions the peak is at the most likely offset given `expected`; an uncertain heading therefore
/// does not shift the position.
Peak findPeak(const Quadratic& quadratic, const PeakScale& scale, const ExpectedPose& expected);

/// Marks a motion as unobservable: along it the peak takes the expected offset, and the covariance becomes large.
void holdAlong(const common::UnobservableMotion& motion, const ExpectedPose& expected, Peak& peak);
/// The least certain motion of a covariance, if it displaces the points, whose lever this is, by more than `sigma_m`.
std::optional<common::UnobservableMotion> leastCertain(const Eigen::Matrix3d& covariance, double lever_m,
                                                       double sigma_m);

}  // namespace swiftlet::perception
