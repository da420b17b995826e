// The points of a scan that a match is made with, coordinate by coordinate.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// Points in the level frame of the scan, in the arrays that the transformation wants.
struct SplitPoints {
  std::vector<float> x_m, y_m;
  std::vector<float> heights_m;  ///< Over the body; empty when not known.

  explicit SplitPoints(const std::vector<Eigen::Vector2f>& points_m);
};

/// At most `count` points of the scan, spread evenly along its contour, with their heights.
SplitPoints spreadWithHeights(const ProjectedScan& scan, int count, double max_range_m);

/// Which points lie on what was drawn (`seen`) and not beside what does not, as far as the field reaches. There a
/// surface goes on beyond what was drawn of it; slid along itself, the scan would cover more of it. What comes out of a
/// shadow while the vehicle goes by would pull it on, a little with each match.
std::vector<bool> awayFromUnseen(const SplitPoints& points, const std::vector<bool>& seen, double reach_m);

/// The marked points; all where less than half is marked.
SplitPoints mostOf(const SplitPoints& points, const std::vector<bool>& marked);

}  // namespace swiftlet::perception
