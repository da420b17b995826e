// What a finished map misses that contradicts itself: the loop closures between the stretches that disagree. The drift
// along a bare corridor can be greater than its uncertainty says, and then no loop search reaches the place.
#pragma once

#include <vector>

#include "perception/slam2d/loop_search.hpp"
#include "perception/slam2d/map_judgement.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// The judgement of the key scans at these poses.
MapJudgement judgeMap(const SlamGraph& graph, const std::vector<common::Pose2>& T_map_key);

/// Closures between the stretches that contradict each other, searched for farther than their uncertainty reaches. They
/// are only as good as each match: the graph decides which agree, and the map whether they made it better. Pure.
std::vector<FoundLoop> loopsWhereContradicting(const SlamGraph& graph, const MapJudgement& judgement,
                                               const Slam2dConfig& config);

}  // namespace swiftlet::perception
