// The map that scans are matched to: a grid of cells that hold how certainly they are occupied, and the position and
// normal of the surface in them. So a scan can be matched more finely than the cells are wide. The confidence of a cell
// is capped and the newest observations count most, so that a place that has changed is soon mapped again (Bachrach
// 2009, section 5.3). Copies share their tiles.
//
// Unlike SlicedMap it covers one height band. Only what is within the band is drawn. What was drawn at another height
// stays until beams cross it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/contour_normals.hpp"
#include "perception/scan_matching/scan_contour.hpp"
#include "perception/slam2d/grid_drawing_config.hpp"

namespace swiftlet::perception {

/// A band of heights above the take-off floor; by default all heights.
struct DrawnHeights {
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = std::numeric_limits<double>::infinity();

  bool contains(double height_m) const { return height_m >= low_m && height_m <= high_m; }
};
/// The heights at which an obstacle may touch a hull that flies at `flight_height_m`.
DrawnHeights heightsAround(double flight_height_m, const GridDrawingConfig& config);

/// The part of a scan that is drawn into a map, in the scan's level frame. It is the same for all maps.
struct SurfaceScan {
  struct Hit {
    Eigen::Vector2f point_m;
    Eigen::Vector2f normal;  ///< Of the surface, towards the laser; zero when it is not known.
  };
  std::vector<Hit> hits;
  std::vector<Eigen::Vector2f> free_m;        ///< Ends of beams' free parts, where the end itself is not drawn.
  std::vector<Eigen::Vector2f> no_returns_m;  ///< Ends of beams without return; drawn up to a wall.
};
/// A beam that leaves the band shows free space up to where it leaves. A scan from outside the band has nothing to
/// draw.
SurfaceScan toDraw(const ProjectedScan& scan, const GridDrawingConfig& config, const DrawnHeights& band = {});

/// 6 bytes, because a map has many of them.
struct SurfaceCell {
  common::occupancy::Cell log_odds = common::occupancy::kUnknown;
  std::uint8_t hits = 0;                   ///< Hits that make up the mean surface; capped.
  std::int8_t offset_x = 0, offset_y = 0;  ///< From the middle of the cell to the surface, in 1/254 of its side.
  std::int8_t normal_x = 0, normal_y = 0;  ///< Mean normal in 1/127; shorter where surfaces of many directions meet.
  bool operator==(const SurfaceCell&) const = default;

  bool isOccupied() const { return common::occupancy::isOccupied(log_odds); }
};

/// Working memory for drawing a scan; kept between scans, so that it is allocated once.
struct DrawingBoard {
  common::CellRect rect;
  std::vector<std::uint8_t> marks;
};

/// Not thread-safe.
class SurfaceMap {
 public:
  /// The surface in a cell is the mean of about this many of its last hits.
  static constexpr int kMaxHits = 10;
  /// Neighbouring end points nearer than this are of one surface.
  static constexpr double kMaxGap_m = 0.3;

  explicit SurfaceMap(const GridDrawingConfig& config) : config_(config), grid_(config.resolution_m) {}

  void draw(const SurfaceScan& scan, const common::Pose2& T_map_body, DrawingBoard& board);

  /// What was drawn in the cell has gone; nothing happens if it is not occupied.
  void forget(common::CellIndex cell);

  double resolution_m() const { return config_.resolution_m; }
  common::CellIndex cellAt(const Eigen::Vector2d& point_m) const { return grid_.cellAt(point_m); }
  SurfaceCell at(common::CellIndex cell) const { return grid_.at(cell); }
  /// The position of the surface in an occupied cell.
  Eigen::Vector2d surface_m(common::CellIndex index, const SurfaceCell& cell) const {
    return grid_.centerOf(index) + Eigen::Vector2d(cell.offset_x, cell.offset_y) * (config_.resolution_m / 254.0);
  }

  /// A copy that shares all tiles until one of the two is drawn to.
  SurfaceMap snapshot();
  /// The confidence of the cells as an occupancy grid.
  common::OccupancyGrid occupancy() const;
  /// The surfaces in the occupied cells of the square of half side `half_m` around `middle_m`, one piece of contour per
  /// cell. The piece lies along the surface and is as long as the cell is wide. It is a point where surfaces of many
  /// directions meet.
  std::vector<ContourSegment> contourAround(const Eigen::Vector2d& middle_m, double half_m) const;
  const common::TiledGrid<SurfaceCell>& grid() const { return grid_; }

 private:
  void sketch(const SurfaceScan& scan, const common::Pose2& T_map_body, DrawingBoard& board) const;
  void update(common::CellIndex index, int steps);
  void addSurface(const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal);

  GridDrawingConfig config_;
  common::TiledGrid<SurfaceCell> grid_;
};

}  // namespace swiftlet::perception
