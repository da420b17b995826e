// Where the known world ends: free cells beside unknown ones (Yamauchi 1997), in connected runs cut into pieces that
// one viewpoint sees.
#pragma once

#include <vector>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A run of free cells that touch unknown ones, ordered along its greater axis.
struct FrontierRun {
  std::vector<common::CellIndex> cells;
  double run_length_m = 0.0;  ///< Of the whole run it was cut from.
};

/// All of them, in a fixed order. A free cell counts when one of its four neighbours is unknown; runs connect over
/// eight; a run longer than `segment_m` is cut into equal pieces.
std::vector<FrontierRun> findFrontiers(const CostMap& map, double segment_m);

/// An unknown cell beside a frontier cell.
common::CellIndex unknownBeside(const CostMap& map, common::CellIndex frontier_cell);

}  // namespace swiftlet::planning
