// Obstacles at the height of the hull that the 3D map has and the plane of the laser misses: table tops, lamps, beams.
// They are added to the grid that paths are planned on, and to the points that the reactive layer brakes for.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "autonomy/planning_jobs/placed_submap.hpp"
#include "autonomy/submap_columns.hpp"
#include "common/geometry.hpp"
#include "common/occupancy_grid.hpp"
#include "common/world/map3d_layer.hpp"
#include "perception/slam2d/columns.hpp"

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

  /// What has gone by the map of the laser has gone from the submaps as well; see SubmapColumns::forget. From the next
  /// update on.
  void forget(const std::vector<perception::GoneColumn>& gone) { gone_.insert(gone_.end(), gone.begin(), gone.end()); }

  /// The grid of the last update with the obstacles; null before it.
  std::shared_ptr<const common::OccupancyGrid> grid() const { return grid_; }
  /// The centres of the cells that were added to it.
  const std::vector<Eigen::Vector2d>& cells_map_m() const { return cells_map_m_; }
  /// The centres of added cells up to `range_m` away, in the level frame of the body.
  std::vector<Eigen::Vector2f> pointsNear_level_m(const common::Pose2& T_map_body, double range_m) const;

 private:
  void readColumns(const std::vector<std::size_t>& order);
  void forgetGone(const std::vector<PlacedSubmap>& submaps);
  void findGone(const std::vector<PlacedSubmap>& submaps, const std::vector<std::size_t>& order);
  void overlay();

  double half_hull_m_;
  std::vector<perception::GoneColumn> gone_;  ///< Since the last update.
  std::optional<double> height_m_;            ///< For which columns are read.
  bool unread_ = false;                       ///< Some columns are those of another height, or may have been vacated.
  std::vector<SubmapColumns> columns_;        ///< Of each submap.
  std::shared_ptr<const common::Map3dLayer> layer_;
  std::shared_ptr<const common::OccupancyGrid> laser_grid_, grid_;
  std::vector<Eigen::Vector2d> cells_map_m_;
};

}  // namespace swiftlet::autonomy
