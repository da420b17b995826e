#include "perception/slam2d/grid_drawing_config.hpp"

#include "common/config_fields.hpp"
#include "common/occupancy_grid.hpp"

namespace swiftlet::perception {

void GridDrawingConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.01, 1}, "Side of a cell.");
  fields(
      "glass_fade_scans", glass_fade_scans, {1, 100'000},
      "Scans of which one clears what may be glass at angles at which beams go through glass; 1: glass is never kept.");
}

}  // namespace swiftlet::perception
