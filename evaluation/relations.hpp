// How well a trajectory keeps what is known to lie between pairs of its poses.
// Source: Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009. No frames are
// aligned: an error that was made once does not count again in all poses after it.
//
// The poses of the estimate must be of what the relations are between. Those of fr079 are between poses of the ROBOT,
// whose laser sits 0.04 m behind its centre: one and the same reference trajectory is 0.058 m off as poses of the laser
// and 0.046 m as poses of the robot. In the intel log both are one.
#pragma once

#include <cstddef>
#include <vector>

#include "common/trajectory.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {

/// The error of a relation is relation^-1 * (x_from^-1 * x_to): the length of its translation, the angle in [0, pi] of
/// its rotation (in the plane, that of the yaw alone). The authors' own program weighs roll, pitch and yaw of the error
/// one by one; the angle is the same in the plane and does not depend on the axes in space.
struct RelationErrors {
  Statistics translation_m;
  Statistics rotation_rad;
  Statistics translation_squared_m2;
  Statistics rotation_squared_rad2;
  std::vector<std::size_t> missing;  ///< The relations of which a stamp is not in the estimate; in no figure above.
};

/// A stamp finds the pose within half a microsecond of it, for logs and relations are written with six decimals. Less
/// precise is wrong: two scans of the intel log are 6 microseconds apart.
RelationErrors relationErrors(const common::Trajectory& estimate, const std::vector<common::Relation>& relations);

}  // namespace swiftlet::evaluation
