// The input of the multilevel filter.
#pragma once

#include <Eigen/Core>

#include "perception/fusion/fusion_types.hpp"

namespace swiftlet::perception {

/// The end point of one deflected beam.
struct GroundPoint {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  /// Vertical distance from the body origin down to the point, corrected for attitude and mirror mount. NaN, infinite
  /// or not positive: the beam has no return and is left out.
  double distance_below_m = 0.0;
};

}  // namespace swiftlet::perception
