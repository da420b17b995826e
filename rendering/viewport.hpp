// Which part of the `map` frame a picture shows: x of the map to the right, y up, no rotation.
#pragma once

#include <span>

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"

namespace swiftlet::rendering {

struct Viewport {
  Eigen::Vector2d center_map_m = Eigen::Vector2d::Zero();
  double px_per_m = 50.0;  ///< Positive.
  int width_px = 640;
  int height_px = 480;

  /// Pixel coordinates: (0, 0) is the upper left corner of the picture, y down; pixel i covers [i, i + 1).
  Eigen::Vector2d toPixel(const Eigen::Vector2d& point_map_m) const {
    return {0.5 * width_px + (point_map_m.x() - center_map_m.x()) * px_per_m,
            0.5 * height_px - (point_map_m.y() - center_map_m.y()) * px_per_m};
  }
  Eigen::Vector2d toMap(const Eigen::Vector2d& pixel) const {
    return {center_map_m.x() + (pixel.x() - 0.5 * width_px) / px_per_m,
            center_map_m.y() - (pixel.y() - 0.5 * height_px) / px_per_m};
  }
  bool operator==(const Viewport&) const = default;
};

/// The viewport that shows the known map and the points, with a margin. Its borders are on whole metres, so that a
/// growing map rarely makes the picture jump. It shows at least 6 m. A point farther than 100 m from the rest, or not
/// finite, is left out.
Viewport fitViewport(const common::OccupancyGrid& grid, std::span<const Eigen::Vector2d> points_map_m, int width_px,
                     int height_px);

}  // namespace swiftlet::rendering
