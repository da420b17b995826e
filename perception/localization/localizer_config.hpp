// The configuration of the localizer.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"
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

  double generation_distance_m = 0.20;  ///< After so much way the particles are weighed and drawn anew,
  double generation_turn_deg = 15.0;    ///< or after such a turn.
  double odometry_share = 0.02;         ///< The least error of the odometry, of the way,
  double odometry_deg_per_m = 0.5;      ///< and of the heading.
  double max_sigma_m = 1.0;             ///< A pose less certain than this is not known.

  double local_map_length_m = 12.0;
  double local_map_spacing_m = 0.15;  ///< Between points of the local map.
  int local_map_points = 160;
  int local_map_least_points = 40;  ///< With fewer nothing is concluded.
  double search_distance_m = 0.4;   ///< The whole map is searched again after so much way.
  double point_weight = 0.15;  ///< Of a point of the local map in the likelihood, as ParticleFilterConfig::beam_weight.
  double ambiguity = 0.01;     ///< A pose is not believed while others have together more than this probability.
  double least_explained = 0.70;    ///< Nor when the map explains less of the local map than this.
  double confirm_distance_m = 1.0;  ///< Nor before it has held over so much way.
  double distrust_search_s = 0.5;   ///< While in doubt it is looked for elsewhere, with this long between.
  double elsewhere_nats = 10.0;     ///< So much likelier elsewhere means that it is lost.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
