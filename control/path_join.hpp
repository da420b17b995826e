// From a reference in motion onto a new path: smoothly where that is free, braking first where it is not.
//
//   on the path      -->  along it
//   slow             -->  straight to a place as far ahead as the path is away
//   fast elsewhere   -->  on in the direction of flight for as long as turning takes, then onto the path
//   that is not free -->  to rest where braking ends, then to the nearest place of the path
#pragma once

#include <Eigen/Core>

#include "common/clearance_along.hpp"
#include "control/path_shape.hpp"

namespace swiftlet::control {

/// The reference, and how it may turn.
struct JoinStart {
  Eigen::Vector3d position_m, velocity_m_s;
  double acceleration_m_s2;   ///< With which it turns and brakes.
  double corner_deviation_m;  ///< See rounded().
  double kink_m_s;            ///< Greatest sudden change of the velocity.
};

/// The path from the reference on, with its corners rounded. Lines onto it are free where they come no nearer to
/// anything than the part of the path that they leave out, and than the reference is; of two ways that are not, the one
/// with more room is taken. Without `clearance_m` all is free. A pure function.
Points joined(const Points& path, const JoinStart& from, const common::ClearanceAlong& clearance_m);

}  // namespace swiftlet::control
