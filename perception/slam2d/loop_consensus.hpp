// Which loop closures of a graph are accepted, new and old ones: those that agree with each other once the graph is
// optimized. Pure functions; private to slam2d.
#pragma once

#include <optional>
#include <vector>

#include "perception/slam2d/loop_search.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

struct LoopConsensus {
  std::vector<common::Pose2> T_map_key;
  std::vector<FoundLoop> accepted, refused;
  std::vector<int> rejected_edges;  ///< Edges of the graph, ascending.
};

/// Optimizes the graph, and rejects the closure that fits worst, new or old, until all that remain fit.
LoopConsensus optimizeWithRejection(const SlamGraph& graph, const std::vector<FoundLoop>& loops,
                                    const Slam2dConfig& config);

/// Closures that are rejected one by one may be right and the graph wrong: it may have closed a loop at a wrong place
/// of a corridor. This takes the rejected closures for certain and every other edge between two passes for uncertain.
/// The rejected closures win when more of them agree than edges of the graph contradict them.
std::optional<LoopConsensus> consensusOfRejected(const SlamGraph& graph, const std::vector<FoundLoop>& rejected,
                                                 const Slam2dConfig& config);

}  // namespace swiftlet::perception
