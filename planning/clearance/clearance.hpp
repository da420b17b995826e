// How far a place is from all that the hull must not touch: one answer for all who plan.
// What is not known to be free is in the way. A place outside of what is known has no clearance.
//
//   of a plane: the grid's cells that are not free (CellStates), people, keep-out zones
//   of a space: voxels that are not free; for a hull of a given height, those that it meets at its own height
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/disc.hpp"
#include "common/occupancy_grid.hpp"
#include "common/polygon.hpp"
#include "common/voxel_map.hpp"
#include "planning/clearance/cell_states.hpp"
#include "planning/clearance/distance_field.hpp"

namespace swiftlet::planning {

/// A value: a copy shares its tiles and costs little. Reading is safe from any thread while the object is not updated.
/// Distances are in metres, from the centre of a place's cell to that of the nearest cell in the way, in the frame of
/// the map; equal to those of a search of all cells, up to the reach.
class Clearance {
 public:
  /// Farther, all that is known is that it is at least so far. Finer cells than 1.6 cm have a smaller reach.
  static constexpr double kReach_m = 2.0;

  /// In the plane. The z of places does not matter.
  static Clearance ofPlane(double resolution_m) { return Clearance(resolution_m, true, std::nullopt); }
  /// In space, to the nearest voxel in any direction. With the height of an upright hull, horizontally from its axis to
  /// the nearest voxel between its bottom and its top, where the place is its middle.
  static Clearance ofSpace(double voxel_m, std::optional<double> hull_height_m = std::nullopt) {
    return Clearance(voxel_m, false, hull_height_m);
  }

  /// Of a plane. `grid` is a snapshot as CellStates::update asks for. Only what changed since the last call is computed
  /// again.
  void update(const common::OccupancyGrid& grid, std::span<const common::Disc> discs = {},
              std::span<const common::Polygon> keep_out = {});
  /// Of a space, in the same way. `map` is a snapshot that is not written to any more, of the resolution of this; a
  /// copy of it (with shared blocks) is kept.
  void update(const common::VoxelMap& map);

  /// Places are finite, and not so far away that their cells have no number.
  double at_m(const Eigen::Vector3d& place_map_m) const { return at_m(cellOf(place_map_m)); }
  double at_m(const Eigen::Vector2d& place_map_m) const {
    return at_m(Eigen::Vector3d(place_map_m.x(), place_map_m.y(), 0.0));
  }
  /// The least along a straight line, looked up at most half a cell apart.
  double along_m(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m) const {
    return along_m(from_map_m, to_map_m, 0.0);
  }
  /// Whether it is nowhere less than `radius_m` along a straight line.
  bool isFree(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m, double radius_m) const {
    return along_m(from_map_m, to_map_m, radius_m) >= radius_m;
  }

  /// The greatest answer: nothing is nearer.
  double reach_m() const { return reach_cells_ * resolution_m_; }
  double resolution_m() const { return resolution_m_; }
  bool isPlane() const { return plane_; }
  /// The box of what is known: beyond it nothing is free.
  Eigen::Vector3d min_map_m() const;
  Eigen::Vector3d max_map_m() const;

 private:
  Clearance(double resolution_m, bool plane, std::optional<double> hull_height_m);

  /// In the box of the field, or beyond it.
  common::VoxelIndex cellOf(const Eigen::Vector3d& place_map_m) const {
    const int x = numberOf(place_map_m.x()) - begin_.x, y = numberOf(place_map_m.y());
    if (plane_) return {x, 0, y - begin_.z};
    return {x, y - begin_.y, numberOf(place_map_m.z()) - begin_.z};
  }
  /// std::floor is a call where the processor has no instruction for it.
  int numberOf(double coordinate_m) const {
    const double cells = coordinate_m * cells_per_m_;
    const int whole = static_cast<int>(cells);
    return whole - (whole > cells ? 1 : 0);
  }
  double at_m(common::VoxelIndex cell) const {
    const bool within = cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < end_.x - begin_.x &&
                        cell.y < end_.y - begin_.y && cell.z < end_.z - begin_.z;
    return within ? distances_m_[static_cast<std::size_t>(field_.squared(cell))] : 0.0;
  }
  /// The same, ended where it is less than `enough_m`, which is returned then.
  double along_m(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m, double enough_m) const;
  void reshape(const common::VoxelIndex& begin, const common::VoxelIndex& end);
  /// Around what is known, on each side of the field's box.
  int margin_cells() const { return plane_ ? CellStates::kTile : common::VoxelBlock::kSide; }

  double resolution_m_, cells_per_m_;
  bool plane_;
  int reach_cells_;
  std::optional<int> half_height_cells_;
  common::VoxelIndex begin_, end_;  ///< Of the box of the field in cells of the map; a plane's y is along z.
  DistanceField field_;
  std::vector<double> distances_m_;  ///< By the squared distance in cells: a look-up is faster than a root.
  CellStates states_;                ///< Of a plane.
  common::VoxelMap voxels_;          ///< Of a space; kept for the identity of its blocks.
  std::vector<CellBox> layered_;     ///< Where people and zones were at the last update.
};

}  // namespace swiftlet::planning
