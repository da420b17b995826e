// Paths that change their height: where something hangs over the path at the height of flight, the vehicle flies lower.
//
//   at the height of flight  o----o                 o----> goal
//                                 |    beam         |
//   lower                         o-----------------o
//
// The height is changed on the spot, at places where the hull fits at both heights.
#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "planning/costs/cost_map.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// Where the vehicle's centre may be at two heights. Both cost maps have the same rectangle of cells.
struct TwoHeights {
  CostMap upper;  ///< At the height of flight.
  CostMap lower;
  double lower_height_m = 0.0;  ///< Over the take-off floor.
};

/// The cheapest path (exact on the cells, with a metre at the lower height half as expensive again, so that the vehicle
/// rises as soon as it may). It ends at the height of flight where the goal is free there, otherwise at the lower one.
/// Path::lowered says which of its lines are flown lower. `starts_lower`: the vehicle is at the lower height. A change
/// of height costs as much as `change_cost_m` of open space.
[[nodiscard]] tl::expected<Path, PlanFailure> planAtTwoHeights(const TwoHeights& maps,
                                                               const Eigen::Vector2d& start_map_m,
                                                               const Eigen::Vector2d& goal_map_m, bool starts_lower,
                                                               double change_cost_m);

}  // namespace swiftlet::planning
