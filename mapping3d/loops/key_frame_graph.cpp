#include "mapping3d/loops/key_frame_graph.hpp"

#include <algorithm>
#include <limits>
#include <map>
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
/// Key frames whose poses are adjusted when a new one is added; they span some metres.
constexpr int kAdjusted = 12;
/// Two meetings of the same pieces agree if they place one in the other within this: as far as key frames of a piece
/// drift against each other before the piece is joined.
constexpr double kAgree_m = 0.3, kAgree_rad = 0.1;
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

/// The graph's error has half the rotation vector, see optimization::PoseEdge3D. So many edges with errors that are
/// alike count as one.
optimization::PoseEdge3D edgeOf(const KeyFrameEdge& edge, int to, bool robust, std::size_t edges = 1) {
  const auto alike = static_cast<double>(edges);
  Matrix6d covariance = edge.information.inverse();
  covariance.diagonal().head<3>().array() +=
      kEdgeSigma_m * kEdgeSigma_m + kWalk_m * kWalk_m * edge.T_from_to.position_m.norm();
  covariance.diagonal().tail<3>().array() +=
      kEdgeSigma_rad * kEdgeSigma_rad + kWalk_rad * kWalk_rad * turnOf_rad(edge.T_from_to);
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1.0, 1.0, 1.0, 0.5, 0.5, 0.5;
  covariance = (alike * unit.asDiagonal() * covariance * unit.asDiagonal()).eval();
  const Matrix6d information = covariance.inverse();
  return {edge.from, to, edge.T_from_to, 0.5 * (information + information.transpose()), robust};
}

}  // namespace

KeyFrameGraph::KeyFrameGraph(const KeyFrameGraphConfig& config)
    : config_(config), poses_(std::make_shared<const common::KeyPoses>(common::KeyPoses{1, {common::KeyPose{}}})) {}

void KeyFrameGraph::beginAt(const Pose3& T_map_key) {
  SWIFTLET_CHECK(graph_.poses.empty());
  poses_ = std::make_shared<const common::KeyPoses>(
      common::KeyPoses{poses_->version + 1, {common::KeyPose{{}, {}, T_map_key}}});
}

int KeyFrameGraph::add(common::Time stamp, const Pose3& T_map_key, std::span<const KeyFrameEdge> edges) {
  const auto number = static_cast<int>(graph_.poses.size());
  graph_.poses.push_back(T_map_key);
  stamps_.push_back(stamp);
  pieces_.push_back(edges.empty() ? begun_++ : pieceOf(edges.front().from));
  for (const KeyFrameEdge& edge : edges) graph_.edges.push_back(edgeOf(edge, number, false, edges.size()));
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

void KeyFrameGraph::adjustNewest() {
  const int first = std::max(0, static_cast<int>(graph_.poses.size()) - kAdjusted);
  std::map<int, int> local;  // Their numbers in the part that is adjusted.
  optimization::PoseGraph3D part;
  part.fixed.clear();
  const auto numberOf = [&](int node) {
    const auto [known, is_new] = local.emplace(node, static_cast<int>(part.poses.size()));
    if (is_new) part.poses.push_back(graph_.poses[at(node)]);
    if (is_new && node < first) part.fixed.push_back(known->second);
    return known->second;
  };
  for (const optimization::PoseEdge3D& edge : graph_.edges) {
    if (edge.from < first && edge.to < first) continue;
    part.edges.push_back(edge);
    part.edges.back().from = numberOf(edge.from);
    part.edges.back().to = numberOf(edge.to);
  }
  if (part.edges.size() < part.poses.size()) return;  // A chain fulfils all of its edges already.
  const auto solution = optimization::optimize(part, config_.optimization);
  for (const auto& [node, number] : local)
    if (node >= first) graph_.poses[at(node)] = solution.poses[at(number)];
  publish();
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
  return optimizeWith(first_new);
}

/// Returns how many of the edges from `first_new` on were kept.
int KeyFrameGraph::optimizeWith(std::size_t first_new) {
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

/// The newer piece becomes a part of the older one.
JoinedPieces KeyFrameGraph::piecesOf(const Meeting& meeting) const {
  const int a = pieceOf(meeting.edge.from), b = pieceOf(meeting.to);
  return {std::max(a, b), std::min(a, b)};
}

/// By how much the newer of its pieces moves.
Pose3 KeyFrameGraph::T_into_from(const Meeting& meeting) const {
  const Pose3 T_moved =
      graph_.poses[at(meeting.edge.from)] * meeting.edge.T_from_to * graph_.poses[at(meeting.to)].inverse();
  return pieceOf(meeting.to) == piecesOf(meeting).from ? T_moved : T_moved.inverse();
}

/// Compared at the key frame of the newer piece.
bool KeyFrameGraph::agree(const Meeting& a, const Meeting& b) const {
  const bool is_to = pieceOf(a.to) == piecesOf(a).from;
  const Pose3& there = graph_.poses[at(is_to ? a.to : a.edge.from)];
  const Pose3 by_a = T_into_from(a) * there, by_b = T_into_from(b) * there;
  return (by_a.position_m - by_b.position_m).norm() <= kAgree_m &&
         by_a.rotation.angularDistance(by_b.rotation) <= kAgree_rad;
}

std::optional<JoinedPieces> KeyFrameGraph::join(std::span<const KeyFrameEdge> edges) {
  const int newest = static_cast<int>(graph_.poses.size()) - 1;
  for (const KeyFrameEdge& edge : edges) {
    const Meeting met{edge, newest};
    const JoinedPieces pieces = piecesOf(met);
    std::vector<Meeting> agreeing{met};
    for (const Meeting& other : meetings_) {
      const JoinedPieces same = piecesOf(other);
      if (same.from == pieces.from && same.into == pieces.into && agree(met, other)) agreeing.push_back(other);
    }
    meetings_.push_back(met);
    if (agreeing.size() < 2) continue;
    const Pose3 T_move = T_into_from(met);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i] != pieces.from) continue;
      graph_.poses[i] = T_move * graph_.poses[i];
      graph_.poses[i].rotation.normalize();
      pieces_[i] = pieces.into;
    }
    std::erase_if(meetings_, [&](const Meeting& one) { return pieceOf(one.edge.from) == pieceOf(one.to); });
    const std::size_t first_new = graph_.edges.size();
    for (const Meeting& one : agreeing) graph_.edges.push_back(edgeOf(one.edge, one.to, true));
    (void)optimizeWith(first_new);
    return pieces;
  }
  return std::nullopt;
}

void KeyFrameGraph::publish() {
  auto poses = std::make_shared<common::KeyPoses>();
  poses->version = poses_->version + 1;
  for (std::size_t i = 0; i < graph_.poses.size(); ++i) poses->keys.push_back({stamps_[i], {}, graph_.poses[i]});
  poses_ = std::move(poses);
}

}  // namespace swiftlet::mapping3d
