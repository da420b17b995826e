// The contours of a scan: its end points joined to line segments, and points spread evenly along them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/unobservable_motion.hpp"

namespace swiftlet::perception {

/// A segment of a contour, in the frame of the points it was made from; begin == end for a lone point.
struct ContourSegment {
  Eigen::Vector2d begin_m;
  Eigen::Vector2d end_m;
};

/// For each point, whether it is joined to the next. Joined points probably lie on one surface: they are nearer than
/// `max_gap_m` and not much farther apart than those before and after. An occlusion edge makes one large gap; at a
/// grazing angle the gaps grow gradually. Takes finite points in beam order (Bachrach 2009, section 5.1.1).
std::vector<bool> joinsOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m);

/// The points joined to contours. Points beyond `max_range_m` and points that are not finite are left out.
std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m);
/// The contours of a scan taken at `T_reference_body`, in the reference frame.
std::vector<ContourSegment> contourOf(std::span<const Eigen::Vector2f> points_m, double max_gap_m, double max_range_m,
                                      const common::Pose2& T_reference_body);

/// Indices of at most `count` points, spread evenly along the contour, so that a near wall with many beams does not
/// outweigh a far one. Points beyond `max_range_m` and points that are not finite are left out. Ascending.
std::vector<int> spreadIndices(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m);
std::vector<Eigen::Vector2f> spreadPoints(std::span<const Eigen::Vector2f> points_m, int count, double max_range_m);

/// Root mean square of the distances of the points from their origin, and at least 0.1 m.
double leverOf_m(std::span<const float> x_m, std::span<const float> y_m);

/// How well the shape of a scan constrains a motion: the mean of m m' over the normals n of its contour at the points
/// p, with m = (n, (p x n) / lever), in the frame of the points, which must be in beam order. A corridor does not show
/// one translation; a round room does not show the turn about its middle. Each normal is taken over some decimetres, so
/// that noise is not mistaken for structure. The eigenvalues of the translations alone, the upper left, are in [0, 1]
/// and sum up to 1; the matrix is zero when there is no contour. If `counted` is given, one entry per point, only
/// normals between two counted points are used.
Eigen::Matrix3d motionSpread(std::span<const float> x_m, std::span<const float> y_m, double lever_m,
                             const std::vector<bool>& counted = {});
/// The motion that such a spread does not show, in the frame of the points: that of which a smaller share of the
/// contour than `least_share` faces. nullopt if there is none.
std::optional<common::UnobservableMotion> slidingMotion(const Eigen::Matrix3d& spread, double lever_m,
                                                        double least_share);

}  // namespace swiftlet::perception
