// How far the position has become uncertain since a scan last fixed it in every direction.
#pragma once

#include <Eigen/Core>

namespace swiftlet::autonomy {

/// One thread.
class DriftMonitor {
 public:
  /// After each scan, with the filter's covariance of the horizontal position; `fixed` says whether the scan fixed the
  /// position in every direction. Returns the standard deviation in the weakest direction, as it has grown since the
  /// last scan that did: along a corridor without features, and while no scan matches.
  double add(const Eigen::Matrix2d& covariance_m2, bool fixed);

 private:
  Eigen::Matrix2d fixed_covariance_m2_ = Eigen::Matrix2d::Zero();
};

}  // namespace swiftlet::autonomy
