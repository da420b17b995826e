// The points of a scan used for a match, as one array per coordinate.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "perception/projection/scan_projection.hpp"

namespace swiftlet::perception {

/// Points in the level frame of the scan, in the layout that transformToCells takes.
struct SplitPoints {
  std::vector<float> x_m, y_m;
  std::vector<float> heights_m;  ///< Above the body origin; empty when not known.

  explicit SplitPoints(const std::vector<Eigen::Vector2f>& points_m);
};

/// At most `count` points of the scan, spread evenly along its contour, with their heights.
SplitPoints spreadWithHeights(const ProjectedScan& scan, int count, double max_range_m);

/// Marks the points that have support in the reference (`seen`) and have no run of unsupported neighbours within
/// `reach_m` along the contour. Next to such a run a surface continues beyond the drawn part, and sliding the scan
/// along the surface would give it more support. Surfaces that come into view while the vehicle passes would otherwise
/// bias each match a little in the direction of motion.
std::vector<bool> awayFromUnseen(const SplitPoints& points, const std::vector<bool>& seen, double reach_m);

SplitPoints marked(const SplitPoints& points, const std::vector<bool>& marks);
/// The marked points, or all points if fewer than half are marked.
SplitPoints mostOf(const SplitPoints& points, const std::vector<bool>& marks);

}  // namespace swiftlet::perception
