// Whether the sensors of a profile can carry a flight: what its data sheets tell before anything moves.
#pragma once

#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::autonomy {

/// What keeps the height or the position from being measured over a whole flight of that vehicle, with the key of the
/// laser's sheet in each message; without places. The height is measured by the beams that a mirror deflects down, and
/// by nothing else: neither an RGB-D camera nor an upright laser sees the floor below all the time. The position is
/// measured by at least `least_beams` beams around, in a plane that is about level.
std::vector<common::Problem> problemsOfSensors(const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
                                               int least_beams);

/// Greatest height over the floor that the beams down of a laser measure; not above 0 if they measure none.
double measuredHeight_m(const common::LaserConfig& laser);

}  // namespace swiftlet::autonomy
