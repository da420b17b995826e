// The pass criteria of a trial.
#pragma once

#include <limits>

#include "common/config_fwd.hpp"

namespace swiftlet::evaluation {

/// What a flight, and all flights of a trial together, must reach to pass. Criteria at their default are not checked,
/// except the first two.
struct Criteria {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  bool mission_done = true;
  int collisions_max = 0;
  bool verdicts = false;
  double needless_share_max = 0.05;
  int crashes_max = 0;
  double done_share_min = 0.0;
  double coverage_min = 0.0;
  double goal_error_max_m = kAny;
  double home_error_max_m = kAny;
  double marker_error_max_m = kAny;
  double relocalization_error_max_m = kAny;
  double mission_time_max_s = kAny;
  double estimate_rms_max_m = kAny;
  double estimate_spatial_rms_max_m = kAny;
  double map_wall_error_max_m = kAny;
  double map3d_error_max_m = kAny;
  double map3d_aligned_error_max_m = kAny;
  double map3d_aligned_p95_max_m = kAny;
  double map3d_coverage_min = 0.0;
  double localized_within_m = kAny;
  double wrong_time_share_max = kAny;
  double tilted_share_max = kAny;
  double thrust_margin_min = 0.0;
  double touch_down_speed_max_m_s = kAny;
  double safe_action_max_s = kAny;
  double home_energy_error_max = kAny;
  double keep_out_gap_min_m = 0.0;
  double inspect_axis_max_deg = kAny;
  double survey_coverage_min = 0.0;
  double follow_share_min = 0.0;
  double follow_lost_max_s = kAny;
  double targets_found_min = 0.0;
  double target_error_max_m = kAny;
  double false_targets_max = kAny;
  double end_distance_max_m = kAny;
  double unfinished_distance_min_m = 0.0;
  double memory_max_MB = kAny;
  double frame_growth_max = kAny;
  bool all_resumed = true;
  double goal_error_median_max_m = kAny;
  double home_error_median_max_m = kAny;
  double mission_time_median_max_s = kAny;
  double estimate_rms_median_max_m = kAny;
  double map_wall_error_median_max_m = kAny;
  double localized_flights_min = 0.0;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::evaluation
