// The configuration of the multilevel filter.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"

namespace swiftlet::perception {

struct MultilevelConfig {
  double resolution_m = 0.10;             ///< Cells of the level map.
  double neighbourhood_m = 0.80;          ///< A level known within this distance may explain a beam.
  double join_distance_m = 0.20;          ///< Two levels whose cells come this close meet.
  double beam_noise_m = 0.015;            ///< Standard deviation of one distance, attitude error included.
  double surface_noise_m = 0.005;         ///< How far a real surface is from flat; shared by all beams of a scan.
  double acceleration_noise_m_s2 = 0.04;  ///< Error of the vertical acceleration over one scan period.
  double gate_sigma = 3.5;                ///< Half width of all confidence regions, in standard deviations.
  double cluster_gap_m = 0.06;            ///< Beams sorted by distance: a gap wider than this separates two surfaces.
  int min_cluster_beams = 2;              ///< Fewer unexplained beams are outliers.
  int confirm_scans = 3;                  ///< Scans in a row that must see a new surface before it becomes a level,
  double confirm_s = 0.3;                 ///< and for how long;
  double confirm_moving_s = 1.0;    ///< how long one that seems to rise or fall, as the vertical speed is not sure.
  double slope_sigma = 4.0;         ///< What rises or falls by more, in standard deviations, is a slope and no level.
  double hold_off_s = 0.3;          ///< How long a level is left alone after it behaved like a slope.
  double enter_after_s = 0.3;       ///< A level not seen for this long is entered anew when it is seen again.
  double unknown_per_m = 1.0;       ///< Surfaces not known yet that may be met, a metre of height, for each known one.
  double floor_weight = 10.0;       ///< The take-off floor is so much likelier to be met than another level.
  bool one_floor = true;            ///< The take-off floor is looked for everywhere, not only in the neighbourhood.
  double least_step_down_m = 0.25;  ///< Nothing is less than this below the take-off floor.
  double publish_delay_s = 0.15;    ///< A measurement that was not doubted for this long is given out.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
