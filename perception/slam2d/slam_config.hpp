// Configuration of graph SLAM: when scans become key scans, and when loop closures are searched for and accepted.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "optimization/pose_graph_config.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"

namespace swiftlet::perception {

/// When a loop closure is searched for, and when it is accepted.
struct LoopClosureConfig {
  double spacing_m = 1.0;
  double max_sigma_m = 4.0;
  double min_window_m = 0.5;
  double min_window_deg = 10.0;
  double max_window_deg = 40.0;
  int query_scans = 5;
  int reference_scans = 9;
  int max_candidates = 4;
  double resolution_m = 0.04;
  double angular_resolution_deg = 0.5;
  double min_quality = 0.60;
  double min_fine_quality = 0.60;
  double max_ambiguity = 0.90;
  double distinct_m = 0.4;
  double distinct_deg = 12.0;
  double max_free_space_violation = 0.03;
  double max_edge_sigmas = 4.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct Slam2dConfig {
  CorrelativeMatcherConfig matcher;
  GridDrawingConfig grid;
  LoopClosureConfig loops;
  optimization::PoseGraphConfig graph;
  double key_distance_m = 0.4;
  double key_rotation_deg = 25.0;
  double key_time_s = 2.0;
  double level_tilt_deg = 2.0;
  double reuse_distance_m = 0.25;
  double reuse_rotation_deg = 20.0;
  double draw_distance_m = 0.10;
  double draw_rotation_deg = 6.0;
  double draw_time_s = 0.25;
  bool live_map = true;
  int scans_per_key = 16;
  double local_radius_m = 4.0;
  double local_sigma_m = 0.10;
  int local_scans = 10;
  double local_window_m = 0.15;
  double local_window_deg = 3.0;
  double edge_sigma_m = 0.01;
  double edge_sigma_deg = 0.15;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
