// How far a place is from all that the hull must not touch: one answer for all who plan, brake, land and explore.
// What is not known to be free is in the way. A place outside of what is known has no clearance.
//
//   of a plane: a layer each of the grid's occupied cells and of its unknown ones (CellStates), and of people with
//               keep-out zones; who asks says which of them count
//   of a space: voxels that are not free; for a hull of a given height, those that it meets at its own height
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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

/// The layers of a plane that an answer counts. Of a space all is one.
enum class Against : std::uint8_t {
  kObstacles = 1,  ///< Occupied cells of the grid. Beyond what is known none stands.
  kUnseen = 2,     ///< Unknown cells of the grid, and all beyond it.
  kMapped = 3,     ///< What the grid does not have as free.
  kBarred = 4,     ///< People and keep-out zones.
  kThings = 5,     ///< All but what is only unknown.
  kAnything = 7,
};

/// A value: a copy shares its tiles and costs little. Reading is safe from any thread while the object is not updated.
/// Distances are in metres, from the centre of a place's cell to that of the nearest cell in the way, in the frame of
/// the map; equal to those of a search of all cells, up to the reach.
class Clearance {
 public:
  /// Farther, all that is known is that it is at least so far. Finer cells than 1.6 cm have a smaller reach.
  static constexpr double kReach_m = 2.0;

  /// Up to where the layers of a plane tell distances apart; what is unknown matters to many only where it is near.
  struct Reach {
    double things_m;
    double unseen_m;
  };

  /// In the plane. The z of places does not matter.
  static Clearance ofPlane(double resolution_m, const Reach& reach = {kReach_m, kReach_m}) {
    return Clearance(resolution_m, true, reach, std::nullopt);
  }
  /// In space, to the nearest voxel in any direction. With the height of an upright hull, horizontally from its axis to
  /// the nearest voxel between its bottom and its top, where the place is its middle.
  static Clearance ofSpace(double voxel_m, std::optional<double> hull_height_m = std::nullopt) {
    return Clearance(voxel_m, false, {kReach_m, kReach_m}, hull_height_m);
  }

  /// Of a plane. `grid` is a snapshot as CellStates::update asks for. Only what changed since the last call is computed
  /// again. Returns the boxes, counted from the first cell of states().rect() with its y along z, in which a distance
  /// to an obstacle or to the unknown changed; a box may come twice.
  std::vector<CellBox> update(const common::OccupancyGrid& grid, std::span<const common::Disc> discs = {},
                              std::span<const common::Polygon> keep_out = {});
  /// Of a space, in the same way. `map` is a snapshot that is not written to any more, of the resolution of this; a
  /// copy of it (with shared blocks) is kept.
  void update(const common::VoxelMap& map);

  /// Places are finite, and not so far away that their cells have no number.
  double at_m(const Eigen::Vector3d& place_map_m, Against against = Against::kAnything) const {
    return at_m(cellOf(place_map_m), against);
  }
  double at_m(const Eigen::Vector2d& place_map_m, Against against = Against::kAnything) const {
    return at_m(inSpace(place_map_m), against);
  }
  /// Of a cell of the grid of a plane.
  double at_m(common::CellIndex cell, Against against) const { return at_m(inField(cell), against); }
  /// In cells and squared, of one layer: an index into what is tabled by distance. The cell is in states().rect().
  int squaredCells(common::CellIndex cell, Against layer) const { return layerOf(layer).field.squared(inField(cell)); }

  /// The least along a straight line, looked up at most half a cell apart.
  double along_m(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m,
                 Against against = Against::kAnything) const {
    return nearestOn(from_map_m, to_map_m, 0.0, against).clearance_m;
  }
  /// Whether it is nowhere less than `radius_m` along a straight line. Most lines that are refused end in what is in
  /// the way.
  bool isFree(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m, double radius_m,
              Against against = Against::kAnything) const {
    return at_m(to_map_m, against) >= radius_m &&
           nearestOn(from_map_m, to_map_m, radius_m, against).clearance_m >= radius_m;
  }
  /// How far along a straight line in the plane it is not less than `radius_m`; the whole length if it nowhere is.
  double freeFor_m(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m, double radius_m,
                   Against against) const {
    return nearestOn(inSpace(from_map_m), inSpace(to_map_m), radius_m, against).free_m;
  }
  /// Whether all of a straight line in the plane was seen and nothing stands on it.
  bool isOpen(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) const {
    return isFree(inSpace(from_map_m), inSpace(to_map_m), resolution_m_, Against::kMapped);
  }

