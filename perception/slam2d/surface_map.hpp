// A map to match scans to: a grid of cells that know how surely they are occupied, and where in them and which way the
// surface lies, so that a scan can be matched to it more finely than the cells are wide. The confidence of a cell is
// capped, and what was seen last counts most, so that a place that changed is soon mapped anew (Bachrach 2009, section
// 5.3). Copies share what they have in common.
//
// It is of one height band, unlike SlicedMap. Only what is within the band is drawn; what was drawn at another height
// stays until beams pass it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/scan_matching/scan_contour.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"

namespace swiftlet::perception {

struct SurfaceMapConfig {
  /// Cells and their confidence. makeSlam() sets it to that of the published map.
  GridDrawingConfig grid;
  int max_hits = 10;
  double max_gap_m = 0.3;

  void describe(common::config::Fields& fields);
};

/// Heights over the take-off floor; by default all.
struct DrawnHeights {
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = std::numeric_limits<double>::infinity();

  bool contains(double height_m) const { return height_m >= low_m && height_m <= high_m; }
};
/// What may touch a hull that flies at a height.
DrawnHeights heightsAround(double flight_height_m, const GridDrawingConfig& config);

/// What of a scan goes into a map, in its level frame; the same for all maps that it is drawn into.
struct SurfaceScan {
  struct Hit {
    Eigen::Vector2f point_m;
    Eigen::Vector2f normal;  ///< Of the surface, towards the laser; zero when it is not known.
  };
  std::vector<Hit> hits;
  std::vector<Eigen::Vector2f> free_m;        ///< Ends of views that ended on what is not drawn.
  std::vector<Eigen::Vector2f> no_returns_m;  ///< Ends of views that nothing answered; drawn up to a wall.
};
/// A view that leaves the band says that it is free as long as it was within. A scan from outside the band says
/// nothing.
SurfaceScan toDraw(const ProjectedScan& scan, const SurfaceMapConfig& config, const DrawnHeights& band = {});

/// 6 bytes, of which there are many.
struct SurfaceCell {
  common::occupancy::Cell log_odds = common::occupancy::kUnknown;
  std::uint8_t hits = 0;                   ///< That the surface is the mean of; capped.
  std::int8_t offset_x = 0, offset_y = 0;  ///< From the middle of the cell to the surface, in 1/254 of its side.
  std::int8_t normal_x = 0, normal_y = 0;  ///< In 1/127; short where surfaces of many directions meet.
  bool operator==(const SurfaceCell&) const = default;

  bool isOccupied() const { return common::occupancy::isOccupied(log_odds); }
};

/// Where a scan is sketched before it goes into a map; kept between scans for its memory.
struct DrawingBoard {
  common::CellRect rect;
  std::vector<std::uint8_t> marks;
};

/// Not thread-safe.
class SurfaceMap {
 public:
  explicit SurfaceMap(const SurfaceMapConfig& config) : config_(config), grid_(config.grid.resolution_m) {}

  void draw(const SurfaceScan& scan, const common::Pose2& T_map_body, DrawingBoard& board);

  double resolution_m() const { return config_.grid.resolution_m; }
  common::CellIndex cellAt(const Eigen::Vector2d& point_m) const { return grid_.cellAt(point_m); }
  SurfaceCell at(common::CellIndex cell) const { return grid_.at(cell); }
  /// Of an occupied cell, where the surface is.
  Eigen::Vector2d surface_m(common::CellIndex index, const SurfaceCell& cell) const {
    return grid_.centerOf(index) + Eigen::Vector2d(cell.offset_x, cell.offset_y) * (config_.grid.resolution_m / 254.0);
  }

  /// A copy that shares all tiles until one of both is drawn to.
  SurfaceMap snapshot();
  common::OccupancyGrid occupancy() const;
  /// The surfaces in the occupied cells within a square about a place, a piece of contour a cell: as long as the cell
  /// is wide along it, or a point where surfaces of many directions meet.
  std::vector<ContourSegment> contourAround(const Eigen::Vector2d& middle_m, double half_m) const;
  const common::TiledGrid<SurfaceCell>& grid() const { return grid_; }

 private:
  void sketch(const SurfaceScan& scan, const common::Pose2& T_map_body, DrawingBoard& board) const;
  void update(common::CellIndex index, int steps);
  void addSurface(const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal);

  SurfaceMapConfig config_;
  common::TiledGrid<SurfaceCell> grid_;
};

}  // namespace swiftlet::perception
