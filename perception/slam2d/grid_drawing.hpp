// Draws scans into an occupancy grid: cells where beams end gain, cells that beams cross lose, each at most once a
// scan.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam2d.hpp"

namespace swiftlet::perception {

/// What of a scan is drawn, thinned to the grid; in the level frame.
struct DrawnScan {
  common::Time stamp;
  std::vector<Eigen::Vector2f> hits_level_m;
  std::vector<Eigen::Vector2f> free_level_m;  ///< Ends of views that hit nothing.
};
DrawnScan thinForDrawing(const ProjectedScan& scan, const GridDrawingConfig& config);

/// Keeps its buffer between scans. Not thread-safe.
class GridDrawer {
 public:
  explicit GridDrawer(const GridDrawingConfig& config) : config_(config) {}

  void draw(const DrawnScan& scan, const common::Pose2& T_map_body, common::OccupancyGrid& grid);

 private:
  void markRay(const Eigen::Vector2d& from, const Eigen::Vector2d& to);  // In cells.
  void apply(common::OccupancyGrid& grid) const;
  std::uint32_t& markAt(common::CellIndex c) {
    return marks_[static_cast<std::size_t>(c.y - rect_.begin.y) * static_cast<std::size_t>(rect_.width()) +
                  static_cast<std::size_t>(c.x - rect_.begin.x)];
  }

  GridDrawingConfig config_;
  common::CellRect rect_;
  std::vector<std::uint32_t> marks_;
  std::vector<Eigen::Vector2d> hits_, frees_;  // In cells.
};

}  // namespace swiftlet::perception
