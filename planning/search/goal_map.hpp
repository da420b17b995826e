// The cost map as the GoalMap by which goals are judged (common/goal.hpp).
#pragma once

#include <memory>

#include "common/goal.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A view: the cost map must outlive it. At the clearance that the cost map was made for, a place is free exactly where
/// the planners may go, or could without the people there: people move on, and an assumed person may be none. At
/// a smaller clearance only obstacles count. At a greater one, obstacles farther than CostMap::reach_m() are ignored. A
/// goal accepted too easily in these cases is refused later by the planner.
class CostGoalMap final : public common::GoalMap {
 public:
  explicit CostGoalMap(const CostMap& map) : map_(map) {}
  common::PlaceState stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const override;
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                             double clearance_m) const override;

 private:
  const CostMap& map_;
};

/// A CostGoalMap that shares ownership of the cost map. Null for null.
std::shared_ptr<const common::GoalMap> goalMapOf(std::shared_ptr<const CostMap> map);

}  // namespace swiftlet::planning
