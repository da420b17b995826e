#include "perception/slam2d/slam_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

void LoopClosureConfig::describe(common::config::Fields& fields) {
  fields("max_sigma_m", max_sigma_m, {0.05, 50},
         "Greatest projected uncertainty, which bounds the search window; at least min_window_m.");
  fields("min_window_m", min_window_m, {0.05, 10}, "Half the least search window.");
  fields("min_window_deg", min_window_deg, {1, 180}, "Half the least search window of the rotation.");
  fields("max_window_deg", max_window_deg, {1, 180},
         "Half the greatest search window of the rotation; at least min_window_deg.");
  fields("min_fine_quality", min_fine_quality, {0, 1}, "Least quality of the fine match.");
}

std::vector<common::Problem> LoopClosureConfig::validate() const {
  return common::Validation()
      .atMost("min_window_m", min_window_m, "max_sigma_m", max_sigma_m)
      .atMost("min_window_deg", min_window_deg, "max_window_deg", max_window_deg)
      .problems();
}

void Slam2dConfig::describe(common::config::Fields& fields) {
  fields.section("matcher", matcher, "Matching of a key scan to those around it.");
  fields.section("grid", grid, "The map.");
  fields.section("loops", loops, "Loop closures.");
  fields("live_map", live_map,
         "Whether the map is kept up to date with each scan; otherwise it is drawn when asked for.");
}

}  // namespace swiftlet::perception
