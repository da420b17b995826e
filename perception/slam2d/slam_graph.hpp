// The graph of key scans, and how far the uncertainty between two of them reaches.
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

/// A drawn scan and where it stands in the level frame of its key scan.
struct AttachedScan {
  std::shared_ptr<const DrawnScan> scan;
  common::Pose2 T_key_body;
};

struct KeyScan {
  std::shared_ptr<const ProjectedScan> scan;
  common::Pose2 T_map_body;
  std::deque<AttachedScan> drawn;  ///< Oldest first.
  std::vector<int> edges;          ///< Of the graph, that begin or end here.
};

/// Whether two key scans lie so far apart in the order in which they were taken that they are of two passes.
inline bool areOfTwoPasses(int a, int b) {
  constexpr int kOtherPass = 15;
  return std::abs(a - b) > kOtherPass;
}

struct SlamGraph {
  std::vector<KeyScan> keys;
  std::vector<SlamEdge> edges;

  void add(SlamEdge edge);
  /// The edges after it move up by one.
  void remove(int edge);
};

/// The uncertainty of a key scan's pose as seen from another, along the most certain path.
struct ProjectedUncertainty {
  int key = 0;
  Eigen::Matrix3d covariance_map = Eigen::Matrix3d::Zero();  ///< Of (x_m, y_m, yaw_rad), axes of the map.
  double sigma_m = 0.0;                                      ///< The larger axis of the position.
};

/// Dijkstra projection of the covariances from `start` (Grzonka 2009, section V-D), in order of growing sigma_m, up
/// to `max_sigma_m`, or, where `wanted` keys are given, until all of those are reached.
std::vector<ProjectedUncertainty> projectUncertainty(const SlamGraph& graph, int start, double max_sigma_m,
                                                     std::span<const int> wanted = {});

/// Between the places of two poses, in metres.
double distance(const common::Pose2& a, const common::Pose2& b);

/// Draws all attached scans at their key scans' poses, oldest first.
SlicedMap drawMap(const SlamGraph& graph, const GridDrawingConfig& config);

optimization::PoseEdge2D toPoseEdge(const SlamEdge& edge);
optimization::PoseGraph2D toPoseGraph(const SlamGraph& graph);

}  // namespace swiftlet::perception
