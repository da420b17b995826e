// The configuration of the multilevel filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

struct MultilevelConfig {
  double resolution_m = 0.10;
  double neighbourhood_m = 0.80;
  double join_distance_m = 0.20;
  double beam_noise_m = 0.015;
  double surface_noise_m = 0.005;
  double acceleration_noise_m_s2 = 0.04;
  double gate_sigma = 3.5;
  double cluster_gap_m = 0.06;
  int min_cluster_beams = 2;
  int confirm_scans = 3;
  double confirm_s = 0.3;
  double confirm_moving_s = 1.0;
  double slope_sigma = 4.0;
  double hold_off_s = 0.3;
  double enter_after_s = 0.3;
  double unknown_per_m = 1.0;
  double floor_weight = 10.0;
  bool one_floor = true;
  double least_step_down_m = 0.25;
  double publish_delay_s = 0.15;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
