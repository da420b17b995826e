// The configuration of the multilevel filter.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

struct MultilevelConfig {
  double beam_noise_m = 0.015;
  static constexpr double surface_noise_m =
      0.005;  ///< Standard deviation of a real surface from flat, shared by all beams of a scan.
  static constexpr double gate_sigma = 3.5;      ///< Half width of all confidence regions, in standard deviations.
  static constexpr double cluster_gap_m = 0.06;  ///< A wider gap between the sorted distances separates two surfaces.
  static constexpr int min_cluster_beams = 2;    ///< Fewer unexplained beams are outliers.
  static constexpr double slope_sigma =
      4.0;  ///< A surface that rises or falls by more standard deviations than this is a slope and no level.
  bool one_floor = true;  ///< Whether the take-off floor may be met again anywhere, not only in the neighbourhood of
                          ///< where it was seen.
  double publish_delay_s = 0.15;  ///< A measurement is published when nothing has contradicted it for this long
                                  ///< (docs/decisions/altitude.md#008).

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
