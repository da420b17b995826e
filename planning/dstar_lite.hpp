// D* Lite, optimized version (Koenig and Likhachev 2002, figure 4), as Grzonka 2012, section IV-E, plans with: the search
// of the last plan is repaired where cells changed and when the vehicle has moved.
#pragma once

#include <cstdint>
#include <vector>

#include "planning/dstar_queue.hpp"
#include "planning/planner.hpp"

namespace swiftlet::planning {

/// 8-connected, no corner cut, integer costs, everything in arrays over the dense rectangle of the cost map. The same
/// goal cell keeps the search; another goal, resolution or vehicle starts anew. Costs are compared with those of the
/// last call, so any map may be given at any time. Costs must stay below 2^30: mazes of more than 80 km.
class DStarLite final : public Planner {
 public:
  [[nodiscard]] tl::expected<Path, PlanFailure> plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                     const Eigen::Vector2d& goal_map_m) override;

  /// The cost of the cell path of the last successful plan, from where the search started to the goal; for tests.
  std::int32_t searchCost() const { return search_cost_; }
  /// Vertices taken from the queue by the last plan.
  int expansions() const { return expansions_; }

 private:
  void restart(const CostMap& map, common::CellIndex goal);
  bool adopt(const CostMap& map);
  void repair(const CostMap& map);
  void moveStart(common::CellIndex start);
  void search(const CostMap& map);
  CellPath follow(const CostMap& map) const;

  std::int32_t heuristic(int index) const;
  DStarQueue::Key keyOf(int index) const;
  void updateVertex(int index);
  std::int32_t bestOver(const CostMap& map, int index) const;

  common::CellRect rect_;
  double resolution_m_ = 0.0;
  common::CellIndex goal_;
  common::CellIndex start_;
  int goal_index_ = -1;
  std::uint32_t key_offset_ = 0;  ///< k_m of the paper.
  std::vector<CostMap::Cost> cost_;
  std::vector<std::int16_t> height_cm_;
  std::vector<std::int32_t> g_;
  std::vector<std::int32_t> rhs_;
  DStarQueue queue_;
  std::int32_t search_cost_ = 0;
  int expansions_ = 0;
};

}  // namespace swiftlet::planning
