// How the vehicle flies below what hangs over its path.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct LowerFlightConfig {
  bool enabled = true;
  static constexpr double least_height_m = 0.5;  ///< Least height of a path that leads below what the camera sees.
  static constexpr double air_below_m = 0.45;    ///< Free height below the middle of the hull; more than what
                                                 ///< lifts the path over a surface (control.clearance.least_m).
  static constexpr double air_around_m =
      0.15;                              ///< Free height that the hull needs above itself, as it rises and sinks.
  static constexpr double step_m = 0.1;  ///< Heights are tried in these steps, from the height of flight down.
  static constexpr double change_cost_m = 1.0;  ///< Metres of path that a change of height is worth.
  static constexpr double detour_m = 10.0;      ///< Greatest detour that is flown instead of flying lower.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
