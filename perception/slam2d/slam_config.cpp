#include "perception/slam2d/slam_config.hpp"

#include "common/validation.hpp"

namespace swiftlet::perception {

using common::Validation;

void LoopClosureConfig::describe(common::config::Fields& fields) {
  fields("spacing_m", spacing_m, "Way between two searches.");
  fields("max_sigma_m", max_sigma_m, "Projected uncertainty is cut here; bounds the search window.");
  fields("min_window_m", min_window_m, "Half the least search window.");
  fields("min_window_deg", min_window_deg, "The same for the rotation.");
  fields("max_window_deg", max_window_deg, "Half the greatest window of the rotation.");
  fields("query_scans", query_scans, "Newest key scans joined to the query.");
  fields("reference_scans", reference_scans, "Key scans around the candidate joined to the reference.");
  fields("max_candidates", max_candidates, "Places searched per task.");
  fields("resolution_m", resolution_m, "Of the wide search.");
  fields("angular_resolution_deg", angular_resolution_deg, "Of the wide search.");
  fields("min_quality", min_quality, "Of the wide match; less is no closure.");
  fields("min_fine_quality", min_fine_quality, "Of the fine match; less is no closure.");
  fields("max_ambiguity", max_ambiguity, "A second, distinct place must score less than this share of the best.");
  fields("distinct_m", distinct_m, "Distance from which a place is distinct.");
  fields("distinct_deg", distinct_deg, "Rotation from which it is.");
  fields("max_free_space_violation", max_free_space_violation,
         "Greatest share of either side's points that the other looked through, beyond what a side looks through of "
         "itself.");
  fields("max_edge_sigmas", max_edge_sigmas, "A closure whose error after optimization is larger is taken back.");
}

std::vector<std::string> LoopClosureConfig::validate() const {
  return Validation()
      .within("spacing_m", spacing_m, 0, 1000)
      .within("max_sigma_m", max_sigma_m, min_window_m, 50)
      .within("min_window_m", min_window_m, 0.05, 10)
      .within("min_window_deg", min_window_deg, 1, 180)
      .within("max_window_deg", max_window_deg, min_window_deg, 180)
      .within("query_scans", query_scans, 1, 100)
      .within("reference_scans", reference_scans, 1, 100)
      .within("max_candidates", max_candidates, 0, 100)
      .within("resolution_m", resolution_m, 0.01, 0.5)
      .within("angular_resolution_deg", angular_resolution_deg, 0.05, 10)
      .within("min_quality", min_quality, 0, 1)
      .within("min_fine_quality", min_fine_quality, 0, 1)
      .within("max_ambiguity", max_ambiguity, 0, 1)
      .within("max_free_space_violation", max_free_space_violation, 0, 1)
      .within("distinct_m", distinct_m, 0, 10)
      .within("distinct_deg", distinct_deg, 0, 180)
      .within("max_edge_sigmas", max_edge_sigmas, 0.1, 100)
      .problems();
}

void Slam2dConfig::describe(common::config::Fields& fields) {
  fields.section("matcher", matcher, "Matching of a key scan to those around it.");
  fields.section("grid", grid, "The map.");
  fields.section("loops", loops, "Loop closures.");
  fields.section("graph", graph, "Optimization of the pose graph.");
  fields("key_distance_m", key_distance_m, "A scan is matched to the map after this distance.");
  fields("key_rotation_deg", key_rotation_deg, "Or after this rotation.");
  fields("key_time_s", key_time_s, "Or after this time.");
  fields("level_tilt_deg", level_tilt_deg, "A scan tilted more than this waits half as long again, for a level one.");
  fields("reuse_distance_m", reuse_distance_m, "No new key scan within this distance of one.");
  fields("reuse_rotation_deg", reuse_rotation_deg, "And within this rotation.");
  fields("draw_distance_m", draw_distance_m, "A scan is drawn after this distance.");
  fields("draw_rotation_deg", draw_rotation_deg, "Or after this rotation.");
  fields("draw_time_s", draw_time_s, "Or after this time.");
  fields("live_map", live_map, "The map is kept up to date with each scan; if not, it is drawn when asked for.");
  fields("scans_per_key", scans_per_key, "Drawn scans kept with a key scan for drawing the grid anew.");
  fields("local_radius_m", local_radius_m, "Key scans within this are the reference of the local match.");
  fields("local_sigma_m", local_sigma_m, "As long as their projected uncertainty is below this.");
  fields("local_scans", local_scans, "At most so many.");
  fields("local_window_m", local_window_m, "Half the window of the local match.");
  fields("local_window_deg", local_window_deg, "The same for the rotation.");
  fields("edge_sigma_m", edge_sigma_m, "No edge is more certain than this.");
  fields("edge_sigma_deg", edge_sigma_deg, "The same for the rotation.");
}

std::vector<std::string> Slam2dConfig::validate() const {
  return Validation()
      .within("key_distance_m", key_distance_m, 0.02, 10)
      .within("key_rotation_deg", key_rotation_deg, 1, 180)
      .within("key_time_s", key_time_s, 0.01, 1e6)
      .within("level_tilt_deg", level_tilt_deg, 0, 90)
      .within("reuse_distance_m", reuse_distance_m, 0, 10)
      .within("reuse_rotation_deg", reuse_rotation_deg, 0, 180)
      .within("draw_distance_m", draw_distance_m, 0.01, 10)
      .within("draw_rotation_deg", draw_rotation_deg, 0.5, 180)
      .within("draw_time_s", draw_time_s, 0.001, 1e6)
      .within("scans_per_key", scans_per_key, 1, 10'000)
      .within("local_radius_m", local_radius_m, 0.1, 50)
      .within("local_sigma_m", local_sigma_m, 0.001, 10)
      .within("local_scans", local_scans, 1, 200)
      .within("local_window_m", local_window_m, 0.01, 5)
      .within("local_window_deg", local_window_deg, 0.1, 90)
      .within("edge_sigma_m", edge_sigma_m, 1e-5, 1)
      .within("edge_sigma_deg", edge_sigma_deg, 1e-4, 10)
      .problems();
}

}  // namespace swiftlet::perception
