// The shape a scan saw: its end points joined to contours, and points spread evenly along them.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::perception {

/// A piece of a contour, in whatever frame its points were given; begin == end for a lone point.
struct ContourSegment {
  Eigen::Vector2d begin_m;
  Eigen::Vector2d end_m;
};

/// For each point whether it is joined to the next: points that are likely of one surface, nearer than `max_gap_m` and
/// not much farther apart than those before and after (an occlusion edge leaps, a wall seen at a grazing angle only
/// stretches). Finite points in beam order (Bachrach 2009, section 5.1.1).
std::vector<bool> joinsOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m);

/// The points joined to contours. Points beyond `max_range_m` and points that are not finite are left out.
std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m);
/// The same seen from a pose, in the reference frame.
std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m,
                                      const common::Pose2& T_reference_body);

/// Indices of at most `count` of the points, evenly spread along the contour, so that a near wall, dense with beams,
/// does not outweigh a far one. Finite points within `max_range_m` only; ascending.
std::vector<int> spreadIndices(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m);
std::vector<Eigen::Vector2f> spreadPoints(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m);

/// How well the shape of a scan holds a translation: the mean of n n' over the normals n of its contour, in the frame
/// of the points, which must be in order. Each normal is taken over some decimetres, so that noise does not pose as
/// structure. The eigenvalues are in [0, 1] and sum up to 1; zero when there is no contour. Where `counted` is given,
/// one for a point, only normals between two that count are taken.
Eigen::Matrix2d normalSpread(std::span<const float> x_m, std::span<const float> y_m,
                             const std::vector<bool>& counted = {});

}  // namespace swiftlet::perception
