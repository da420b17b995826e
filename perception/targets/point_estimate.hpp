// A point that is measured from several places by a camera whose errors are partly the same in all pictures.
//
// A mount that is turned by half a degree shifts every sighting from one side alike, so that averaging them would make
// the estimate sure of a wrong place. Such errors are not estimated for a single point, but considered: the filter
// keeps their correlation with its error, and so a look from another side counts more than ten from the same.
// Source: S. Schmidt, "Application of state-space methods to navigation problems", Advances in Control Systems 1966.
#pragma once

#include <Eigen/Core>

namespace swiftlet::perception {

/// The errors that all measurements share: the mount's rotation vector (rad, in the camera), and the inverse depth.
inline constexpr int kSharedErrors = 4;

struct PointMeasurement {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of the errors that it does not share.
  /// How the shared errors displace the measured point.
  Eigen::Matrix<double, 3, kSharedErrors> by_shared = Eigen::Matrix<double, 3, kSharedErrors>::Zero();
};

/// One thread. All points are in one frame, which the caller chooses.
class PointEstimate {
 public:
  using SharedCovariance = Eigen::Matrix<double, kSharedErrors, kSharedErrors>;

  /// Begins with its first measurement. `shared` is the covariance of the shared errors.
  PointEstimate(const PointMeasurement& first, const SharedCovariance& shared);

  /// Squared Mahalanobis distance of a measurement.
  double distanceSquared(const PointMeasurement& measurement) const;
  void update(const PointMeasurement& measurement);

  const Eigen::Vector3d& point_m() const { return point_m_; }
  const Eigen::Matrix3d& covariance_m2() const { return covariance_m2_; }

 private:
  Eigen::Matrix3d innovation(const PointMeasurement& measurement) const;

  Eigen::Vector3d point_m_;
  Eigen::Matrix3d covariance_m2_;
  Eigen::Matrix<double, 3, kSharedErrors> with_shared_;  ///< Covariance of the point's error with the shared ones.
  SharedCovariance shared_;
};

}  // namespace swiftlet::perception
