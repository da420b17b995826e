// The peak of a quadratic in the pose, whatever it was taken from: scores about the best pose of a search, or the
// normal equations of a least-squares match. Where the scene does not hold the pose, the guess stands, and the
// covariance says so (Bachrach 2009, section 5.1.3).
#pragma once

#include <optional>

#include <Eigen/Core>

#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// c + g'u + u'Hu/2 with u the offset of the pose (x, y, rotation) in steps; H is negative where there is a peak.
struct Quadratic {
  double constant = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// What turns curvature into covariance.
struct PeakScale {
  Eigen::Vector3d step = Eigen::Vector3d::Ones();  ///< (x_m, y_m, yaw_rad); each moves the points by about as much.
  double information_per_curvature = 1.0;          ///< 1 / m^2, of a displacement of the points.
  double unobservable_sigma_m = 0.0;               ///< A direction less certain is not seen.
  double reach_steps = 0.0;                        ///< The quadratic holds only so far.
};

/// The peak relative to where u = 0; axes of the reference frame.
struct Peak {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< (x_m, y_m, yaw_rad)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::optional<Eigen::Vector2d> unobservable_direction;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();          ///< Of the quadratic, per step,
  Eigen::Matrix3d peak_of_gradient = Eigen::Matrix3d::Zero();  ///< and how the peak (m, m, rad) follows it.
};

/// Where the pose was expected, relative to where u = 0; axes of the reference frame.
struct ExpectedPose {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< (x_m, y_m, yaw_rad)
  Eigen::Vector3d spread = Eigen::Vector3d::Ones();  ///< How far off it may be in each, > 0; the ratios matter.
};

/// The guess of a search, seen from `pose`.
ExpectedPose expectedFrom(const common::Pose2& pose, const common::Pose2& guess, const SearchWindow& window);

/// Along what is not seen, the peak is where it is expected most: a heading that is hardly known does not move it.
Peak findPeak(const Quadratic& quadratic, const PeakScale& scale, const ExpectedPose& expected);

/// Marks a direction as not seen: the peak keeps what was expected along it, and the covariance says so.
void holdAlong(const Eigen::Vector2d& direction, const ExpectedPose& expected, Peak& peak);

}  // namespace swiftlet::perception
