#include "perception/slam2d/grid_drawing_config.hpp"

#include "common/config_fields.hpp"
#include "common/occupancy_grid.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

void GridDrawingConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.01, 1}, "Side of a cell.");
  fields("hit_steps", hit_steps, {1, common::occupancy::kMaxSteps},
         "Log-odds steps that a cell gains when a beam ends in it; at most one change a scan, and a hit wins.");
  fields("free_steps", free_steps, {1, common::occupancy::kMaxSteps},
         "Log-odds steps that a cell loses when beams only pass.");
  fields("max_steps", max_steps, {1, common::occupancy::kMaxSteps}, "Cap of a cell's confidence (Bachrach 2009, 5.3).");
  fields("max_hit_range_m", max_hit_range_m, {0.5, 100},
         "End points farther than this are not drawn; the view to there still clears.");
  fields("max_free_range_m", max_free_range_m, {0, 100}, "Range up to which beams without return clear.");
  fields("max_height_above_m", max_height_above_m, {0, 100},
         "What is higher than this over the body does not touch the hull.");
  fields("max_height_below_m", max_height_below_m, {0, 100},
         "What is deeper than this below the body does not touch the hull.");
  fields("slice_height_m", slice_height_m, {0.01, 10}, "Height of the horizontal slices in which the map is kept.");
  fields("fade_steps", fade_steps, {0, common::occupancy::kMaxSteps},
         "Log-odds steps that a slice loses where one near it is seen free.");
  fields("fade_height_m", fade_height_m, {0, 10},
         "Height difference up to which a slice that is seen free makes another one fade.");
  fields(
      "slow_fade_height_m", slow_fade_height_m, {0, 10},
      "Height difference up to which a slice that is seen free makes another one fade slowly; at least fade_height_m.");
  fields("slow_fade_scans", slow_fade_scans, {1, 1000},
         "Scans of which one lets slices up to slow_fade_height_m away fade.");
  fields(
      "glass_fade_scans", glass_fade_scans, {1, 100'000},
      "Scans of which one clears what may be glass at angles at which beams go through glass; 1: glass is never kept.");
}

std::vector<std::string> GridDrawingConfig::validate() const {
  return common::Validation()
      .atMost("hit_steps", hit_steps, "max_steps", max_steps)
      .atMost("free_steps", free_steps, "max_steps", max_steps)
      .atMost("fade_steps", fade_steps, "max_steps", max_steps)
      .atMost("fade_height_m", fade_height_m, "slow_fade_height_m", slow_fade_height_m)
      .problems();
}

}  // namespace swiftlet::perception
