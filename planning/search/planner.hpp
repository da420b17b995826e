// Path planning over a cost map: the interface, and what all planners share: escape from a start inside the inflated
// zone, refusal with a reason, and conversion of a chain of cells into a path that a quadrotor flies well.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A polyline for the vehicle's centre in the `map` frame, from exactly the given start to exactly the given goal.
struct Path {
  std::vector<Eigen::Vector2d> points_map_m;  ///< At least two, or one when start and goal coincide.
  double length_m = 0.0;
  double cost_m = 0.0;  ///< Equivalent length in open space: the integral of the cost, which is 1 there.
  /// Number of points after the start that are the escape: the lines up to them may lead through the lethal zone.
  std::size_t escape_points = 0;
  /// Of each point over the take-off floor, for a path in space; empty: all of it is at the height of flight. Where the
  /// height changes on the spot, a place is there twice.
  std::vector<double> heights_m = {};

  bool isInSpace() const { return !heights_m.empty(); }
};

/// Why there is no path.
struct PlanFailure {
  enum class Reason { kStartBlocked, kGoalBlocked, kGoalUnseen, kGoalKeptOut, kUnreachable, kOutsideMap };
  Reason reason = Reason::kUnreachable;
  std::string text;  ///< For people, with values.
  /// The place nearest to a blocked goal where the centre may be; nullopt when there is no such place within 3 m.
  std::optional<Eigen::Vector2d> nearest_free_map_m;
};

/// The plan depends on the arguments only. A planner may keep its last search to answer the next call faster. Not
/// thread-safe.
class Planner {
 public:
  virtual ~Planner() = default;
  [[nodiscard]] virtual tl::expected<Path, PlanFailure> plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                             const Eigen::Vector2d& goal_map_m) = 0;
  /// For people, such as "D* Lite".
  virtual const char* name() const = 0;
};

/// A chain of cells, each an 8-neighbour of the one before it.
using CellPath = std::vector<common::CellIndex>;

/// The escape from a start in the lethal zone: the cheapest chain of cells to the first one where the centre may be,
/// within `reach_m`; out of a keep-out zone it may be longer. It avoids occupied cells. A pocket of passable cells from
/// which no path leads farther than that counts as lethal if there is a way out with half of the clearance: in a narrow
/// place single cells, or those that the vehicle's own trail makes passable, may touch no others. The escape is the
/// start alone when that is not lethal, and nullopt when there is no such chain.
std::optional<CellPath> escapeFrom(const CostMap& map, common::CellIndex start, double reach_m = 1.0);
/// The path of escapeFrom() as points: the start itself and the centres of the cells after it. The start alone when
/// there is no escape.
std::vector<Eigen::Vector2d> escapePoints_map_m(const CostMap& map, const Eigen::Vector2d& start_map_m);

/// Where the path to a goal is blocked. Of the path that would be taken without the obstruction: the first lethal cell,
/// and the last one before it with room to stop (Footprint::stopRadius_m), or else the one just before it.
struct BlockedPath {
  common::CellIndex outlook, first_lethal;
};
/// Returns nullopt when the start cannot escape, when nothing blocks the path, or when there is no path even without
/// the obstruction.
std::optional<BlockedPath> blockedPath(const CostMap& map, common::CellIndex start, common::CellIndex goal);

/// The place nearest to a point, within `reach_m`, that lies in a cell with isSuch(cell).
std::optional<Eigen::Vector2d> nearestPlace(const CostMap& map, const Eigen::Vector2d& point_map_m, double reach_m,
                                            const std::function<bool(common::CellIndex)>& isSuch);
/// The place nearest to a point where the centre may be, within `reach_m`.
std::optional<Eigen::Vector2d> nearestFree(const CostMap& map, const Eigen::Vector2d& point_map_m,
                                           double reach_m = 3.0);

/// The cost of a segment: the integral of the cost in metres of open space, with the steps of the surface below, and
/// the greatest cell cost met. `lethal`: it touches a lethal cell.
struct SegmentCost {
  double cost_m = 0.0;
  CostMap::Cost greatest = 0;
  bool lethal = false;
};
SegmentCost segmentCost(const CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m);

/// The path over these points, with its length and cost: the escape costs its length, the rest the cost of the map.
Path pathThrough(const CostMap& map, std::vector<Eigen::Vector2d> points_map_m, std::size_t escape_points);

/// The cells as a polyline with line-of-sight shortcuts. A shortcut may neither cost more than what it replaces nor
/// meet a more expensive cell, so that the risk never rises. The first `escape_cells` cells are kept as they are.
Path shortened(const CostMap& map, const CellPath& cells, std::size_t escape_cells, const Eigen::Vector2d& start_map_m,
               const Eigen::Vector2d& goal_map_m);

}  // namespace swiftlet::planning
