// The configuration of the localizer.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "perception/localization/global_search.hpp"
#include "perception/localization/particle_filter.hpp"

namespace swiftlet::perception {

struct LocalizerConfig {
  ParticleFilterConfig particles;
  GlobalSearchConfig search;

  static constexpr double generation_distance_m =
      0.20;  ///< Distance after which the particles are weighted and resampled (docs/localization.md).
  double odometry_share = 0.02;  ///< Least error of the odometry, as a share of the distance.
  double max_sigma_m = 1.0;      ///< A pose less certain than this is not known.

  static constexpr double local_map_length_m =
      12.0;  ///< Length of the path whose scans are kept until the pose is known (docs/localization.md).
  static constexpr double point_weight =
      0.15;  ///< Weight of a point of the local map in the likelihood, as particles.beam_weight is of a beam.
  static constexpr double ambiguity = 0.01;  ///< A pose is not accepted while all other places together have more than
                                             ///< this probability (docs/localization.md).

  static constexpr double confirm_distance_m =
      1.0;  ///< Distance over which a pose must hold before it is accepted (docs/localization.md).

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
