// What it costs to fly from any place to many others: the cost map in coarse cells, for tours through many places.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planning/costs/cost_map.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {

/// Cells of about 0.2 m, each as cheap as its cheapest cell of the map that the vehicle reaches. What is lethal around
/// a wall is wider than the hull, and so than two coarse cells: no coarse path leads through a wall. Not thread-safe.
class CoarseCosts {
 public:
  /// `from_vehicle` was spread over the whole of `map`. Neither is kept.
  CoarseCosts(const CostMap& map, const CostField& from_vehicle);

  /// The costs from one place to each of the others, in metres of open space; infinite where no coarse path leads. The
  /// places are cells of the map.
  std::vector<double> between_m(common::CellIndex from, std::span<const common::CellIndex> to);

 private:
  int coarseOf(common::CellIndex cell) const;

  common::CellRect rect_;  ///< Of the map.
  int side_ = 1;           ///< Of a coarse cell, in cells of the map.
  double coarse_m_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<CostMap::Cost> cost_;  ///< Lethal where nothing is reached.
  std::vector<std::int32_t> spent_;  ///< Of the last search, as edges cost there.
};

}  // namespace swiftlet::planning
