// The settings of the supervisor.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct SupervisorConfig {
  double battery_land_share = 0.12;
  double home_reserve_share = 0.02;
  double least_thrust_margin = 1.01;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::autonomy
