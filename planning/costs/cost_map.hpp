// Where the vehicle's centre may be and what it costs to be there: the occupancy grid dilated by the hull and its
// clearance (Saeedi, section III-F), with a cost that falls with the distance to the closest obstacle, so that paths
// keep to the middle of passages, and a price on steps of the surface below (Grzonka 2012, section IV-E).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/disc.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "planning/clearance/clearance.hpp"
#include "planning/costs/surface_steps.hpp"

namespace swiftlet::planning {

/// The body that must fit through passages: the hull, an upright cylinder, and the clearance between it and occupied
/// cells.
struct Footprint {
  double hull_radius_m = 0.275;
  double clearance_m = 0.10;
  double radius_m() const { return hull_radius_m + clearance_m; }
  /// From an obstacle to the middle of a hull that stops there: gusts move it by about as much as it is clear.
  double stopRadius_m() const { return radius_m() + 0.10; }
};

/// The layers over the grid. Pointers may be null and are read during the call only.
struct CostLayers {
  /// Obstacles that are not in the grid: people, and places where an attempt failed.
  std::span<const common::Disc> discs;
  const common::LevelMap* levels = nullptr;
  /// The flown trail, in order, in the `map` frame. Near it half the clearance is enough, so that a door that the
  /// vehicle has passed stays open even if its frame grows by a cell in the map.
  std::span<const Eigen::Vector2d> flown_map_m = {};
  /// Sound polygons (common::problemOf) that the hull and its clearance stay out of, also where they were flown before.
  std::span<const common::Polygon> keep_out = {};
};

/// A dense copy of the grid's extent plus one tile of margin, in the `map` frame, on the grid's own cells. It is a
/// value: copy it to give a job a snapshot. Reading is safe from any thread while the object is not updated.
class CostMap {
 public:
  struct Config {
    double comfort_weight = 4.0;
    double height_step_weight = 2.0;  ///< Metres of detour that one metre of step of the surface is worth.

    void describe(common::config::Fields& fields);
  };

  using Cost = std::uint16_t;
  static constexpr Cost kOpenCost = 8;      ///< Cost of a cell far from everything.
  static constexpr Cost kLethal = 0xFFFF;   ///< The centre may not be there.
  static constexpr int kStraightEdge = 12;  ///< Edge cost = this times the sum of the two cell costs.
  static constexpr int kDiagonalEdge = 17;  ///< 17 / 12 is the square root of 2 within 0.2 %.
  static constexpr std::int32_t kStraightMin = 2 * kStraightEdge * kOpenCost;  ///< The cheapest possible edge.

  /// A map that is lethal everywhere. `config` is validated.
  CostMap(const Config& config, double resolution_m);

  /// Updates the map to the given grid, a snapshot as CellStates::update asks for. Costs are recomputed only around
  /// cells whose state changed since the last call, unless the footprint changed. The result always equals that of a
  /// fresh map.
  void update(const common::OccupancyGrid& grid, const Footprint& footprint, const CostLayers& layers = {});

  /// How the texts of a failed plan name places.
  void name(const common::PlaceNames& names) { names_ = names; }
  const common::PlaceNames& names() const { return names_; }

  const Footprint& footprint() const { return footprint_; }
  /// How far a place is from what the layers have: exact up to the reach of the cost, radius plus comfort distance, and
  /// from the unknown up to the radius.
  const Clearance& clearance() const { return clearance_; }
  const CellStates& states() const { return clearance_.states(); }
  const SurfaceSteps& steps() const { return steps_; }
  double resolution_m() const { return clearance_.resolution_m(); }

  // Cells. Indices into the dense rectangle run row by row; the outermost cells are lethal, so that the eight
  // neighbours of a cell that is not lethal always exist.
  const common::CellRect& rect() const { return states().rect(); }
  int indexOf(common::CellIndex c) const { return states().indexOf(c); }
  common::CellIndex cellOf(int index) const {
    return {rect().begin.x + index % rect().width(), rect().begin.y + index / rect().width()};
  }
  common::CellIndex cellAt(const Eigen::Vector2d& point_map_m) const { return states().grid().cellAt(point_map_m); }
  Eigen::Vector2d centerOf(common::CellIndex c) const { return states().grid().centerOf(c); }

  const std::vector<Cost>& costs() const { return cost_; }
  Cost costAt(common::CellIndex c) const {
    return rect().contains(c) ? cost_[static_cast<std::size_t>(indexOf(c))] : kLethal;
  }
  /// The greatest cost of a cell that is not lethal.
  Cost greatestCost() const { return costOfMargin(0.0); }
  bool isLethal(int index) const { return cost_[static_cast<std::size_t>(index)] == kLethal; }
  /// The hull with its clearance would reach into a keep-out zone there.
  bool isKeptOut(int index) const { return !kept_out_.empty() && kept_out_[static_cast<std::size_t>(index)] != 0; }
  /// Only a disc of CostLayers makes it lethal.
  bool isLethalByDisc(int index) const { return !by_disc_.empty() && by_disc_[static_cast<std::size_t>(index)] != 0; }

  /// Of the cost: an obstacle that is farther does not raise it.
  double reach_m() const { return clearance_.reach_m(Against::kObstacles); }

 private:
  void reshape();
  void costBox(const CellBox& box);
  void applyLayers(const CostLayers& layers);
  void closeBorder();
  void applyFlown(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m);
  void applyDisc(const common::Disc& disc);
  void applyKeepOut(const common::Polygon& zone);
  Cost costOfMargin(double margin_m) const;

  Config config_;
  Clearance clearance_;
  Footprint footprint_{-1.0, -1.0};
  common::PlaceNames names_;
  std::vector<Cost> margin_cost_;  ///< Cost by the distance to an obstacle, squared and in cells.
  std::vector<Cost> static_cost_;  ///< Cost from the grid only.
  std::vector<Cost> cost_;         ///< Cost with the layers.
  SurfaceSteps steps_;
  std::vector<std::uint8_t> kept_out_;  ///< 1 in keep-out zones; empty without any.
  std::vector<std::uint8_t> by_disc_;   ///< 1 where only a disc is lethal; empty without any.
};

/// Whether the centre may not be at a point; true outside of the map.
inline bool isLethalAt(const CostMap& map, const Eigen::Vector2d& point_map_m) {
  return map.costAt(map.cellAt(point_map_m)) == CostMap::kLethal;
}

/// Whether the hull fits along a straight line, with its clearance from all that stands there.
bool isFree(const CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m);

/// Far enough from obstacles for a vehicle that stops there (Footprint::stopRadius_m).
inline bool hasRoomToStop(const CostMap& map, common::CellIndex cell) {
  return map.clearance().at_m(cell, Against::kObstacles) >= map.footprint().stopRadius_m();
}

}  // namespace swiftlet::planning