  /// The greatest answer: nothing is nearer.
  double reach_m(Against against = Against::kAnything) const;
  double resolution_m() const { return resolution_m_; }
  bool isPlane() const { return plane_; }
  /// Of a plane: the cells of the grid last read.
  const CellStates& states() const { return states_; }
  /// The box of what is known: beyond it nothing is free.
  Eigen::Vector3d min_map_m() const;
  Eigen::Vector3d max_map_m() const;

 private:
  /// Of a space only the first is used.
  struct Layer {
    DistanceField field;
    int reach_cells = 0;
    double reach_m = 0.0;
  };
  /// The nearest place of a line to what counts, or the first that is nearer than was enough.
  struct NearestPlace {
    double clearance_m = 0.0;
    double free_m = 0.0;  ///< Length of the line before the first place that is nearer than was enough.
  };

  Clearance(double resolution_m, bool plane, const Reach& reach, std::optional<double> hull_height_m);

  static Eigen::Vector3d inSpace(const Eigen::Vector2d& place_map_m) { return {place_map_m.x(), place_map_m.y(), 0.0}; }
  /// In the box of the field, or beyond it.
  common::VoxelIndex cellOf(const Eigen::Vector3d& place_map_m) const {
    const int x = numberOf(place_map_m.x()) - begin_.x, y = numberOf(place_map_m.y());
    if (plane_) return {x, 0, y - begin_.z};
    return {x, y - begin_.y, numberOf(place_map_m.z()) - begin_.z};
  }
  common::VoxelIndex inField(common::CellIndex cell) const { return {cell.x - begin_.x, 0, cell.y - begin_.z}; }
  /// std::floor is a call where the processor has no instruction for it.
  int numberOf(double coordinate_m) const {
    const double cells = coordinate_m * cells_per_m_;
    const int whole = static_cast<int>(cells);
    return whole - (whole > cells ? 1 : 0);
  }
  static bool counts(Against layer, Against against) {
    return (static_cast<unsigned>(layer) & static_cast<unsigned>(against)) != 0;
  }
  double at_m(common::VoxelIndex cell, Against against) const {
    const bool within = cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < end_.x - begin_.x &&
                        cell.y < end_.y - begin_.y && cell.z < end_.z - begin_.z;
    if (!within) return plane_ && !counts(Against::kUnseen, against) ? reach_m(against) : 0.0;
    if (!plane_) return at_m(layers_[0], cell);
    double least_m = kFar_m;
    if (counts(Against::kObstacles, against)) least_m = at_m(layers_[0], cell);
    if (counts(Against::kUnseen, against)) least_m = std::min(least_m, at_m(layers_[1], cell));
    if (counts(Against::kBarred, against)) least_m = std::min(least_m, at_m(layers_[2], cell));
    return least_m;
  }
  double at_m(const Layer& layer, common::VoxelIndex cell) const {
    return std::min(distances_m_[static_cast<std::size_t>(layer.field.squared(cell))], layer.reach_m);
  }
  const Layer& layerOf(Against layer) const {
    return layers_[layer == Against::kObstacles ? 0 : layer == Against::kUnseen ? 1 : 2];
  }
  NearestPlace nearestOn(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& to_map_m, double enough_m,
                         Against against) const;
  void reshape(const common::VoxelIndex& begin, const common::VoxelIndex& end);
  void updateBarred(const common::OccupancyGrid& grid, std::span<const common::Disc> discs,
                    std::span<const common::Polygon> keep_out);
  /// Around what is known, on each side of the field's box.
  int margin_cells() const { return plane_ ? CellStates::kTile : common::VoxelBlock::kSide; }

  static constexpr double kFar_m = 1e9;
  double resolution_m_, cells_per_m_;
  bool plane_;
  std::optional<int> half_height_cells_;
  common::VoxelIndex begin_, end_;   ///< Of the box of the field in cells of the map; a plane's y is along z.
  std::array<Layer, 3> layers_;      ///< In the order of the bits of Against.
  std::vector<double> distances_m_;  ///< By the squared distance in cells: a look-up is faster than a root.
  CellStates states_;                ///< Of a plane.
  common::VoxelMap voxels_;          ///< Of a space; kept for the identity of its blocks.
  std::vector<CellBox> barred_;      ///< Where people and zones were at the last update, in cells of the map.
};

}  // namespace swiftlet::planning
