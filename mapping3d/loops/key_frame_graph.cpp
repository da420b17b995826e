#include "mapping3d/loops/key_frame_graph.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/LU>

#include "common/check.hpp"
#include "optimization/pose_graph_3d.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

/// Errors of position and attitude of an alignment between two key frames that its points do not show, at least.
constexpr double kEdgeSigma_m = 0.01, kEdgeSigma_rad = 0.005;
/// Errors that alignments gather over a metre of steps and over a radian of turns; they grow with the roots of both, as
/// a random walk does (docs/decisions/mapping3d.md#040).
constexpr double kWalk_m = 0.03, kWalk_rad = 0.05;
/// Further differences of a loop closure from the path that are accepted: of its position, as a share of the path's
/// length, and of its attitude, as a share of all turns along the path.
constexpr double kDriftShare = 0.05, kDriftTurnShare = 0.05;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

double turnOf_rad(const Pose3& pose) { return pose.rotation.angularDistance(Eigen::Quaterniond::Identity()); }

/// A turn of one radian costs as much as a step of one metre.
double costOf(const Pose3& step) { return step.position_m.norm() + turnOf_rad(step); }

struct Neighbour {
  int node = 0;
  Pose3 step;
};

}  // namespace

KeyFrameGraph::KeyFrameGraph(const KeyFrameGraphConfig& config)
    : config_(config), poses_(std::make_shared<const common::KeyPoses>(common::KeyPoses{1, {common::KeyPose{}}})) {}

/// The graph's error has half the rotation vector, see optimization::PoseEdge3D.
optimization::PoseEdge3D KeyFrameGraph::edgeOf(const KeyFrameEdge& edge, int to, bool robust) const {
  Matrix6d covariance = edge.information.inverse();
  covariance.diagonal().head<3>().array() +=
      kEdgeSigma_m * kEdgeSigma_m + kWalk_m * kWalk_m * edge.T_from_to.position_m.norm();
  covariance.diagonal().tail<3>().array() +=
      kEdgeSigma_rad * kEdgeSigma_rad + kWalk_rad * kWalk_rad * turnOf_rad(edge.T_from_to);
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1.0, 1.0, 1.0, 0.5, 0.5, 0.5;
  covariance = (unit.asDiagonal() * covariance * unit.asDiagonal()).eval();
  const Matrix6d information = covariance.inverse();
  return {edge.from, to, edge.T_from_to, 0.5 * (information + information.transpose()), robust};
}

void KeyFrameGraph::beginAt(const Pose3& T_map_key) {
  SWIFTLET_CHECK(graph_.poses.empty());
  poses_ = std::make_shared<const common::KeyPoses>(
      common::KeyPoses{poses_->version + 1, {common::KeyPose{{}, {}, T_map_key}}});
}

int KeyFrameGraph::add(common::Time stamp, const Pose3& T_map_key, std::span<const KeyFrameEdge> edges) {
  const auto number = static_cast<int>(graph_.poses.size());
  graph_.poses.push_back(T_map_key);
  stamps_.push_back(stamp);
  for (const KeyFrameEdge& edge : edges) graph_.edges.push_back(edgeOf(edge, number, false));
  publish();
  return number;
}

/// Dijkstra's algorithm.
KeyFrameGraph::PathLength KeyFrameGraph::pathBetween(int from, int to) const {
  std::vector<std::vector<Neighbour>> neighbours(graph_.poses.size());
  for (const optimization::PoseEdge3D& edge : graph_.edges) {
    neighbours[at(edge.from)].push_back({edge.to, edge.T_from_to});
    neighbours[at(edge.to)].push_back({edge.from, edge.T_from_to});
  }
  struct Reached {
    double cost = std::numeric_limits<double>::infinity();
    PathLength path;
  };
  std::vector<Reached> reached(graph_.poses.size());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  reached[at(from)].cost = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (node == to) break;
    if (cost > reached[at(node)].cost) continue;
    for (const Neighbour& next : neighbours[at(node)]) {
      const double next_cost = cost + costOf(next.step);
      if (next_cost >= reached[at(next.node)].cost) continue;
      PathLength path = reached[at(node)].path;
      path.path_m += next.step.position_m.norm();
      path.turn_rad += turnOf_rad(next.step);
      path.extent_m =
          std::max(path.extent_m, (graph_.poses[at(next.node)].position_m - graph_.poses[at(to)].position_m).norm());
      reached[at(next.node)] = {next_cost, path};
      open.emplace(next_cost, next.node);
    }
  }
  return reached[at(to)].path;
}

bool KeyFrameGraph::allows(int to, const KeyFrameEdge& loop) const {
  const PathLength length = pathBetween(loop.from, to);
  const Pose3 T_from_to = graph_.poses[at(loop.from)].inverse() * graph_.poses[at(to)];
  const double turn_rad = config_.drift_rad + kDriftTurnShare * length.turn_rad;
  const double step_m = config_.drift_m + kDriftShare * length.path_m + turn_rad * length.extent_m;
  return loop.T_from_to.rotation.angularDistance(T_from_to.rotation) <= turn_rad &&
         (loop.T_from_to.position_m - T_from_to.position_m).norm() <= step_m;
}

int KeyFrameGraph::takeOutUnconfirmed(const std::vector<double>& squared_errors, std::size_t first_new) {
  std::vector<optimization::PoseEdge3D> kept;
  int of_new = 0;
  for (std::size_t i = 0; i < graph_.edges.size(); ++i) {
    if (graph_.edges[i].robust && squared_errors[i] > config_.greatest_error) continue;
    kept.push_back(graph_.edges[i]);
    of_new += i >= first_new ? 1 : 0;
  }
  const auto taken = static_cast<int>(graph_.edges.size() - kept.size());
  graph_.edges = std::move(kept);
  rejected_ += taken;
  loops_ -= taken;
  return of_new;
}

int KeyFrameGraph::close(std::span<const KeyFrameEdge> loops) {
  const int newest = static_cast<int>(graph_.poses.size()) - 1;
  const std::size_t first_new = graph_.edges.size();
  // All are judged by the path without any of them.
  std::vector<optimization::PoseEdge3D> allowed;
  for (const KeyFrameEdge& loop : loops)
    if (allows(newest, loop)) allowed.push_back(edgeOf(loop, newest, true));
  rejected_ += static_cast<int>(loops.size() - allowed.size());
  graph_.edges.insert(graph_.edges.end(), allowed.begin(), allowed.end());
  const std::size_t all = graph_.edges.size();
  if (all == first_new) return 0;
  loops_ += static_cast<int>(all - first_new);
  auto solution = optimization::optimize(graph_, config_.optimization);
  const int kept = takeOutUnconfirmed(solution.squared_errors, first_new);
  if (graph_.edges.size() < all) solution = optimization::optimize(graph_, config_.optimization);
  graph_.poses = std::move(solution.poses);
  publish();
  return kept;
}

void KeyFrameGraph::publish() {
  auto poses = std::make_shared<common::KeyPoses>();
  poses->version = poses_->version + 1;
  for (std::size_t i = 0; i < graph_.poses.size(); ++i) poses->keys.push_back({stamps_[i], {}, graph_.poses[i]});
  poses_ = std::move(poses);
}

}  // namespace swiftlet::mapping3d
