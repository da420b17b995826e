// The end points of a scan with the normals of the contours they lie on, as least-squares matchers need them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

struct OrientedPoint {
  Eigen::Vector2f point_m;
  Eigen::Vector2f normal;  ///< Unit vector, towards the side from which the surface was seen.
  /// The point moved along the normal onto the fitted line. It has the averaged noise of several beams.
  Eigen::Vector2f foot_m;
  float height_m = 0.0F;  ///< Above the body origin; 0 if the scan has no heights.
};

/// At most `count` end points, spread evenly along the contour, or all usable ones when `count` is 0; in beam order and
/// in the level frame of the scan. A normal is that of the line through the neighbours within some decimetres on the
/// same contour, so that noise is not mistaken for structure. Points without such a line (lone points, the corner of
/// two walls) are left out.
std::vector<OrientedPoint> orientedPoints(const ProjectedScan& scan, int count, double max_gap_m, double max_range_m);

}  // namespace swiftlet::perception
