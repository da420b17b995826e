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

  double generation_distance_m = 0.20;
  double generation_turn_deg = 15.0;
  double odometry_share = 0.02;
  double odometry_deg_per_m = 0.5;
  double max_sigma_m = 1.0;

  double local_map_length_m = 12.0;
  double local_map_spacing_m = 0.15;
  int local_map_points = 160;
  int local_map_least_points = 40;
  double search_distance_m = 0.4;
  double point_weight = 0.15;
  double ambiguity = 0.01;
  double least_explained = 0.70;
  double confirm_distance_m = 1.0;
  double refuted_after_m = 2.5;
  double fitting = 0.75;
  double misfitting = 0.65;
  double convincing_probability = 0.95;
  double distrust_search_s = 0.5;
  double elsewhere_nats = 10.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
