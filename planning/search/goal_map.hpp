// The cost map as goals are judged by it (common/goal.hpp).
#pragma once

#include <memory>

#include "common/goal.hpp"
#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A view: the cost map must outlive it. At the clearance the cost map was made for, a place is free exactly where the
/// planners may go. At a smaller one only obstacles count, at a greater one obstacles farther than CostMap::reach_m()
/// are not seen; what is accepted too easily there the planner refuses later.
class CostGoalMap final : public common::GoalMap {
 public:
  explicit CostGoalMap(const CostMap& map) : map_(map) {}
  common::PlaceState stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const override;
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                             double clearance_m) const override;

 private:
  const CostMap& map_;
};

/// The same, which keeps the cost map. Null for null.
std::shared_ptr<const common::GoalMap> goalMapOf(std::shared_ptr<const CostMap> map);

}  // namespace swiftlet::planning
