// The frame in which a flight's estimate is judged.
#pragma once

#include "common/geometry.hpp"

namespace swiftlet::simulation {
struct LaserErrorsConfig;
}

namespace swiftlet::evaluation {

/// The true pose of the vehicle's `map` frame, given that of the take-off place with the true heading of the body.
///
/// The vehicle knows its heading by its laser. A laser that is mounted with a yaw error, E, sees the scene of the
/// take-off turned, and everything the vehicle measures afterwards is in axes turned by that angle: the estimate is
/// E^-1 * T * E for a true motion T. Positions are turned about the take-off place and no scan can tell, while
/// differences of heading stay as they are. So the frame has the origin of the take-off place and the axes of the
/// mounted laser. This is exact: the error is that of the simulator's draw, not a fit, which would hide drift.
common::Pose3 knowableFrame(const common::Pose3& T_world_start, const simulation::LaserErrorsConfig& errors);

}  // namespace swiftlet::evaluation
