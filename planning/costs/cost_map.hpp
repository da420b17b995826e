// Where the vehicle's centre may be and what it costs to be there: the occupancy grid dilated by the hull and its
// clearance (Saeedi, section III-F), with a cost that falls with the distance to the closest obstacle, so that paths
// keep to the middle of passages, and a price on steps of the surface below (Grzonka 2012, section IV-E).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/disc.hpp"
#include "common/level_map.hpp"
#include "common/occupancy_grid.hpp"
#include "common/place_names.hpp"
#include "common/polygon.hpp"
#include "planning/costs/cell_state.hpp"

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
/// value: copy it to give a job a snapshot. Reading is safe from any thread while the object is not updated. Distances
/// are from cell centre to cell centre and are exact up to the reach of the cost.
class CostMap {
 public:
  struct Config {
    static constexpr double comfort_distance_m =
        0.60;  ///< Distance beyond the clearance at which an obstacle no longer raises the cost.
    double comfort_weight = 4.0;
    bool pass_unknown = false;  ///< Whether paths may lead where nothing is known.
    static constexpr double unknown_gap_m =
        0.10;                         ///< Unknown slivers up to this width between free cells count as free.
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

  /// Updates the map to the given grid. Costs are recomputed only around cells whose state changed since the last call
  /// (tiles with the same identity are not read), unless the footprint changed. The result always equals that of a
  /// fresh map. `grid` is a snapshot that is not written to any more (OccupancyGrid::snapshot()), of the constructor's
  /// resolution; a copy of it (with shared tiles) is kept. The reach is radius plus comfort distance, at most
  /// kMaxReachCells cells.
  void update(const common::OccupancyGrid& grid, const Footprint& footprint, const CostLayers& layers = {});

  /// How the texts of a failed plan name places.
  void name(const common::PlaceNames& names) { names_ = names; }
  const common::PlaceNames& names() const { return names_; }

  const Footprint& footprint() const { return footprint_; }
  double resolution_m() const { return grid_.resolution_m(); }

  // Cells. Indices into the dense rectangle run row by row; the outermost cells are lethal, so that the eight
  // neighbours of a cell that is not lethal always exist.
  const common::CellRect& rect() const { return rect_; }
  int stride() const { return rect_.width(); }
  std::size_t size() const { return cost_.size(); }
  bool contains(common::CellIndex c) const { return rect_.contains(c); }
  int indexOf(common::CellIndex c) const { return (c.y - rect_.begin.y) * stride() + (c.x - rect_.begin.x); }
  common::CellIndex cellOf(int index) const {
    return {rect_.begin.x + index % stride(), rect_.begin.y + index / stride()};
  }
  common::CellIndex cellAt(const Eigen::Vector2d& point_map_m) const { return grid_.cellAt(point_map_m); }
  Eigen::Vector2d centerOf(common::CellIndex c) const { return grid_.centerOf(c); }

  Cost cost(int index) const { return cost_[static_cast<std::size_t>(index)]; }
  Cost costAt(common::CellIndex c) const { return contains(c) ? cost(indexOf(c)) : kLethal; }
  bool isLethal(int index) const { return cost(index) == kLethal; }
  /// Also outside of the map.
  bool isLethalAt(const Eigen::Vector2d& point_map_m) const { return costAt(cellAt(point_map_m)) == kLethal; }
  CellState state(int index) const { return state_[static_cast<std::size_t>(index)]; }
  CellState stateAt(common::CellIndex c) const { return contains(c) ? state(indexOf(c)) : CellState::kUnknown; }
  /// The hull with its clearance would reach into a keep-out zone there.
  bool isKeptOut(int index) const { return !kept_out_.empty() && kept_out_[static_cast<std::size_t>(index)] != 0; }
  /// Only a disc of CostLayers makes it lethal.
  bool isLethalByDisc(int index) const { return !by_disc_.empty() && by_disc_[static_cast<std::size_t>(index)] != 0; }
  const std::vector<Cost>& costs() const { return cost_; }
  const std::vector<CellState>& states() const { return state_; }
  /// Height of the surface below in cm; empty if there are no levels.
  const std::vector<std::int16_t>& heights_cm() const { return height_cm_; }

