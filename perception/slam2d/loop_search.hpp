// Loop search: finds the older key scans to which the newest ones may have come back, and verifies each match.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// An older key scan near which the vehicle may be again.
struct LoopCandidate {
  int key = 0;
  Eigen::Matrix3d covariance_map = Eigen::Matrix3d::Zero();  ///< Of its pose relative to the query, axes of the map.
  /// Standard deviation of its position along the larger axis.
  double sigma_m = 0.0;
};

/// The candidates for a loop closure at `query`, the nearest first, at some distance from one another. The projected
/// uncertainty of a candidate, as seen from `query`, exceeds `local_sigma_m`, so that the local match does not reach
/// it. It is also large enough that the candidate may be where the query is.
std::vector<LoopCandidate> loopCandidates(const SlamGraph& graph, int query, const Slam2dConfig& config);

/// A loop closure that a search has found.
struct FoundLoop {
  SlamEdge edge;         ///< From the candidate to the query.
  double quality = 0.0;  ///< Of the fine match, in [0, 1].
  /// Distance between the matched pose of the query and its estimate.
  double shift_m = 0.0;
};

/// Matches the newest scans to those around the candidate: a wide correlative search, then a fine match. Returns
/// nothing when the match is poor, does not fix the position in all directions or violates free space, or when a
/// distinct second place scores nearly as high (an ambiguous place, a corridor).
std::optional<FoundLoop> searchLoop(const SlamGraph& graph, int query, const LoopCandidate& candidate,
                                    const Slam2dConfig& config);

/// The covariance of an edge from that of its match. Adds a least variance (`edge_sigma_m`, `edge_sigma_deg`), because
/// neighbouring matches share a reference and their errors are not independent.
Eigen::Matrix3d edgeCovariance(const Eigen::Matrix3d& covariance, const Slam2dConfig& config);

}  // namespace swiftlet::perception
