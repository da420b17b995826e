// The geometry of a path before it is flown: simplified, its corners rounded, the greatest speed at each point.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace swiftlet::control {

using Points = std::vector<Eigen::Vector3d>;

/// Leaves out repeated points and those within `tolerance_m` of the line between the points that stay
/// (Douglas-Peucker).
Points simplified(const Points& points, double tolerance_m);

/// Replaces each corner by an arc, at most `deviation_m` inside of it and using at most half of either leg. Sharp
/// reversals stay corners. With `free_first_corner` the corner at index 1 may deviate as far as its legs allow.
Points rounded(const Points& points, double deviation_m, bool free_first_corner = false);

/// Path length up to each point.
std::vector<double> distancesAlong(const Points& points);

/// The point of the path at `distance_m`, clamped to the ends of the path.
Eigen::Vector3d pointOn(const Points& points, const std::vector<double>& distances_m, double distance_m);

struct Nearest {
  double distance_m = 0.0;  ///< Distance along the path.
  double off_m = 0.0;       ///< Distance from the path.
};
/// The point of the first `within_m` of the path that is nearest to `point`.
Nearest nearestOn(const Points& points, const std::vector<double>& distances_m, const Eigen::Vector3d& point,
                  double within_m);

struct SpeedLimits {
  double speed_m_s;
  double acceleration_m_s2;  ///< Limit along the path and across it.
  double climb_m_s;          ///< Limit of the vertical part of the speed.
  double kink_m_s;           ///< Greatest sudden change of the velocity vector.
};
/// The greatest speed at each point such that curves stay within the acceleration and the speed at every later point
/// can still be met. It is zero at the last point.
std::vector<double> speedsAlong(const Points& points, const SpeedLimits& limits);

}  // namespace swiftlet::control
