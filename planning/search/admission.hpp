// The checks that every planner makes before it searches, and the failures it reports.
#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/goal.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// Checks that the goal may be flown to (common/goal.hpp, with no tolerance), and that the start is inside the map and
/// free or able to escape. Returns the chain of cells from the start to the cell where the search begins.
tl::expected<CellPath, PlanFailure> admit(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                          const Eigen::Vector2d& goal_map_m);
/// The failure for a goal that was refused.
PlanFailure failureOf(const common::GoalRefusal& refusal);
/// The failure for a goal to which there is no path.
PlanFailure unreachable(const CostMap& map, const Eigen::Vector2d& goal_map_m);

}  // namespace swiftlet::planning
