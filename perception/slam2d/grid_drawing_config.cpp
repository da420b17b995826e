#include "perception/slam2d/grid_drawing_config.hpp"

#include "common/occupancy_grid.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

using common::Validation;

void GridDrawingConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, "Side of a cell.");
  fields("hit_steps", hit_steps, "Log-odds steps a cell gains when a beam ends in it.");
  fields("free_steps", free_steps, "Log-odds steps it loses when beams only pass.");
  fields("max_steps", max_steps, "Cap of the confidence.");
  fields("max_hit_range_m", max_hit_range_m, "End points farther than this are not drawn.");
  fields("max_free_range_m", max_free_range_m, "Beams without return clear up to here.");
  fields("max_height_above_m", max_height_above_m, "What is higher over the body does not touch the hull.");
  fields("max_height_below_m", max_height_below_m, "What is deeper below the body does not touch the hull.");
  fields("slice_height_m", slice_height_m, "The map is kept in horizontal slices of this height.");
  fields("fade_steps", fade_steps, "Log-odds steps a slice loses where one near is seen free.");
  fields("fade_height_m", fade_height_m, "How far above or below that one may be.");
  fields("slow_fade_height_m", slow_fade_height_m, "How far above or below it may be to make it fade slowly.");
  fields("slow_fade_scans", slow_fade_scans, "A slow fade is done once in so many scans.");
}

std::vector<std::string> GridDrawingConfig::validate() const {
  return Validation()
      .within("resolution_m", resolution_m, 0.01, 1)
      .within("max_steps", max_steps, 1, common::occupancy::kMaxSteps)
      .within("hit_steps", hit_steps, 1, max_steps)
      .within("free_steps", free_steps, 1, max_steps)
      .within("max_hit_range_m", max_hit_range_m, 0.5, 100)
      .within("max_free_range_m", max_free_range_m, 0, 100)
      .within("max_height_above_m", max_height_above_m, 0, 100)
      .within("max_height_below_m", max_height_below_m, 0, 100)
      .within("slice_height_m", slice_height_m, 0.01, 10)
      .within("fade_steps", fade_steps, 0, max_steps)
      .within("fade_height_m", fade_height_m, 0, 10)
      .within("slow_fade_height_m", slow_fade_height_m, fade_height_m, 10)
      .within("slow_fade_scans", slow_fade_scans, 1, 1000)
      .problems();
}

}  // namespace swiftlet::perception
