// The end points of a scan with the normals of the contours they lie on: what a least-squares match needs to know about
// the shape it matches.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

struct OrientedPoint {
  Eigen::Vector2f point_m;
  Eigen::Vector2f normal;  ///< Unit vector towards the side the surface was seen from.
  Eigen::Vector2f foot_m;  ///< The point moved along the normal to the line: with the noise of many beams, not of one.
  float height_m = 0.0F;   ///< Over the body; 0 when the scan does not say.
};

/// At most `count` end points, spread evenly along the contour (all that are usable when `count` is 0), in beam order
/// and the level frame of the scan. A normal is that of the line through the neighbours within some decimetres on the
/// same contour, so that noise does not pose as structure; points without such a line (lone ones, the corner of two
/// walls) are left out.
std::vector<OrientedPoint> orientedPoints(const ProjectedScan& scan, int count, double max_gap_m, double max_range_m);

}  // namespace swiftlet::perception
