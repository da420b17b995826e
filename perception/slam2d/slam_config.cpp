#include "perception/slam2d/slam_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

void LoopClosureConfig::describe(common::config::Fields& fields) {
  fields("spacing_m", spacing_m, {0, 1000}, "Path length between two searches.");
  fields("max_sigma_m", max_sigma_m, {0.05, 50},
         "Greatest projected uncertainty, which bounds the search window; at least min_window_m.");
  fields("min_window_m", min_window_m, {0.05, 10}, "Half the least search window.");
  fields("min_window_deg", min_window_deg, {1, 180}, "Half the least search window of the rotation.");
  fields("max_window_deg", max_window_deg, {1, 180},
         "Half the greatest search window of the rotation; at least min_window_deg.");
  fields("query_scans", query_scans, {1, 100}, "Newest key scans joined to the query.");
  fields("reference_scans", reference_scans, {1, 100}, "Key scans around the candidate joined to the reference.");
  fields("max_candidates", max_candidates, {0, 100}, "Places searched in one job.");
  fields("resolution_m", resolution_m, {0.01, 0.5}, "Side of a cell of the wide search, which a fine match follows.");
  fields("angular_resolution_deg", angular_resolution_deg, {0.05, 10}, "Step of the rotation of the wide search.");
  fields("min_quality", min_quality, {0, 1}, "Least quality of the wide match, on its coarse cells.");
  fields("min_fine_quality", min_fine_quality, {0, 1}, "Least quality of the fine match.");
  fields("max_ambiguity", max_ambiguity, {0, 1},
         "A second, distinct place must score less than this share of the best.");
  fields("distinct_m", distinct_m, {0, 10}, "Distance from which a second place is distinct.");
  fields("distinct_deg", distinct_deg, {0, 180}, "Rotation from which a second place is distinct.");
  fields("max_free_space_violation", max_free_space_violation, {0, 1},
         "Greatest share of either side's points in free space of the other, beyond the share in free space of their "
         "own side.");
  fields("max_edge_sigmas", max_edge_sigmas, {0.1, 100},
         "A closure whose error after optimization is larger is rejected.");
}

std::vector<std::string> LoopClosureConfig::validate() const {
  return common::Validation()
      .atMost("min_window_m", min_window_m, "max_sigma_m", max_sigma_m)
      .atMost("min_window_deg", min_window_deg, "max_window_deg", max_window_deg)
      .problems();
}

void Slam2dConfig::describe(common::config::Fields& fields) {
  fields.section("matcher", matcher, "Matching of a key scan to those around it.");
  fields.section("grid", grid, "The map.");
  fields.section("loops", loops, "Loop closures.");
  fields.section("graph", graph, "Optimization of the pose graph.");
  fields("key_distance_m", key_distance_m, {0.02, 10},
         "A scan is matched to the map after this distance, and becomes a key scan where there is none near.");
  fields("key_rotation_deg", key_rotation_deg, {1, 180}, "A scan is matched to the map after this rotation.");
  fields("key_time_s", key_time_s, {0.01, 1e6}, "A scan is matched to the map after this time.");
  fields("level_tilt_deg", level_tilt_deg, {0, 90},
         "A scan tilted more than this waits half as long again, for a level one.");
  fields("reuse_distance_m", reuse_distance_m, {0, 10},
         "A scan within this distance and reuse_rotation_deg of a key scan does not become one, so that the graph does "
         "not grow in known area.");
  fields("reuse_rotation_deg", reuse_rotation_deg, {0, 180},
         "A scan within this rotation and reuse_distance_m of a key scan does not become one.");
  fields("draw_distance_m", draw_distance_m, {0.01, 10}, "Between key scans, a scan is drawn after this distance.");
  fields("draw_rotation_deg", draw_rotation_deg, {0.5, 180}, "Between key scans, a scan is drawn after this rotation.");
  fields("draw_time_s", draw_time_s, {0.001, 1e6}, "Between key scans, a scan is drawn after this time.");
  fields("live_map", live_map,
         "Whether the map is kept up to date with each scan; otherwise it is drawn when asked for.");
  fields("scans_per_key", scans_per_key, {1, 10'000},
         "Drawn scans, the newest, that are kept with a key scan for drawing the grid anew.");
  fields("local_radius_m", local_radius_m, {0.1, 50},
         "Key scans within this distance are the reference of the local match.");
  fields("local_sigma_m", local_sigma_m, {0.001, 10},
         "A key scan with a greater projected uncertainty is left to the loop closures.");
  fields("local_scans", local_scans, {1, 200}, "Greatest number of key scans in the reference of the local match.");
  fields("local_window_m", local_window_m, {0.01, 5}, "Half the search window of the local match.");
  fields("local_window_deg", local_window_deg, {0.1, 90}, "Half the search window of the local match's rotation.");
  fields("edge_sigma_m", edge_sigma_m, {1e-5, 1},
         "Least standard deviation of an edge: neighbours share a reference, so that their errors add up to more than "
         "those of independent matches.");
  fields("edge_sigma_deg", edge_sigma_deg, {1e-4, 10}, "Least standard deviation of an edge's rotation.");
}

}  // namespace swiftlet::perception
