// How well a trajectory agrees with known relative poses between pairs of its poses.
// Source: Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009. No frames are
// aligned: an error made once does not count again in all later poses.
//
// The estimate and the relations must be poses of the same thing. The relations of fr079 are between poses of the
// ROBOT, whose laser is 0.04 m behind its centre: the same reference trajectory has an error of 0.058 m as poses of the
// laser and 0.046 m as poses of the robot. In the intel log the two coincide.
#pragma once

#include <cstddef>
#include <vector>

#include "common/trajectory.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::evaluation {

/// The error of a relation is relation^-1 * (x_from^-1 * x_to). Its translation error is the length of the translation,
/// its rotation error the angle in [0, pi] of the rotation (in the plane, the angle of the yaw). The authors' own
/// program weighs roll, pitch and yaw of the error one by one; the angle is the same in the plane and does not depend
/// on the axes in space.
struct RelationErrors {
  Statistics translation_m;
  Statistics rotation_rad;
  Statistics translation_squared_m2;
  Statistics rotation_squared_rad2;
  /// Relations with a stamp that is not in the estimate; no figure above includes them.
  std::vector<std::size_t> missing;
};

/// A stamp finds the pose within half a microsecond of it, because logs and relations are written with six decimals. A
/// wider search would be wrong: two scans of the intel log are 6 microseconds apart.
RelationErrors relationErrors(const common::Trajectory& estimate, const std::vector<common::Relation>& relations);

}  // namespace swiftlet::evaluation
