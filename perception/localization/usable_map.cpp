// The check whether a map can be used for localization.
#include <optional>

#include "common/occupancy_grid.hpp"
#include "perception/localization/localizer.hpp"
#include "perception/localization/map_field.hpp"

namespace swiftlet::perception {

std::optional<common::Message> Localizer::whyUnusable(const common::OccupancyGrid& map) {
  const common::CellRect known = common::knownExtent(map);
  if (static_cast<std::int64_t>(known.width()) * known.height() > MapField::kMaxCells)
    return common::Message("map.too-large",
                           "what is known of the map spans {} x {} cells: at most {} million can be localized in",
                           known.width(), known.height(), MapField::kMaxCells / 1'000'000);
  bool walls = false, free = false;
  map.forEachCell([&](common::CellIndex, common::occupancy::Cell cell) {
    walls |= common::occupancy::isOccupied(cell);
    free |= common::occupancy::isFree(cell);
  });
  if (!free) return common::Message("map.no-free-cells", "the map has no free cells: a vehicle can be nowhere in it");
  if (!walls)
    return common::Message("map.no-occupied-cells", "the map has no occupied cells: there is nothing to see in it");
  return std::nullopt;
}

}  // namespace swiftlet::perception
