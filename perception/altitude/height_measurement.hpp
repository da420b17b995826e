// What goes into the multilevel filter and what comes out of it.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/time.hpp"

namespace swiftlet::perception {

/// Where one deflected beam ended.
struct GroundPoint {
  Eigen::Vector2d position_map_m = Eigen::Vector2d::Zero();
  /// Vertical distance from the body origin down to the point, attitude and mirror mount already removed.
  /// NaN, infinite or not positive: the beam has no return and is left out.
  double distance_below_m = 0.0;
};

struct HeightState {
  common::Time stamp;
  double height_m = 0.0;  ///< Over the take-off floor.
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of (height_m, velocity_m_s).
};

/// One measurement of the height over the take-off floor, made of all beams whose level is known.
struct VirtualHeight {
  common::Time stamp;
  double height_m = 0.0;
  double variance_m2 = 0.0;        ///< Independent from scan to scan: range noise over the beams used.
  double level_variance_m2 = 0.0;  ///< Of the levels themselves: the same error as long as they stay below.
  int beams = 0;
  /// Set where a surface was taken for flat though it seemed to rise or fall: then the vertical speed was wrong.
  std::optional<double> velocity_m_s;
  double velocity_variance_m2_s2 = 0.0;
};

}  // namespace swiftlet::perception
