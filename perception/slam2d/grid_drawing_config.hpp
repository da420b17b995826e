// Configuration of the drawing of scans into the grid map.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

/// How scans are drawn into the grid. Meaning and bounds of the fields are in describe().
struct GridDrawingConfig {
  double resolution_m = 0.05;
  static constexpr int hit_steps =
      18;  ///< Log-odds steps that a cell gains when a beam ends in it; at most one change a scan, and a hit wins.
  static constexpr int free_steps = 6;  ///< Log-odds steps that a cell loses when beams only pass.
  static constexpr int max_steps = 70;  ///< Cap of a cell's confidence (Bachrach 2009, 5.3).
  static constexpr double max_hit_range_m =
      20.0;  ///< End points farther than this are not drawn; the view to there still clears.
  static constexpr double max_free_range_m = 10.0;    ///< Range up to which beams without return clear.
  static constexpr double max_height_above_m = 0.25;  ///< What is higher than this over the body does not touch the
                                                      ///< hull (docs/decisions/grid_map.md#006).
  static constexpr double max_height_below_m =
      0.25;  ///< What is deeper than this below the body does not touch the hull.
  int glass_fade_scans = 1;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
