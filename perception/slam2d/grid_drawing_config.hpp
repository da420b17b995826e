// Configuration of the drawing of scans into the grid map.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

/// How scans are drawn into the grid. Meaning and bounds of the fields are in describe().
struct GridDrawingConfig {
  double resolution_m = 0.05;
  int hit_steps = 18;
  int free_steps = 6;
  int max_steps = 70;
  double max_hit_range_m = 20.0;
  double max_free_range_m = 10.0;
  double max_height_above_m = 0.25;
  double max_height_below_m = 0.25;
  double slice_height_m = 0.05;
  int fade_steps = 1;
  double fade_height_m = 0.10;
  double slow_fade_height_m = 0.25;
  int slow_fade_scans = 4;
  int glass_fade_scans = 1;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
