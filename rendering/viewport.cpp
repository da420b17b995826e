#include "rendering/viewport.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::rendering {
namespace {

constexpr double kMargin_m = 0.4;
constexpr double kSmallest_m = 6.0;
// Greatest distance from the map; a diverged estimate must not shrink the map to a dot.
constexpr double kFarthest_m = 100.0;

struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();

  void include(const Eigen::Vector2d& point) {
    const bool near =
        (point.array() >= low.array() - kFarthest_m).all() && (point.array() <= high.array() + kFarthest_m).all();
    if (!near) return;
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

}  // namespace

Viewport fitViewport(const common::OccupancyGrid& grid, std::span<const Eigen::Vector2d> points_map_m, int width_px,
                     int height_px) {
  Bounds bounds;
  const common::CellRect known = common::knownExtent(grid);
  if (!known.empty()) {
    const double resolution_m = grid.resolution_m();
    bounds.low = Eigen::Vector2d(known.begin.x, known.begin.y) * resolution_m;
    bounds.high = Eigen::Vector2d(known.end.x, known.end.y) * resolution_m;
  }
  for (const Eigen::Vector2d& point_map_m : points_map_m) bounds.include(point_map_m);

  const Eigen::Vector2d low = (bounds.low.array() - kMargin_m).floor();
  const Eigen::Vector2d high = (bounds.high.array() + kMargin_m).ceil();
  const Eigen::Vector2d size = (high - low).cwiseMax(kSmallest_m);
  Viewport viewport;
  viewport.center_map_m = 0.5 * (low + high);
  viewport.px_per_m = std::min(width_px / size.x(), height_px / size.y());
  viewport.width_px = width_px;
  viewport.height_px = height_px;
  return viewport;
}

}  // namespace swiftlet::rendering
