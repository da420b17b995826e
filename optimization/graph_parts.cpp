#include "optimization/graph_parts.hpp"

#include <algorithm>
#include <numeric>
#include <queue>
#include <utility>

#include "common/check.hpp"
#include "optimization/edge_error_3d.hpp"
#include "optimization/pose_graph_2d.hpp"

namespace swiftlet::optimization {
namespace {

std::vector<int> fixedOf(const PoseGraph2D& graph) {
  std::vector<int> fixed = graph.also_fixed;
  fixed.push_back(graph.fixed);
  return fixed;
}
const std::vector<int>& fixedOf(const PoseGraph3D& graph) { return graph.fixed; }

/// The edges of each pose, in their order.
template <typename Graph>
std::vector<std::vector<int>> edgesOfPoses(const Graph& graph) {
  const int size = static_cast<int>(graph.poses.size());
  std::vector<std::vector<int>> edges(graph.poses.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    SWIFTLET_CHECK(edge.from >= 0 && edge.from < size && edge.to >= 0 && edge.to < size && edge.from != edge.to,
                   edge.from, edge.to, size);
    edges[at(edge.from)].push_back(static_cast<int>(i));
    edges[at(edge.to)].push_back(static_cast<int>(i));
  }
  return edges;
}

/// Visits every pose once, breadth first from the anchors: `visit(pose, edge)` with the edge that led there, -1 for an
/// anchor.
template <typename Graph, typename Visit>
void walk(const Graph& graph, Visit&& visit) {
  const auto edges = edgesOfPoses(graph);
  std::vector<bool> seen(graph.poses.size(), false);
  std::queue<int> waiting;
  const auto arrive = [&](int pose, int edge) {
    if (seen[at(pose)]) return;
    seen[at(pose)] = true;
    visit(pose, edge);
    waiting.push(pose);
  };
  const auto spread = [&] {
    for (; !waiting.empty(); waiting.pop())
      for (const int edge : edges[at(waiting.front())]) {
        const auto& e = graph.edges[at(edge)];
        arrive(e.from == waiting.front() ? e.to : e.from, edge);
      }
  };
  for (const int pose : fixedOf(graph)) arrive(pose, -1);
  spread();
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    arrive(static_cast<int>(i), -1);
    spread();
  }
}

template <typename Graph>
std::vector<int> anchors(const Graph& graph) {
  std::vector<int> found;
  walk(graph, [&](int pose, int edge) {
    if (edge < 0) found.push_back(pose);
  });
  std::sort(found.begin(), found.end());
  return found;
}

template <typename Graph>
auto chained(const Graph& graph) {
  auto poses = graph.poses;
  walk(graph, [&](int pose, int edge) {
    if (edge < 0) return;
    const auto& e = graph.edges[at(edge)];
    poses[at(pose)] = e.to == pose ? poses[at(e.from)] * e.T_from_to : poses[at(e.to)] * e.T_from_to.inverse();
  });
  return poses;
}

template <typename Graph, typename Poses>
std::vector<double> squared(const Graph& graph, const Poses& poses) {
  std::vector<double> squares;
  squares.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const auto e = edgeError(poses[at(edge.from)], poses[at(edge.to)], edge.T_from_to).error;
    squares.push_back(e.dot(edge.information * e));
  }
  return squares;
}

}  // namespace

std::vector<int> anchorsOf(const PoseGraph2D& graph) { return anchors(graph); }
std::vector<int> anchorsOf(const PoseGraph3D& graph) { return anchors(graph); }

void fix(PoseGraph2D& graph, std::vector<int> poses) {
  if (!poses.empty()) graph.fixed = poses.front();
  graph.also_fixed = std::move(poses);
}
void fix(PoseGraph3D& graph, std::vector<int> poses) { graph.fixed = std::move(poses); }

std::vector<common::Pose2> chainedPoses(const PoseGraph2D& graph) { return chained(graph); }
std::vector<common::Pose3> chainedPoses(const PoseGraph3D& graph) { return chained(graph); }

std::vector<double> squaredErrors(const PoseGraph2D& graph, const std::vector<common::Pose2>& poses) {
  return squared(graph, poses);
}
std::vector<double> squaredErrors(const PoseGraph3D& graph, const std::vector<common::Pose3>& poses) {
  return squared(graph, poses);
}

double chi2Of(const std::vector<double>& squared_errors) {
  return std::accumulate(squared_errors.begin(), squared_errors.end(), 0.0);
}

}  // namespace swiftlet::optimization
