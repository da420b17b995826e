// Obstacles at the height of the hull that the 3D map has and the plane of the laser misses: table tops, lamps, beams.
// They are added to the grid that paths are planned on, and to the points that the reactive layer brakes for.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// One thread. Without a 3D map the grid stays the same object. When the height changes, the voxels of the submaps next
/// to the camera are read again at once, those of a large map in the following updates: an update is short.
class CameraObstacles {
 public:
  explicit CameraObstacles(double hull_height_m) : half_hull_m_(0.5 * hull_height_m) {}

  /// `layer` may be null. `height_m` is that of the body over the take-off floor.
  void update(const std::shared_ptr<const common::Map3dLayer>& layer,
              const std::shared_ptr<const common::OccupancyGrid>& grid, double height_m);

  /// The grid of the last update with the obstacles; null before it.
  std::shared_ptr<const common::OccupancyGrid> grid() const { return grid_; }
  /// The centres of the cells that were added to it.
  const std::vector<Eigen::Vector2d>& cells_map_m() const { return cells_map_m_; }
  /// The centres of added cells up to `range_m` away, in the level frame of the body.
  std::vector<Eigen::Vector2f> pointsNear_level_m(const common::Pose2& T_map_body, double range_m) const;

 private:
  /// Where a submap has something at the height of the hull.
  struct Columns {
    std::shared_ptr<const common::VoxelMap> voxels;
    std::map<int, std::vector<common::VoxelIndex>> layers;  ///< The blocks of `voxels` by their z.
    std::optional<double> height_m;  ///< Of the body, for which the columns were read; none before.
    std::vector<Eigen::Vector2d> centers_submap_m;
    /// Cells of columns that the laser does not see, and the grid they were made of; null before the first time.
    std::vector<common::CellIndex> cells;
    std::shared_ptr<const common::OccupancyGrid> laser_grid;
    common::Pose2 T_map_submap;
    common::CellRect around;  ///< The cells of the laser grid that were looked at.
  };
  void followHeight(double height_m);
  void readColumns(const common::Map3dLayer& layer);
  int read(Columns& columns) const;
  void findCells(Columns& columns, const common::Pose2& T_map_submap) const;
  void overlay(const common::Map3dLayer& layer);

  double half_hull_m_;
  std::optional<double> height_m_;  ///< For which columns are read.
  bool unread_ = false;             ///< Some columns are still those of another height.
  std::vector<Columns> columns_;    ///< Of each submap.
  std::shared_ptr<const common::Map3dLayer> layer_;
  std::shared_ptr<const common::OccupancyGrid> laser_grid_, grid_;
  std::vector<Eigen::Vector2d> cells_map_m_;
};

}  // namespace swiftlet::autonomy
