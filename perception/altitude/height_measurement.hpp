// The input and output types of the multilevel filter.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::perception {

/// The end point of one deflected beam.
struct GroundPoint {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  /// Vertical distance from the body origin down to the point, corrected for attitude and mirror mount. NaN, infinite
  /// or not positive: the beam has no return and is left out.
  double distance_below_m = 0.0;
};

struct HeightState {
  common::Time stamp;
  double height_m = 0.0;  ///< Above the take-off floor.
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of (height_m, velocity_m_s).
};

struct VerticalSpeed {
  double up_m_s = 0.0;
  double variance_m2_s2 = 0.0;
  double change_m_s = 0.0;  ///< Change from the previously estimated speed.
};

/// One measurement of the height above the take-off floor, made from all beams whose level is known.
struct VirtualHeight {
  common::Time stamp;
  double height_m = 0.0;
  /// Variance of the part that is independent from scan to scan: range noise of the beams used.
  double variance_m2 = 0.0;
  /// Variance of the levels' heights. This error stays the same as long as the same levels are below.
  double level_variance_m2 = 0.0;
  int beams = 0;
  /// Set if a surface turned out to be flat although it seemed to rise or fall, so that the vertical speed was wrong.
  std::optional<VerticalSpeed> speed;
};

}  // namespace swiftlet::perception
