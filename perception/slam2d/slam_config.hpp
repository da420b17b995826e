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
  static constexpr int query_scans = 5;         ///< Newest key scans joined to the query.
  static constexpr int reference_scans = 9;     ///< Key scans around the candidate joined to the reference.
  int max_candidates = 4;                       ///< Places searched in one job.
  static constexpr double resolution_m = 0.04;  ///< Side of a cell of the wide search, which a fine match follows.
  static constexpr double angular_resolution_deg = 0.5;  ///< Step of the rotation of the wide search.
  static constexpr double min_quality = 0.60;            ///< Least quality of the wide match, on its coarse cells.
  double min_fine_quality = 0.60;
  static constexpr double max_ambiguity =
      0.90;                                  ///< A second, distinct place must score less than this share of the best.
  static constexpr double distinct_m = 0.4;  ///< Distance from which a second place is distinct.
  static constexpr double distinct_deg = 12.0;  ///< Rotation from which a second place is distinct.
  double max_free_space_violation = 0.03;       ///< Greatest share of either side's points in free space of the other,
                                                ///< beyond the share in free space of their own side.
  static constexpr double max_edge_sigmas = 4.0;  ///< A closure whose error after optimization is larger is rejected.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct Slam2dConfig {
  CorrelativeMatcherConfig matcher;
  GridDrawingConfig grid;
  LoopClosureConfig loops;
  optimization::PoseGraphConfig graph;
  static constexpr double key_distance_m =
      0.4;  ///< A scan is matched to the map after this distance, and becomes a key scan where there is none near.
  static constexpr double key_rotation_deg = 25.0;  ///< A scan is matched to the map after this rotation.
  static constexpr double key_time_s = 2.0;         ///< A scan is matched to the map after this time.
  static constexpr double level_tilt_deg =
      2.0;  ///< A scan tilted more than this waits half as long again, for a level one.
  static constexpr double reuse_distance_m =
      0.25;  ///< A scan within this distance and reuse_rotation_deg of a key scan does not become one, so that the
             ///< graph does not grow in known area.
  static constexpr double reuse_rotation_deg =
      20.0;  ///< A scan within this rotation and reuse_distance_m of a key scan does not become one.
  static constexpr double draw_distance_m = 0.10;   ///< Between key scans, a scan is drawn after this distance.
  static constexpr double draw_rotation_deg = 6.0;  ///< Between key scans, a scan is drawn after this rotation.
  static constexpr double draw_time_s = 0.25;       ///< Between key scans, a scan is drawn after this time.
  bool live_map = true;
  static constexpr int scans_per_key = 16;  ///< Newest drawn scans that are kept with a key scan, to redraw the grid.
  static constexpr double local_radius_m =
      4.0;                      ///< Key scans within this distance are the reference of the local match.
  double local_sigma_m = 0.10;  ///< A key scan with a greater projected uncertainty is left to the loop closures.
  static constexpr int local_scans = 10;          ///< Greatest number of key scans in the reference of the local match.
  static constexpr double local_window_m = 0.15;  ///< Half the search window of the local match.
  static constexpr double local_window_deg = 3.0;  ///< Half the search window of the local match's rotation.
  double edge_sigma_m = 0.01;    ///< Least standard deviation of an edge: neighbours share a reference, so that their
                                 ///< errors add up to more than those of independent matches.
  double edge_sigma_deg = 0.15;  ///< Least standard deviation of an edge's rotation.

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::perception
