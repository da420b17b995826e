// The settings of the supervisor and of its watches.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::autonomy {

struct SupervisorConfig {
  double unseen_hold_s = 0.3;
  double unseen_land_s = 1.0;
  double unseen_known_land_s = 10.0;
  double battery_land_share = 0.12;
  double home_reserve_share = 0.02;
  double home_need_factor = 1.15;
  double least_thrust_margin = 1.01;
  double thrust_margin_s = 1.0;
  double height_back_s = 0.5;
  double drift_back_m = 1.0;
  double drift_land_m = 2.0;
  double back_known_s = 1.0;
  double pilot_silent_s = 1.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::autonomy
