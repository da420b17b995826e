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
  std::vector<common::Problem> validate() const;
};

struct TargetTrackerConfig {
  double position_sigma_m = 0.02;  ///< Standard deviation of the vehicle's place in its map, beside its drift.
  double mount_sigma_deg =
      0.6;  ///< Standard deviation of what is left of the camera's mount after its calibration; equal in all pictures.
};

}  // namespace swiftlet::perception
