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
  double spacing_m = 1.0;  ///< Path length between two searches.
  double max_sigma_m = 4.0;
  double min_window_m = 0.5;
  double min_window_deg = 10.0;
  double max_window_deg = 40.0;
  int max_candidates = 4;  ///< Places searched in one job.
  double min_fine_quality = 0.60;
  double max_free_space_violation = 0.03;  ///< Greatest share of either side's points in free space of the other,
                                           ///< beyond the share in free space of their own side (measured:
                                           ///< docs/decisions/slam.md#024).

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct Slam2dConfig {
  CorrelativeMatcherConfig matcher;
  GridDrawingConfig grid;
  LoopClosureConfig loops;
  optimization::PoseGraphConfig graph;
  bool live_map = true;
  static constexpr double local_radius_m =
      4.0;                       ///< Key scans within this distance are the reference of the local match.
  double local_sigma_m = 0.10;   ///< A key scan with a greater projected uncertainty is left to the loop closures.
  double edge_sigma_m = 0.01;    ///< Least standard deviation of an edge: neighbours share a reference, so that their
                                 ///< errors add up to more than those of independent matches (measured:
                                 ///< docs/decisions/slam.md#020).
  double edge_sigma_deg = 0.15;  ///< Least standard deviation of an edge's rotation.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
