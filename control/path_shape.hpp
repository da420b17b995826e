// The geometry of a path before it is flown: simplified, its corners rounded, the greatest speed at each point.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace swiftlet::control {

using Points = std::vector<Eigen::Vector3d>;

/// Leaves out points that lie within `tolerance_m` of the line between those that stay (Douglas-Peucker), and repeated
/// ones.
Points simplified(const Points& points, double tolerance_m);

/// Each corner replaced by an arc, at most `deviation_m` inside of it and at most half of either leg long. Sharp
/// reversals stay corners. The corner at index 1 may deviate as far as its legs allow if `free_first_corner`.
Points rounded(const Points& points, double deviation_m, bool free_first_corner = false);

/// Path length up to each point.
std::vector<double> distancesAlong(const Points& points);

/// Where the path is after `distance_m`, clamped to its ends.
Eigen::Vector3d pointOn(const Points& points, const std::vector<double>& distances_m, double distance_m);

struct Nearest {
  double distance_m = 0.0;  ///< Along the path.
  double off_m = 0.0;       ///< From the path.
};
/// The point of the first `within_m` of the path that is nearest to `point`.
Nearest nearestOn(const Points& points, const std::vector<double>& distances_m, const Eigen::Vector3d& point,
                  double within_m);

struct SpeedLimits {
  double speed_m_s;
  double acceleration_m_s2;  ///< Along the path and across it.
  double climb_m_s;          ///< Vertical part of the speed.
  double kink_m_s;           ///< Greatest sudden change of the velocity vector.
};
/// The greatest speed at each point such that curves are flown within the acceleration and every later point can still
/// be met; zero at the last.
std::vector<double> speedsAlong(const Points& points, const SpeedLimits& limits);

}  // namespace swiftlet::control
