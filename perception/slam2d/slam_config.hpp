// The configuration of graph SLAM: when scans become key scans, when loops are sought and believed.
#pragma once

#include <string>
#include <vector>

#include "common/config.hpp"
#include "optimization/pose_graph_config.hpp"
#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"

namespace swiftlet::perception {

/// When a loop is sought and when it is believed.
struct LoopClosureConfig {
  double spacing_m = 1.0;    ///< Way between two searches.
  double max_sigma_m = 4.0;  ///< Projected uncertainty is cut here; bounds the search window.
  double min_window_m = 0.5;
  double min_window_deg = 10.0;
  double max_window_deg = 40.0;
  int query_scans = 5;                  ///< Newest key scans joined to the query.
  int reference_scans = 9;              ///< Key scans around the candidate joined to the reference.
  int max_candidates = 4;               ///< Places searched per task.
  double resolution_m = 0.04;           ///< Of the wide search,
  double angular_resolution_deg = 0.5;  ///< which a fine match follows.
  double min_quality = 0.60;            ///< Of the wide match, on its coarse cells,
  double min_fine_quality = 0.60;       ///< and of the fine one.
  double max_ambiguity = 0.90;          ///< A second, distinct place must score less than this share of the best.
  double distinct_m = 0.4;              ///< What counts as distinct.
  double distinct_deg = 12.0;
  /// Greatest share of either side's points that the other looked through, beyond what a side looks through of itself.
  double max_free_space_violation = 0.03;
  double max_edge_sigmas = 4.0;  ///< A closure whose error after optimization is larger is taken back.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct Slam2dConfig {
  CorrelativeMatcherConfig matcher;
  GridDrawingConfig grid;
  LoopClosureConfig loops;
  optimization::PoseGraphConfig graph;
  double key_distance_m = 0.4;       ///< A scan is matched to the map after this distance,
  double key_rotation_deg = 25.0;    ///< this rotation,
  double key_time_s = 2.0;           ///< or this time; it becomes a key scan where there is none near.
  double level_tilt_deg = 2.0;       ///< A scan tilted more than this waits half as long again, for a level one.
  double reuse_distance_m = 0.25;    ///< "Near": a key scan within this distance
  double reuse_rotation_deg = 20.0;  ///< and rotation. So the graph does not grow in known area.
  double draw_distance_m = 0.10;     ///< Between key scans, a scan is drawn after this distance,
  double draw_rotation_deg = 6.0;    ///< this rotation,
  double draw_time_s = 0.25;         ///< or this time.
  bool live_map = true;              ///< The map is kept up to date with each scan; if not, it is drawn when asked for.
  int scans_per_key = 16;            ///< Drawn scans kept with a key scan for drawing the grid anew; the newest stay.
  double local_radius_m = 4.0;       ///< Key scans within this are the reference of the local match,
  double local_sigma_m = 0.10;  ///< as long as their projected uncertainty is below this; beyond it is a loop's work.
  int local_scans = 10;         ///< At most so many.
  double local_window_m = 0.15;
  double local_window_deg = 3.0;
  double edge_sigma_m = 0.01;    ///< No edge is more certain than this: neighbours share a reference, so that their
  double edge_sigma_deg = 0.15;  ///< errors add up to more than matches of their own would.

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

}  // namespace swiftlet::perception
