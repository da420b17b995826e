// The configuration of the multilevel filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

struct MultilevelConfig {
  static constexpr double resolution_m = 0.10;     ///< Side of a cell of the level map.
  static constexpr double neighbourhood_m = 0.80;  ///< A level known within this distance may explain a beam.
  static constexpr double join_distance_m =
      0.20;  ///< Two levels whose cells come this close meet; at most neighbourhood_m.
  double beam_noise_m = 0.015;
  static constexpr double surface_noise_m =
      0.005;  ///< Standard deviation of a real surface from flat, shared by all beams of a scan.
  static constexpr double acceleration_noise_m_s2 =
      0.04;                                      ///< Error of the vertical acceleration while a surface is seen.
  static constexpr double gate_sigma = 3.5;      ///< Half width of all confidence regions, in standard deviations.
  static constexpr double cluster_gap_m = 0.06;  ///< A wider gap between the sorted distances separates two surfaces.
  static constexpr int min_cluster_beams = 2;    ///< Fewer unexplained beams are outliers.
  static constexpr int confirm_scans = 3;  ///< Scans in a row that must see a new surface before it becomes a level.
  static constexpr double confirm_s =
      0.3;  ///< Time for which a new surface must be seen at one height before it becomes a level.
  static constexpr double confirm_moving_s = 1.0;  ///< Time for which a surface that rises or falls no faster than the
                                                   ///< error of the vertical speed must be seen; at least confirm_s.
  static constexpr double slope_sigma =
      4.0;  ///< A surface that rises or falls by more standard deviations than this is a slope and no level.
  static constexpr double hold_off_s = 0.3;  ///< Time for which a level is not used after it behaved like a slope.
  static constexpr double enter_after_s =
      0.3;  ///< A level that was not seen for this long counts as entered again when it is seen.
  static constexpr double unknown_per_m =
      1.0;  ///< Unknown surfaces to be expected, for each metre of height and each known one.
  static constexpr double floor_weight =
      10.0;               ///< Factor by which the take-off floor is likelier to be met than another level.
  bool one_floor = true;  ///< Whether the take-off floor may be met again anywhere, not only in the neighbourhood of
                          ///< where it was seen.
  static constexpr double least_step_down_m = 0.25;  ///< Nothing is less than this below the take-off floor.
  double publish_delay_s = 0.15;  ///< A measurement is published when nothing has contradicted it for this long.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
