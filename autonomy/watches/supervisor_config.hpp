// The settings of the supervisor and of its watches.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct SupervisorConfig {
  static constexpr double unseen_hold_s =
      0.3;  ///< When no sensor has seen the surroundings for this long the vehicle holds.
  static constexpr double unseen_land_s =
      1.0;  ///< When no sensor has seen the surroundings for this long the vehicle lands.
  static constexpr double unseen_known_land_s =
      10.0;  ///< When no sensor has seen the surroundings for this long while other sensors measure the position, the
             ///< vehicle lands: what comes near is not seen.
  double battery_land_share = 0.12;
  double home_reserve_share = 0.02;
  static constexpr double home_need_factor = 1.15;  ///< Safety factor of the charge that the flight home takes.
  double least_thrust_margin = 1.01;
  static constexpr double thrust_margin_s =
      1.0;  ///< Time for which the thrust margin must have been less than least_thrust_margin before the vehicle lands.
  static constexpr double height_back_s =
      0.5;  ///< When the surface below has not been measured for this long the vehicle flies back along its trail.
  static constexpr double drift_back_m = 1.0;  ///< Standard deviation of the position, gathered where the laser did not
                                               ///< fix it, at which the vehicle flies back.
  static constexpr double drift_land_m =
      2.0;  ///< Standard deviation of the position, gathered where the laser did not fix it, at which the vehicle
            ///< lands; where there are no walls around it flies back up to twice as much.
  static constexpr double back_known_s =
      1.0;  ///< Flying back ends when height and position have been known again for this long.
  static constexpr double pilot_silent_s = 1.0;  ///< When a flying pilot's samples have been missing for this long, the
                                                 ///< program is in control again, and holds.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
