// Path planning over a cost map: the interface, and what every planner shares: leaving a start that was pushed into the
// inflated zone, refusing with a reason, and turning a chain of cells into a path that a quadrotor flies well.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A polyline for the vehicle's centre, from the start to the goal, both exactly as asked, in the `map` frame.
struct Path {
  std::vector<Eigen::Vector2d> points_map_m;  ///< At least two, or one when start and goal coincide.
  double length_m = 0.0;
  double cost_m = 0.0;  ///< Its length in metres of open space: the integral of the cost, 1 where nothing is near.
};

struct PlanFailure {
  enum class Reason { kStartBlocked, kGoalBlocked, kGoalUnseen, kUnreachable, kOutsideMap };
  Reason reason = Reason::kUnreachable;
  std::string text;  ///< For people, with values.
  /// Where the centre may be, nearest to a blocked goal; none when there is no such place within 3 m.
  std::optional<Eigen::Vector2d> nearest_free_map_m;
};
const char* toString(PlanFailure::Reason reason);

/// Plans are functions of their arguments; a planner may keep its last search to answer the next call faster.
/// One thread at a time.
class Planner {
 public:
  virtual ~Planner() = default;
  [[nodiscard]] virtual tl::expected<Path, PlanFailure> plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                             const Eigen::Vector2d& goal_map_m) = 0;
  /// "D* Lite".
  virtual const char* name() const = 0;
};

/// A chain of cells, each an 8-neighbour of the one before it.
using CellPath = std::vector<common::CellIndex>;

/// The way from a start out of the lethal zone to the first cell where the centre may be: the cheapest chain that
/// avoids what is occupied, within `reach_m`; the start alone when it is not lethal; none when it is shut in.
std::optional<CellPath> escapeFrom(const CostMap& map, common::CellIndex start, double reach_m = 1.0);

/// The way that would be taken if what blocks it were gone: its last cell before the first lethal one, and that one.
/// None when the start is shut in, when nothing blocks the way, or when there would be none even then.
struct BlockedWay {
  common::CellIndex last_free, first_lethal;
};
std::optional<BlockedWay> blockedWay(const CostMap& map, common::CellIndex start, common::CellIndex goal);

/// The place nearest to a point that lies in such a cell, within `reach_m`.
std::optional<Eigen::Vector2d> nearestPlace(const CostMap& map, const Eigen::Vector2d& point_map_m, double reach_m,
                                            const std::function<bool(common::CellIndex)>& isSuch);
/// The place nearest to a point where the centre may be, within `reach_m`.
std::optional<Eigen::Vector2d> nearestFree(const CostMap& map, const Eigen::Vector2d& point_map_m,
                                           double reach_m = 3.0);

/// Integral of the cost over a segment in metres of open space, steps of the surface included, and the greatest cell
/// cost met. `lethal` when it touches a lethal cell.
struct SegmentCost {
  double cost_m = 0.0;
  CostMap::Cost greatest = 0;
  bool lethal = false;
};
SegmentCost segmentCost(const CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m);

/// The cells as a polyline with line-of-sight shortcuts. A shortcut is taken only when it neither costs more than what
/// it replaces nor meets a dearer cell, so that the risk never rises. The first `escape_cells` stay as they are.
Path shortened(const CostMap& map, const CellPath& cells, std::size_t escape_cells, const Eigen::Vector2d& start_map_m,
               const Eigen::Vector2d& goal_map_m);

}  // namespace swiftlet::planning
