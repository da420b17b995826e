// What every planner asks before it searches, and how it refuses.
#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/goal.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// The goal is one to fly to (common/goal.hpp, with no tolerance), the start is in the map and free or able to escape.
/// The chain returned ends at the cell where the search starts.
tl::expected<CellPath, PlanFailure> admit(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                          const Eigen::Vector2d& goal_map_m);
PlanFailure failureOf(const common::GoalRefusal& refusal);
PlanFailure unreachable(const CostMap& map, const Eigen::Vector2d& goal_map_m);

}  // namespace swiftlet::planning
