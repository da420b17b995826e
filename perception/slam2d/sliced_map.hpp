// The occupancy map in horizontal slices. A beam of a tilted laser says something about the heights it passes, and only
// about those: what stands a little lower than the level beams see (a sofa, a half-high wall) is met by a tilted beam
// now and then, and level beams must not erase it. What may touch the hull is read off the slices at its height.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"

namespace swiftlet::perception {

/// What of a scan is drawn, thinned to the grid; (x, y, height over the body) in the level frame.
struct DrawnScan {
  common::Time stamp;
  double body_height_m = 0.0;  ///< Over the take-off floor.
  std::vector<Eigen::Vector3f> hits_level_m;
  std::vector<Eigen::Vector3f> free_level_m;        ///< Ends of views that ended on what is not drawn.
  std::vector<Eigen::Vector3f> no_returns_level_m;  ///< Ends of views that nothing answered; drawn up to a wall.
};
DrawnScan thinForDrawing(const ProjectedScan& scan, const GridDrawingConfig& config);

/// In each slice, cells where beams end gain, cells that beams cross lose, each at most once a scan. A beam without
/// return crosses cells only up to what is occupied at flight height, or where another beam of its scan ended: a wall
/// that is dark, or hit at a grazing angle, swallows beams, so that nothing is known beyond it. Single-threaded; a
/// snapshot may go to another thread.
class SlicedMap {
 public:
  explicit SlicedMap(const GridDrawingConfig& config);

  void draw(const DrawnScan& scan, const common::Pose2& T_map_body);

  /// The height over the take-off floor that the hull's middle is at or will be at; at first that of the first scan.
  /// True when the map is another one now.
  bool setFlightHeight(double height_m);
  /// What may touch the hull at flight height: occupied where any of the slices there is, free where any was seen free
  /// and none is occupied.
  common::OccupancyGrid atFlightHeight() { return combined_.snapshot(); }
  /// A copy that shares its tiles.
  SlicedMap snapshot();

 private:
  /// In cells, with fractions.
  struct Ray {
    Eigen::Vector2d from, to;
    bool ended = false;
  };

  int sliceAt(double height_m) const;
  void split(const DrawnScan& scan, const common::Pose2& T_map_body);
  bool isWall(common::CellIndex cell) const;
  void drawSlice(int slice, const std::vector<Ray>& rays);
  void apply(int slice);
  void fadeAround(int slice, common::CellIndex cell);
  void combine(common::CellIndex cell);
  void combineAll();
  void combine(common::CellIndex cell, common::occupancy::Cell before, common::occupancy::Cell now);
  common::OccupancyGrid& sliceGrid(int slice);
  std::uint32_t& markAt(common::CellIndex c) {
    return marks_[static_cast<std::size_t>(c.y - rect_.begin.y) * static_cast<std::size_t>(rect_.width()) +
                  static_cast<std::size_t>(c.x - rect_.begin.x)];
  }

  GridDrawingConfig config_;
  std::map<int, common::OccupancyGrid> slices_;
  common::OccupancyGrid combined_;
  double flight_height_m_ = 0.0;
  int lowest_ = 0;  ///< The slices that are combined.
  int highest_ = -1;
  int drawn_ = 0;  ///< Scans.
  // Of the scan being drawn.
  std::map<int, std::vector<Ray>> rays_;
  std::vector<common::CellIndex> ended_;  ///< Cells that its beams ended in, at any height; in order.
  common::CellRect rect_;
  std::vector<std::uint32_t> marks_;
};

}  // namespace swiftlet::perception
