// Whether the sensors of a profile can carry a flight: by its data sheets, before the vehicle moves.
#pragma once

#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::autonomy {

/// What the rest of the autonomy needs of a laser. The defaults are those of the places that they come from.
struct ScanNeeds {
  int least_beams = 30;            ///< Of a match.
  double longest_silence_s = 0.3;  ///< kUnseenHold_s of autonomy/health: after it the vehicle holds.
  double longest_age_s = 0.5;      ///< FusionConfig::horizontal_timeout_s: older matches and heights are too old.
  double delay_s = 0.034;          ///< ScanQueueConfig: from the arrival of a scan to its use, at most.
  double max_rise_m = 1.0;         ///< ScanProjectionConfig: what is higher above the laser counts as ceiling.
};

/// What keeps the height or the position from being measured over a whole flight of that vehicle, with the key of the
/// laser's sheet in each message; without places. The height is measured by the beams that a mirror deflects down, and
/// by nothing else: neither an RGB-D camera nor an upright laser sees the floor below all the time. The position is
/// measured by enough beams around, in a plane that is about level, and often enough.
std::vector<common::Problem> problemsOfSensors(const common::LaserConfig& laser, const common::VehicleConfig& vehicle,
                                               const ScanNeeds& needs);

/// Greatest height over the floor that the beams down of a laser measure; not above 0 if they measure none.
double measuredHeight_m(const common::LaserConfig& laser);
/// Least height over the floor at which a vehicle that sways a little is always measured by them: nearer, the floor is
/// within range_min_m.
double leastMeasuredHeight_m(const common::LaserConfig& laser);

}  // namespace swiftlet::autonomy
