// The configuration of every explorer.
#pragma once

#include "common/config_fwd.hpp"

namespace swiftlet::planning {

struct ExplorationConfig {
  double min_frontier_m = 0.30;
  double segment_m = 1.5;
  double laser_range_m = 12.0;
  double laser_field_of_view_deg = 270.0;
  double gain_depth_m = 2.0;
  double gain_exponent = 0.6;
  double min_gain_m2 = 0.03;
  double speed_m_s = 0.8;
  double yaw_rate_rad_s = 1.0;
  double acceleration_m_s2 = 0.8;
  double hysteresis = 0.25;
  double localizability_weight = 0.3;
  double least_wall_share = 0.55;
  double wall_range_m = 25.0;
  double open_m = 5.0;
  double max_unheld_m = 4.0;
  double lost_radius_m = 4.0;
  int max_attempts = 3;
  double attempt_radius_m = 0.35;
  int max_evaluated = 30;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::planning
