// Finds where the newest key scans stand among older ones they may have come back to, and doubts what it finds.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// A place the vehicle may be at again.
struct LoopCandidate {
  int key = 0;
  Eigen::Matrix3d covariance_map = Eigen::Matrix3d::Zero();  ///< Relative to the query.
  double sigma_m = 0.0;
};

/// Key scans whose uncertainty, seen from `query`, is so large that the local match does not reach them, but not so
/// large that they cannot be where the query is; the nearest first, at some distance from one another.
std::vector<LoopCandidate> loopCandidates(const SlamGraph& graph, int query, const Slam2dConfig& config);

struct FoundLoop {
  SlamEdge edge;  ///< From the candidate to the query.
  double quality = 0.0;
  double shift_m = 0.0;
};

/// A wide correlative match of the newest scans to those around the candidate. Nothing when the best place is poor, or
/// when a distinct one is nearly as good (an ambiguous place, a corridor).
std::optional<FoundLoop> searchLoop(const SlamGraph& graph, int query, const LoopCandidate& candidate,
                                    const Slam2dConfig& config);

/// A floor under what the matcher believes of itself.
Eigen::Matrix3d edgeCovariance(const Eigen::Matrix3d& covariance, const Slam2dConfig& config);

}  // namespace swiftlet::perception
