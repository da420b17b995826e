// Decides which loop closures of a graph are accepted, new and old ones: those that are consistent with each other
// after optimization. Pure functions; private to slam2d.
#pragma once

#include <optional>
#include <vector>

#include "perception/slam2d/loop_search.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// The result of a decision.
struct LoopConsensus {
  /// Optimized poses of all key scans.
  std::vector<common::Pose2> T_map_key;
  /// The new closures, by decision.
  std::vector<FoundLoop> accepted, refused;
  std::vector<int> rejected_edges;  ///< Indices of edges of the graph, ascending.
};

/// Optimizes the graph with new loop closures. While a closure, new or old, has an error above four standard
/// deviations, rejects the one with the greatest error and optimizes again.
LoopConsensus optimizeWithRejection(const SlamGraph& graph, const std::vector<FoundLoop>& loops,
                                    const Slam2dConfig& config);

/// Tests whether the rejected closures are right and the graph is wrong, for example because it has closed a loop at a
/// wrong place of a corridor. Optimizes with the rejected closures at full weight and with a robust kernel on every
/// other edge between two passes, and removes the edges that do not fit.
/// Returns the result when at least three rejected closures agree, and more of them agree than edges of the graph had
/// to be removed; otherwise nothing.
std::optional<LoopConsensus> consensusOfRejected(const SlamGraph& graph, const std::vector<FoundLoop>& rejected,
                                                 const Slam2dConfig& config);

}  // namespace swiftlet::perception
