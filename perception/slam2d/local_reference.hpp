// The key scans a new one is matched to, drawn in the map frame.
#pragma once

#include <vector>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/slam2d/slam_config.hpp"
#include "perception/slam2d/slam_graph.hpp"

namespace swiftlet::perception {

/// Key scans around T_map_body that are connected to `anchor`, in ascending order.
std::vector<int> connectedKeys(const SlamGraph& graph, int anchor, const common::Pose2& T_map_body,
                               const Slam2dConfig& config);

/// Of `connected`, the oldest of each view, since they carry no later drift, and the anchor. In ascending order.
std::vector<int> localReferenceKeys(const SlamGraph& graph, const std::vector<int>& connected, int anchor,
                                    const common::Pose2& T_map_body, const Slam2dConfig& config);

/// Keeps what is drawn between matches; draws anew only when a key scan left the reference or moved.
class LocalReference {
 public:
  explicit LocalReference(const CorrelativeMatcherConfig& config) : matcher_(config) {}

  /// The pose is that of the scan in the map.
  MatchResult match(const SlamGraph& graph, const std::vector<int>& keys, const ProjectedScan& scan,
                    const common::Pose2& guess_T_map_body, const SearchWindow& window);
  /// The poses of the key scans changed.
  void invalidate() { drawn_.clear(); }

 private:
  CorrelativeMatcher matcher_;
  std::vector<int> drawn_;
};

}  // namespace swiftlet::perception
