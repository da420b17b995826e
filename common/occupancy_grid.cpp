#include "common/occupancy_grid.hpp"

#include <climits>
#include <cmath>

namespace swiftlet::common {

double occupancy::probability(Cell c) {
  if (isUnknown(c)) return 0.5;
  return 1.0 / (1.0 + std::exp(-kLogOddsPerStep * c));
}

CellRect knownExtent(const OccupancyGrid& grid) {
  CellRect rect{{INT_MAX, INT_MAX}, {INT_MIN, INT_MIN}};
  grid.forEachCell([&](CellIndex c, occupancy::Cell value) {
    if (occupancy::isUnknown(value)) return;
    rect.begin = {std::min(rect.begin.x, c.x), std::min(rect.begin.y, c.y)};
    rect.end = {std::max(rect.end.x, c.x + 1), std::max(rect.end.y, c.y + 1)};
  });
  return rect.begin.x == INT_MAX ? CellRect{} : rect;
}

}  // namespace swiftlet::common
