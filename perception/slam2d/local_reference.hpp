// The local reference: the key scans that a new scan is matched to, drawn in the map frame.
#pragma once

#include <vector>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// Key scans near T_map_body (`local_radius_m`) whose projected uncertainty from `anchor` is at most `local_sigma_m`.
/// In ascending order.
std::vector<int> connectedKeys(const SlamGraph& graph, int anchor, const common::Pose2& T_map_body,
                               const Slam2dConfig& config);

/// Of `connected`, one key scan per view, and the anchor. The oldest key scan of each view is chosen, because it
/// carries the least drift. At most ten, those nearest to T_map_body. In ascending order.
std::vector<int> localReferenceKeys(const SlamGraph& graph, const std::vector<int>& connected, int anchor,
                                    const common::Pose2& T_map_body);

/// Matches scans to a set of key scans. The drawing is kept between matches: new key scans are added to it, and it is
/// redrawn only when a key scan has left the set or has moved.
class LocalReference {
 public:
  explicit LocalReference(const CorrelativeMatcherConfig& config) : matcher_(config) {}

  /// Matches `scan` to the key scans `keys` (ascending) of `graph`. Guess and result are the pose of the scan in the
  /// map.
  MatchResult match(const SlamGraph& graph, const std::vector<int>& keys, const ProjectedScan& scan,
                    const common::Pose2& guess_T_map_body, const SearchWindow& window);
  /// Call when the poses of key scans have changed.
  void invalidate() { drawn_.clear(); }

 private:
  CorrelativeMatcher matcher_;
  std::vector<int> drawn_;
};

}  // namespace swiftlet::perception
