// The map of one particle: a grid of cells that know how surely they are occupied, and where in them and which way the
// surface lies, so that a scan can be matched to it more finely than the cells are wide. The confidence of a cell is
// capped, and what was seen last counts most, so that a place that changed is soon mapped anew (Bachrach 2009, section
// 5.3). Copies share what they have in common.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/scan_matching/contour_normals.hpp"

namespace swiftlet::perception {

struct ParticleMapConfig {
  double resolution_m = 0.05;      ///< Side of a cell.
  int hit_steps = 18;              ///< Log-odds steps (common::occupancy) a cell gains when a beam ends in it,
  int free_steps = 6;              ///< and loses when beams only pass. Once a scan; a hit wins.
  int max_steps = 70;              ///< Confidence is capped at this.
  int max_hits = 10;               ///< The surface in a cell is the mean of about so many of its last hits.
  double max_hit_range_m = 20.0;   ///< End points farther than this are not drawn; the view to there still clears.
  double max_free_range_m = 10.0;  ///< Beams without return clear up to here.
  double max_gap_m = 0.3;          ///< Neighbouring end points nearer than this are of one surface.
};

/// What of a scan goes into a map, in its level frame; the same for all particles.
struct ParticleScan {
  struct Hit {
    Eigen::Vector2f point_m;
    Eigen::Vector2f normal;  ///< Of the surface, towards the laser; zero when it is not known.
  };
  std::vector<Hit> hits;
  std::vector<Eigen::Vector2f> free_m;        ///< Ends of views that ended on what is not drawn.
  std::vector<Eigen::Vector2f> no_returns_m;  ///< Ends of views that nothing answered; drawn up to a wall.
};
ParticleScan toDraw(const ProjectedScan& scan, const ParticleMapConfig& config);

/// 6 bytes, of which there are many.
struct ParticleCell {
  common::occupancy::Cell log_odds = common::occupancy::kUnknown;
  std::uint8_t hits = 0;                   ///< That the surface is the mean of; capped.
  std::int8_t offset_x = 0, offset_y = 0;  ///< From the middle of the cell to the surface, in 1/254 of its side.
  std::int8_t normal_x = 0, normal_y = 0;  ///< In 1/127; short where surfaces of many directions meet.
  bool operator==(const ParticleCell&) const = default;

  bool isOccupied() const { return common::occupancy::isOccupied(log_odds); }
};

/// Where a scan is sketched before it goes into a map; kept between scans for its memory.
struct DrawingBoard {
  common::CellRect rect;
  std::vector<std::uint8_t> marks;
};

/// Not thread-safe.
class ParticleMap {
 public:
  explicit ParticleMap(const ParticleMapConfig& config) : config_(config), grid_(config.resolution_m) {}

  void draw(const ParticleScan& scan, const common::Pose2& T_map_body, DrawingBoard& board);

  double resolution_m() const { return config_.resolution_m; }
  common::CellIndex cellAt(const Eigen::Vector2d& point_m) const { return grid_.cellAt(point_m); }
  ParticleCell at(common::CellIndex cell) const { return grid_.at(cell); }
  /// Of an occupied cell, where the surface is.
  Eigen::Vector2d surface_m(common::CellIndex index, const ParticleCell& cell) const {
    return grid_.centerOf(index) + Eigen::Vector2d(cell.offset_x, cell.offset_y) * (config_.resolution_m / 254.0);
  }

  /// A copy that shares all tiles until one of both is drawn to.
  ParticleMap snapshot();
  common::OccupancyGrid occupancy() const;
  const common::TiledGrid<ParticleCell>& grid() const { return grid_; }

 private:
  void sketch(const ParticleScan& scan, const common::Pose2& T_map_body, DrawingBoard& board) const;
  void update(common::CellIndex index, int steps);
  void addSurface(const Eigen::Vector2d& point_m, const Eigen::Vector2d& normal);

  ParticleMapConfig config_;
  common::TiledGrid<ParticleCell> grid_;
};

}  // namespace swiftlet::perception
