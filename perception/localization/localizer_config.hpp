// The configuration of the localizer.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "perception/localization/global_search.hpp"
#include "perception/localization/particle_filter.hpp"
#include "perception/localization/scan_support.hpp"

namespace swiftlet::perception {

struct LocalizerConfig {
  LocalizerConfig();

  MapFieldConfig field;
  ParticleFilterConfig particles;
  GlobalSearchConfig search;
  ScanSupportConfig support;
  LostTestConfig lost;

  static constexpr double generation_distance_m =
      0.20;  ///< Distance after which the particles are weighted and resampled.
  static constexpr double generation_turn_deg = 15.0;  ///< Turn after which the particles are weighted and resampled.
  double odometry_share = 0.02;                        ///< Least error of the odometry, as a share of the distance.
  static constexpr double odometry_deg_per_m = 0.5;    ///< Least error of the odometry's heading for each metre.
  double max_sigma_m = 1.0;                            ///< A pose less certain than this is not known.

  static constexpr double local_map_length_m =
      12.0;  ///< Length of the path whose scans are kept until the pose is known.
  static constexpr double local_map_spacing_m = 0.15;  ///< Distance between points of the local map.
  static constexpr int local_map_points = 160;         ///< Points of the local map that are compared with the map.
  static constexpr int local_map_least_points =
      40;  ///< With fewer points in the local map nothing is concluded; at most local_map_points.
  static constexpr double search_distance_m = 0.4;  ///< Distance after which the whole map is searched again.
  static constexpr double point_weight =
      0.15;  ///< Weight of a point of the local map in the likelihood, as particles.beam_weight is of a beam.
  static constexpr double ambiguity =
      0.01;  ///< A pose is not accepted while all other places together have more than this probability.
  static constexpr double least_explained =
      0.70;  ///< A pose is not accepted while the map explains a smaller share of the local map.
  static constexpr double confirm_distance_m = 1.0;  ///< Distance over which a pose must hold before it is accepted.
  static constexpr double refuted_after_m = 2.5;  ///< Path length without a fitting place, less that with a convincing
                                                  ///< one, from which on the map counts as that of another place.
  static constexpr double fitting = 0.75;         ///< Mean value of the likelihood field at the local map at which a
                                                  ///< place fits it, however many others do.
  static constexpr double misfitting =
      0.65;  ///< Mean value of the likelihood field at the local map below which no place fits, however probable it is
             ///< among those that were found; at most fitting.
  static constexpr double convincing_probability =
      0.95;  ///< A place that is this probable, and fits by more than misfitting, is convincing.
  static constexpr double distrust_search_s =
      0.5;  ///< Time between searches of the whole map while the pose explains too little.
  static constexpr double elsewhere_nats =
      10.0;  ///< A place that is likelier by this log-ratio means that the pose is lost.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