  /// Distance from the centre of the cell to that of the nearest occupied cell of the grid; discs are not counted. At
  /// most reach_m(), which is also the answer if nothing is near and outside the map.
  double obstacleDistance_m(common::CellIndex c) const;
  /// Far enough from obstacles for a vehicle that stops there (Footprint::stopRadius_m).
  bool hasRoomToStop(common::CellIndex c) const { return obstacleDistance_m(c) >= footprint().stopRadius_m(); }
  double reach_m() const { return reach_cells_ * resolution_m(); }

  /// The cost of moving between two 8-neighbours, neither of them lethal. A diagonal is forbidden (kNoEdge) if one of
  /// the two cells beside it is lethal, so no corner is cut.
  static constexpr std::int32_t kNoEdge = INT32_MAX;
  std::int32_t edgeCost(int from, int dx, int dy) const {
    const int to = from + dy * stride() + dx;
    const bool diagonal = dx != 0 && dy != 0;
    if (isLethal(to) || (diagonal && (isLethal(from + dx) || isLethal(from + dy * stride())))) return kNoEdge;
    return (diagonal ? kDiagonalEdge : kStraightEdge) * (cost(from) + cost(to)) + stepCost(from, to);
  }
  /// The cost that a step of the surface between two cells adds; 0 without levels.
  std::int32_t stepCost(int from, int to) const {
    if (height_cm_.empty()) return 0;
    return height_edge_ *
           std::abs(height_cm_[static_cast<std::size_t>(from)] - height_cm_[static_cast<std::size_t>(to)]);
  }
  std::int32_t stepCostPerCm() const { return height_edge_; }
  /// The greatest possible cost of an edge with this config.
  std::int32_t maxEdgeCost() const { return max_edge_cost_; }

 private:
  struct Changes;
  void reshape(const common::CellRect& rect, const Footprint& footprint);
  void readTiles(const common::OccupancyGrid& grid, bool all, Changes& changes);
  void closeSlivers(Changes& changes);
  void updateDistances(const Changes& changes, bool all);
  void costTile(int x0, int y0);
  void applyLayers(const CostLayers& layers);
  void closeBorder();
  void applyFlown(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m);
  void applyDisc(const common::Disc& disc);
  void applyKeepOut(const common::Polygon& zone);
  void applyHeights(const common::LevelMap* levels);
  Cost costOfMargin(double margin_m) const;

  Config config_;
  common::OccupancyGrid grid_;  ///< The snapshot last read, for the identity of its tiles.
  Footprint footprint_{-1.0, -1.0};
  common::PlaceNames names_;
  common::CellRect rect_;
  int reach_cells_ = 0;
  int unknown_reach_cells_ = 0;
  std::int32_t max_edge_cost_ = 0;
  std::int32_t height_edge_ = 0;  ///< Edge cost of a step of 1 cm.
  std::vector<CellState> raw_;    ///< States as in the grid.
  std::vector<CellState> state_;  ///< States with the unknown slivers closed.
  /// Squared distance in cells to the nearest occupied cell, cut at (reach + 1) squared.
  std::vector<std::int16_t> occupied_distance2_;
  std::vector<std::int16_t> unknown_distance2_;
  std::vector<Cost> margin_cost_;  ///< Cost by occupied distance squared.
  std::vector<Cost> static_cost_;  ///< Cost from the grid only.
  std::vector<Cost> cost_;         ///< Cost with the layers.
  std::vector<std::int16_t> height_cm_;
  std::vector<std::uint8_t> kept_out_;  ///< 1 in keep-out zones; empty without any.
  std::vector<std::uint8_t> by_disc_;   ///< 1 where only a disc is lethal; empty without any.
};

}  // namespace swiftlet::planning
