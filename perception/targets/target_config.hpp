// What targets look like, and when something counts as one.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

/// Things of one colour that are looked for.
struct TargetClassConfig {
  std::string name = "target";
  double hue_deg = 0.0;
  double hue_tolerance_deg = 12.0;
  double saturation_min = 0.5;
  double value_min = 0.15;
  double diameter_m = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct TargetDetectorConfig {
  int pixels_min = 40;
  double diameter_min_m = 0.08;
  double diameter_max_m = 0.5;
  double diameter_tolerance = 0.5;
  double fill_min = 0.5;
  double relief_m = 0.04;
  double outline_share_min = 0.5;
  double hidden_share_max = 0.4;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct TargetTrackerConfig {
  int confirm_views = 3;
  double view_distance_m = 0.2;
  double position_sigma_m = 0.02;
  double attitude_sigma_deg = 0.4;
  double mount_sigma_deg = 0.6;
  double inverse_depth_sigma_1_m = 0.001;
  double time_sigma_s = 0.004;
  double gate_sigma = 4.0;
  int misses_max = 6;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
