// How scans are drawn into the grid map.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"

namespace swiftlet::perception {

/// How scans are drawn into the grid.
struct GridDrawingConfig {
  double resolution_m = 0.05;
  int hit_steps = 18;  ///< Log-odds steps (common::occupancy) a cell gains when a beam ends in it,
  int free_steps = 6;  ///< and loses when beams only pass. Each cell changes at most once a scan; a hit wins.
  int max_steps = 70;  ///< Confidence is capped at this (Bachrach 2009, section 5.3).
  double max_hit_range_m = 20.0;     ///< End points farther than this are not drawn; the view to there still clears.
  double max_free_range_m = 10.0;    ///< Beams without return clear up to here.
  double max_height_above_m = 0.25;  ///< What is higher than this over the body does not touch the hull,
  double max_height_below_m = 0.25;  ///< nor what is deeper than this below it.
  double slice_height_m = 0.05;      ///< The map is kept in slices of this height.
  int fade_steps = 1;                ///< What a slice loses where another one is seen free,
  double fade_height_m = 0.10;       ///< above or below by up to this,
  double slow_fade_height_m = 0.25;  ///< or by up to this,
  int slow_fade_scans = 4;           ///< then only with each so-many-th scan.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
