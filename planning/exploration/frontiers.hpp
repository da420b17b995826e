// Frontiers: free cells beside unknown ones (Yamauchi 1997), in connected runs that are cut into pieces that one
// viewpoint sees.
#pragma once

#include <vector>

#include "planning/costs/cost_map.hpp"

namespace swiftlet::planning {

/// A run of free cells that touch unknown ones, or a piece of it, ordered along its principal axis.
struct FrontierRun {
  std::vector<common::CellIndex> cells;
  double run_length_m = 0.0;  ///< Length of the whole run that it was cut from.
};

/// All frontiers, in a fixed order. A free cell counts when one of its four neighbours is unknown. Runs are
/// 8-connected. A run longer than `segment_m` is halved until no piece is longer.
std::vector<FrontierRun> findFrontiers(const CostMap& map, double segment_m);

/// An unknown cell beside a frontier cell; the frontier cell itself if there is none.
common::CellIndex unknownBeside(const CostMap& map, common::CellIndex frontier_cell);

}  // namespace swiftlet::planning
