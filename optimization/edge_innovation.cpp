#include "optimization/edge_innovation.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "optimization/edge_error_3d.hpp"
#include "optimization/graph_parts.hpp"
#include "optimization/pose_graph_2d.hpp"

namespace swiftlet::optimization {
namespace {

/// Information of a prior that keeps poses without edges solvable; negligible beside any edge.
constexpr double kPriorInformation = 1e-9;
/// Where an edge alone determines a direction, its innovation has only this variance, and no error.
constexpr double kUndetermined = 1e-6;

/// e' * (covariance of the innovation)^-1 * e, where the covariance is the identity plus `sign` times that of the
/// prediction.
double squaredLength(const ErrorVector& error, const ErrorMatrix& predicted, double sign) {
  ErrorMatrix covariance = sign * predicted;
  covariance.diagonal().array() += 1.0 + kUndetermined;
  return error.dot(covariance.llt().solve(error));
}

/// The derivative of (x, y, z, qx, qy, qz, qw) by a step of the position and one of the rotation, q * (step, 1).
ErrorMatrix byStep(const Eigen::Matrix<double, 6, 7>& jacobian, const common::Pose3& pose) {
  Eigen::Matrix<double, 4, 3> turn;
  const Eigen::Vector3d v = pose.rotation.vec();
  turn << pose.rotation.w() * Eigen::Matrix3d::Identity() + common::skew(v), -v.transpose();
  ErrorMatrix derivative(6, 6);
  derivative.leftCols(3) = jacobian.leftCols<3>();
  derivative.rightCols(3) = jacobian.rightCols<4>() * turn;
  return derivative;
}

ErrorMatrix byStep(const Eigen::Matrix3d& jacobian, const common::Pose2&) { return jacobian; }

template <typename Graph>
std::vector<WhitenedEdge> whitened(const Graph& graph, const decltype(Graph::poses)& poses) {
  std::vector<WhitenedEdge> edges;
  edges.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const auto &from = poses[at(edge.from)], &to = poses[at(edge.to)];
    const auto e = edgeError(from, to, edge.T_from_to);
    const ErrorMatrix information = edge.information;
    const ErrorMatrix root = information.llt().matrixU();
    edges.push_back({edge.from, edge.to, root * ErrorVector(e.error), root * byStep(e.jacobian_from, from),
                     root * byStep(e.jacobian_to, to)});
  }
  return edges;
}

}  // namespace

std::vector<WhitenedEdge> whitenedEdges(const PoseGraph2D& graph, const std::vector<common::Pose2>& poses) {
  return whitened(graph, poses);
}
std::vector<WhitenedEdge> whitenedEdges(const PoseGraph3D& graph, const std::vector<common::Pose3>& poses) {
  return whitened(graph, poses);
}

EdgeInnovations::EdgeInnovations(std::size_t poses, const std::vector<int>& anchors,
                                 std::vector<std::vector<std::size_t>> groups)
    : place_(poses, 0), groups_(std::move(groups)) {
  for (const int anchor : anchors) place_[at(anchor)] = -1;
  for (int& place : place_)
    if (place >= 0) place = places_++;
}

void EdgeInnovations::add(int row, int column, const ErrorMatrix& block) {
  if (row < 0 || column < 0 || row < column) return;
  const int size = static_cast<int>(block.rows());
  for (int c = 0; c < size; ++c)
    for (int r = row == column ? c : 0; r < size; ++r)
      entries_.emplace_back(size * row + r, size * column + c, block(r, c));
}

ErrorMatrix EdgeInnovations::covariance(int pose, int other, Eigen::Index size) const {
  const int row = place_[at(pose)], column = place_[at(other)];
  ErrorMatrix block = ErrorMatrix::Zero(size, size);
  if (row < 0 || column < 0) return block;
  const int n = static_cast<int>(size);
  for (int c = 0; c < n; ++c)
    for (int r = 0; r < n; ++r) block(r, c) = inverse_(n * row + r, n * column + c);
  return block;
}

