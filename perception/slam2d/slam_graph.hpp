// The graph of key scans, and the projection of uncertainty along it.
#pragma once

#include <cstdlib>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "optimization/pose_graph_2d.hpp"
#include "perception/projection/scan_projection.hpp"
#include "perception/slam2d/slam_edge.hpp"
#include "perception/slam2d/sliced_map.hpp"

namespace swiftlet::perception {

/// A drawn scan and its pose in the level frame of its key scan.
struct AttachedScan {
  std::shared_ptr<const DrawnScan> scan;
  common::Pose2 T_key_body;
  std::vector<Eigen::Vector2d> gone_key_m = {};  ///< Places from which something had gone with this scan.
};

/// A node of the graph.
struct KeyScan {
  std::shared_ptr<const ProjectedScan> scan;
  common::Pose2 T_map_body;
  std::deque<AttachedScan> drawn;  ///< Oldest first.
  std::vector<int> edges;          ///< Indices of the graph's edges that begin or end here.
};

/// Whether two key scans, given by index, count as of different passes: whether many others were taken between them.
inline bool areOfTwoPasses(int a, int b) {
  // With key scans 0.4 m apart these are 6 m: within them a match corrects the pass itself, and closes no loop.
  constexpr int kOtherPass = 15;
  return std::abs(a - b) > kOtherPass;
}
/// The first of `keys` (ascending) that belongs to the newest pass.
std::vector<int>::const_iterator newestPass(const std::vector<int>& keys);

struct SlamGraph {
  std::vector<KeyScan> keys;
  std::vector<SlamEdge> edges;

  void add(SlamEdge edge);
  /// Removes an edge. The index of each edge after it decreases by one.
  void remove(int edge);
};

/// The uncertainty of a key scan's pose relative to another key scan, along the most certain path.
struct ProjectedUncertainty {
  int key = 0;
  Eigen::Matrix3d covariance_map = Eigen::Matrix3d::Zero();  ///< Of (x_m, y_m, yaw_rad), axes of the map.
  double sigma_m = 0.0;                                      ///< Standard deviation of the position, larger axis.
};

/// Dijkstra projection of the covariances from `start` (Grzonka 2009, section V-D). Returns key scans in order of
/// growing sigma_m, up to `max_sigma_m`. If `wanted` key scans are given, it ends when all of them are reached.
std::vector<ProjectedUncertainty> projectUncertainty(const SlamGraph& graph, int start, double max_sigma_m,
                                                     std::span<const int> wanted = {});

/// The distance between the positions of two poses, in metres.
double distance(const common::Pose2& a, const common::Pose2& b);

/// Draws the scan of a key scan, without what had gone then: the scans that saw it go may not be kept.
void drawAttached(SlicedMap& map, const common::Pose2& T_map_key, const AttachedScan& attached);
/// Draws all attached scans at the poses of their key scans, oldest scan first.
SlicedMap drawMap(const SlamGraph& graph, const GridDrawingConfig& config);

optimization::PoseEdge2D toPoseEdge(const SlamEdge& edge);
optimization::PoseGraph2D toPoseGraph(const SlamGraph& graph);

}  // namespace swiftlet::perception
