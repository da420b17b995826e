// The occupancy map in horizontal slices. A beam of a tilted laser gives evidence for the heights it passes, and only
// for those. An obstacle a little below the level beams (a sofa, a half-height wall) is hit by a tilted beam now and
// then, and level beams must not erase it. The map at flight height combines the slices that the hull may touch.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/time.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/columns.hpp"
#include "perception/slam2d/glass_memory.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"
#include "perception/slam2d/low_obstacles.hpp"

namespace swiftlet::perception {

/// The part of a scan that is drawn, thinned to the grid: points (x, y, height above the body) in the level frame.
struct DrawnScan {
  common::Time stamp;
  double body_height_m = 0.0;   ///< Above the take-off floor.
  float laser_height_m = 0.0F;  ///< Above the body: there the beams begin.
  std::vector<Eigen::Vector3f> hits_level_m;
  std::vector<Incidence> incidences;                ///< Of the hits; those that are missing are unknown.
  std::vector<bool> moves;                          ///< Of the hits: on something that moves; missing ones are not.
  std::vector<Eigen::Vector3f> free_level_m;        ///< Ends of beams' free parts, where the end itself is not drawn.
  std::vector<Eigen::Vector3f> no_returns_level_m;  ///< Ends of beams without return; drawn up to a wall.
};
/// Thins a scan to the grid and cuts its beams to the height band and the ranges that are drawn.
DrawnScan thinForDrawing(const ProjectedScan& scan, const GridDrawingConfig& config);

/// A beam's part in one slice, in cells, with fractions.
struct SliceRay {
  Eigen::Vector2d from, to;
  double beyond = 0.0;  ///< How much farther than `to` the beam was free.
  /// Whether the beam ended here on something.
  bool ended = false;
  Incidence incidence = Incidence::kUnknown;
};

/// A scan that is being drawn, cut into slices.
struct SlicedScan {
  int laser_slice = 0;     ///< The slice of the laser.
  common::Duration lasts;  ///< Since the one before, or less.
  std::map<int, std::vector<SliceRay>> rays;
  std::vector<common::CellIndex> ended;            ///< Cells that its beams ended in, at any height; sorted.
  Eigen::Vector2d body = Eigen::Vector2d::Zero();  ///< In cells, with fractions.
  std::vector<std::uint32_t> marks;                ///< Of the cells around, in one slice.
};

/// In each slice, cells where beams end gain confidence and cells that beams cross lose it, each at most once a scan. A
/// beam without return crosses cells only up to the first one that is occupied at flight height, or in which another
/// beam of its scan ended. A wall that is dark, or hit at a grazing angle, returns no beam, so nothing is known behind
/// it. What may be glass is cleared only slowly by beams that would go through it. What beams have passed for long
/// enough, at a height at which it was hit, is gone at all of its heights (Columns). Not thread-safe; a snapshot may go
/// to another thread.
class SlicedMap {
 public:
  explicit SlicedMap(const GridDrawingConfig& config);

  void draw(const DrawnScan& scan, const common::Pose2& T_map_body);

  /// Sets the height of the hull's middle above the take-off floor. The initial one is that of the first scan. Small
  /// changes are ignored. Returns true when the map has changed.
  bool setFlightHeight(double height_m);
  /// What may touch the hull at flight height. A cell is occupied where any of the slices is, and free where at least
  /// one is free and none is occupied.
  common::OccupancyGrid atFlightHeight() { return combined_.snapshot(); }
  /// What was drawn at the place, to a cell, has gone.
  void forget(const Eigen::Vector2d& place_map_m);
  /// What has gone since the last call.
  std::vector<GoneColumn> takeGone() { return std::exchange(gone_, {}); }
  /// A copy that shares its tiles.
  SlicedMap snapshot();

 private:
  /// What beams of one scan did to one cell in one slice.
  enum class Met { kEnded, kPassedInside, kPassed };
  int sliceAt(double height_m) const;
  bool isCombined(int slice) const { return slice >= lowest_ && slice <= highest_; }
  void split(const DrawnScan& scan, const common::Pose2& T_map_body);
  bool isWall(common::CellIndex cell) const;
  void drawSlice(int slice, const std::vector<SliceRay>& rays, common::Time stamp);
  void apply(int slice, common::OccupancyGrid& grid, common::CellIndex cell, Met met, common::Time stamp);
  bool isGlass(common::CellIndex cell) const;
  bool meetLow(int slice, common::CellIndex cell, bool outline, common::Time stamp);
  bool isOutline(common::CellIndex cell) const;
  Columns::Extent metExtent(int slice, common::CellIndex cell, bool outline) const;
  void pass(int slice, common::CellIndex cell, Met met);
  void fadeAround(int slice, common::CellIndex cell);
  bool hasGone(int slice, common::CellIndex cell);
  void goesAlong(common::CellIndex cell, int surely);
  void free(common::CellIndex cell, const Columns::Extent& stood);
  void forgetLow(common::CellIndex cell, int surely);
  int unsureSlices(common::CellIndex cell) const;
  void combine(common::CellIndex cell);
  void combineAll();
  void combine(common::CellIndex cell, common::occupancy::Cell before, common::occupancy::Cell now);

  GridDrawingConfig config_;
  std::map<int, common::OccupancyGrid> slices_;
  common::OccupancyGrid combined_;
  GlassMemory glass_;
  LowObstacles low_;
  Columns columns_;
  std::vector<GoneColumn> gone_;
  double flight_height_m_ = 0.0;
  int lowest_ = 0;  ///< Range of the slices that are combined; empty before the first scan.
  int highest_ = -1;
  int drawn_ = 0;             ///< Number of drawn scans.
  common::Time drawn_stamp_;  ///< Of the last one.
  SlicedScan scan_;           ///< Working memory.
};

}  // namespace swiftlet::perception
