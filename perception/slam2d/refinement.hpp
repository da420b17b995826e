// The last look at a graph: key scans that see the same place on different passes are matched to each other, wherever
// the map has them close together, though nothing was uncertain enough for a loop to be sought.
#pragma once

#include <vector>

#include "perception/slam2d/loop_search.hpp"

namespace swiftlet::perception {

/// For each key scan at most one edge, from the nearest of the key scans of other passes to which it was matched.
std::vector<FoundLoop> matchPasses(const SlamGraph& graph, const Slam2dConfig& config);

}  // namespace swiftlet::perception
