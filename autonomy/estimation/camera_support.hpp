// Whether the camera alone measures the position of the vehicle.
#pragma once

#include "common/vehicle_state.hpp"

namespace swiftlet::autonomy {

struct CameraSupport {
  bool horizontal = false;  ///< In every horizontal direction.
  bool vertical = false;
};

/// What the state is known by, right after a measurement of the camera entered it. A direction is supported while its
/// velocity is known to 12 cm/s. Before a bare wall the camera measures the distance to it and nothing along it, and
/// the velocity along it becomes ever less certain. The measurement's own covariance does not show this: along a wall
/// with texture a shift and a turn look alike, but the gyroscopes measure the turn.
CameraSupport supportOf(const common::VehicleState& state);

}  // namespace swiftlet::autonomy