/// The covariance of what the kept edges predict for two edges, in units of these.
ErrorMatrix EdgeInnovations::predictions(const WhitenedEdge& a, const WhitenedEdge& b) const {
  const Eigen::Index size = a.error.size();
  ErrorMatrix by_from = a.jacobian_from * covariance(a.from, b.from, size);
  by_from += a.jacobian_to * covariance(a.to, b.from, size);
  ErrorMatrix by_to = a.jacobian_from * covariance(a.from, b.to, size);
  by_to += a.jacobian_to * covariance(a.to, b.to, size);
  ErrorMatrix sum = by_from * b.jacobian_from.transpose();
  sum += by_to * b.jacobian_to.transpose();
  return sum;
}

/// The poses of a group are correlated with each other, so all pairs of them have their place in the pattern.
void EdgeInnovations::addPattern(const std::vector<WhitenedEdge>& edges, const std::vector<std::size_t>& group) {
  std::vector<int> places;
  for (const std::size_t i : group) {
    places.push_back(place_[at(edges[i].from)]);
    places.push_back(place_[at(edges[i].to)]);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const Eigen::Index size = edges.front().error.size();
  const ErrorMatrix nothing = ErrorMatrix::Zero(size, size);
  for (const int row : places)
    for (const int column : places) add(row, column, nothing);
}

/// With A the covariance of the predictions of the group's edges, in units of their own, and D the diagonal matrix of
/// those that are kept, the errors without the kept ones of the group are (I - A D)^-1 e, and the covariance of the
/// predictions is (I - A D)^-1 A.
void EdgeInnovations::judge(const std::vector<WhitenedEdge>& edges, const std::vector<bool>& kept,
                            const std::vector<std::size_t>& group, SquaredInnovations& squared) const {
  const Eigen::Index size = edges.front().error.size(), all = size * static_cast<Eigen::Index>(group.size());
  Eigen::MatrixXd errors_and_A(all, all + 1), remaining = Eigen::MatrixXd::Identity(all, all);
  remaining.diagonal().array() += kUndetermined;
  for (std::size_t n = 0; n < group.size(); ++n) {
    const Eigen::Index row = size * static_cast<Eigen::Index>(n);
    const WhitenedEdge& edge = edges[group[n]];
    errors_and_A.col(0).segment(row, size) = edge.error;
    for (std::size_t m = 0; m < group.size(); ++m) {
      const Eigen::Index column = size * static_cast<Eigen::Index>(m);
      const ErrorMatrix block = predictions(edge, edges[group[m]]);
      errors_and_A.block(row, column + 1, size, size) = block;
      if (kept[group[m]]) remaining.block(row, column, size, size) -= block;
      if (m == n) squared.alone[group[n]] = squaredLength(edge.error, block, kept[group[n]] ? -1.0 : 1.0);
    }
  }
  const Eigen::MatrixXd without = remaining.partialPivLu().solve(errors_and_A);
  for (std::size_t n = 0; n < group.size(); ++n) {
    const Eigen::Index row = size * static_cast<Eigen::Index>(n);
    squared.without_group[group[n]] =
        squaredLength(without.col(0).segment(row, size), without.block(row, row + 1, size, size), 1.0);
  }
}

SquaredInnovations EdgeInnovations::squared(const std::vector<WhitenedEdge>& edges, const std::vector<bool>& kept) {
  if (edges.empty()) return {};
  const int size = static_cast<int>(edges.front().error.size());
  entries_.clear();
  for (int i = 0; i < size * places_; ++i) entries_.emplace_back(i, i, kPriorInformation);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int from = place_[at(edges[i].from)], to = place_[at(edges[i].to)];
    const double weight = kept[i] ? 1.0 : 0.0;  // Edges that are not kept stay in the sparsity pattern.
    const ErrorMatrix by_from = weight * edges[i].jacobian_from.transpose();
    const ErrorMatrix by_to = weight * edges[i].jacobian_to.transpose();
    add(from, from, by_from * edges[i].jacobian_from);
    add(to, to, by_to * edges[i].jacobian_to);
    add(from, to, by_from * edges[i].jacobian_to);
    add(to, from, by_to * edges[i].jacobian_from);
  }
  for (const auto& group : groups_) addPattern(edges, group);
  if (!inverse_.compute(size * places_, entries_)) return {};
  const std::vector<double> none(edges.size(), 0.0);
  SquaredInnovations squared{none, none};
  for (const auto& group : groups_) judge(edges, kept, group, squared);
  return squared;
}

}  // namespace swiftlet::optimization
