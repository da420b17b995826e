// How the vehicle flies below what hangs over its path.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct LowerFlightConfig {
  bool enabled = true;
  double least_height_m = 0.5;
  double air_below_m = 0.45;
  double air_around_m = 0.15;
  double step_m = 0.1;
  double change_cost_m = 1.0;
  double detour_m = 10.0;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
