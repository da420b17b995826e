// Obstacles at the height of the hull that the 3D map has and the plane of the laser misses: table tops, lamps, beams.
// They are added to the grid that paths are planned on, and to the points that the reactive layer brakes for.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"

namespace swiftlet::autonomy {

/// One thread. Without a 3D map the grid stays the same object. When the height changes, the voxels of the submaps next
/// to the vehicle are read again at once, those of a large map in the following updates: an update is short. What a
/// later submap shows as free is removed in the same way, a part in each update.
class CameraObstacles {
 public:
  explicit CameraObstacles(double hull_height_m) : half_hull_m_(0.5 * hull_height_m) {}

  /// `layer` may be null. The z of the body is over the take-off floor.
  void update(const std::shared_ptr<const common::Map3dLayer>& layer,
              const std::shared_ptr<const common::OccupancyGrid>& grid, const Eigen::Vector3d& body_map_m);

  /// The grid of the last update with the obstacles; null before it.
  std::shared_ptr<const common::OccupancyGrid> grid() const { return grid_; }
  /// The centres of the cells that were added to it.
  const std::vector<Eigen::Vector2d>& cells_map_m() const { return cells_map_m_; }
  /// The centres of added cells up to `range_m` away, in the level frame of the body.
  std::vector<Eigen::Vector2f> pointsNear_level_m(const common::Pose2& T_map_body, double range_m) const;

 private:
  /// What is at the height of the hull over one voxel of the plane, within one block.
  struct Column {
    common::VoxelIndex bottom;    ///< The lowest voxel of the block.
    std::uint8_t occupied = 0;    ///< Bit i: voxel i from there upwards.
    common::CellIndex cell = {};  ///< Of the laser grid.
    bool gone = false;            ///< A later submap has seen all of it free.
  };
  static_assert(common::VoxelBlock::kSide <= 8);
  /// The columns of a submap.
  struct Columns {
    std::shared_ptr<const common::VoxelMap> voxels;
    std::map<int, std::vector<common::VoxelIndex>> layers;  ///< The blocks of `voxels` by their z.
    std::optional<double> height_m;  ///< Height of the body for which the columns were read; nullopt before.
    std::vector<Column> all;
    /// Those that the laser does not see, and the grid this was found in; null before the first time.
    std::vector<Column> beside_laser;
    std::shared_ptr<const common::OccupancyGrid> laser_grid;
    PlacedSubmap placed;              ///< The submap and its place when `beside_laser` was found.
    common::CellRect around;          ///< The cells of the laser grid that were looked at.
    std::vector<PlacedSubmap> later;  ///< The submaps that were checked for vacated voxels.
  };
  void readColumns(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order);
  int read(Columns& columns) const;
  void findBesideLaser(Columns& columns, const PlacedSubmap& submap) const;
  void findGone(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order);
  static void addColumns(const common::VoxelMap& voxels, common::VoxelIndex block, int low, int high,
                         std::vector<Column>& columns);
  static bool hasGone(const Columns& columns, const Column& column);
  void overlay();

  double half_hull_m_;
  std::optional<double> height_m_;  ///< For which columns are read.
  bool unread_ = false;             ///< Some columns are those of another height, or may have been vacated.
  std::vector<Columns> columns_;    ///< Of each submap.
  std::shared_ptr<const common::Map3dLayer> layer_;
  std::shared_ptr<const common::OccupancyGrid> laser_grid_, grid_;
  std::vector<Eigen::Vector2d> cells_map_m_;
};

}  // namespace swiftlet::autonomy
