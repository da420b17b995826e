// The wavefront planner (Saeedi, section III-F). It computes the cost of reaching every cell from one cell, optimal and
// without local minima. Exploration uses these costs as distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// The least cost from a source cell to every cell that it reaches; exact (equal to Dijkstra). Cells wait in buckets as
/// wide as the cheapest edge. Cells in one bucket cannot improve each other, so no heap is needed.
class CostField {
 public:
  static constexpr std::int32_t kUnreached = INT32_MAX;

  /// Computes the costs from `source` (not lethal) until every reachable cell is settled or, if given, `until` is.
  void spread(const CostMap& map, common::CellIndex source, std::optional<common::CellIndex> until = std::nullopt);

  std::int32_t at(int index) const { return cost_[static_cast<std::size_t>(index)]; }
  bool reached(int index) const { return at(index) != kUnreached; }
  /// The cost of a reached cell in metres of open space.
  double cost_m(int index, double resolution_m) const { return at(index) * (resolution_m / CostMap::kStraightMin); }
  /// Cells that the last spread settled.
  std::size_t settled() const { return settled_; }
  /// The cells of the cheapest path from the source to a reached cell.
  CellPath pathTo(const CostMap& map, common::CellIndex target) const;

 private:
  std::vector<std::int32_t> cost_;
  std::vector<std::uint8_t> from_;  ///< Direction of the last step to each cell.
  std::vector<std::vector<std::int32_t>> buckets_;
  std::size_t settled_ = 0;
};

class Wavefront final : public Planner {
 public:
  [[nodiscard]] tl::expected<Path, PlanFailure> plan(const CostMap& map, const Eigen::Vector2d& start_map_m,
                                                     const Eigen::Vector2d& goal_map_m) override;
  const char* name() const override { return "wavefront"; }
  std::int32_t searchCost() const { return search_cost_; }
  /// Cells that the last search settled.
  std::size_t settled() const { return field_.settled(); }

 private:
  CostField field_;
  std::int32_t search_cost_ = 0;
};

}  // namespace swiftlet::planning
