#include "optimization/chordal_start.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose2;
using common::Pose3;

template <int kSize>
using Square = Eigen::Matrix<double, kSize, kSize>;

Square<2> rotationOf(const Pose2& pose) { return Eigen::Rotation2Dd(pose.yaw_rad).toRotationMatrix(); }
Square<3> rotationOf(const Pose3& pose) { return pose.rotation.toRotationMatrix(); }
Eigen::Vector2d positionOf(const Pose2& pose) { return pose.position_m(); }
Eigen::Vector3d positionOf(const Pose3& pose) { return pose.position_m; }

Pose2 poseFrom(const Square<2>& rotation, const Eigen::Vector2d& position_m) {
  return {position_m.x(), position_m.y(), std::atan2(rotation(1, 0), rotation(0, 0))};
}
Pose3 poseFrom(const Square<3>& rotation, const Eigen::Vector3d& position_m) {
  return {Eigen::Quaterniond(rotation).normalized(), position_m};
}

/// The information of an edge on its rotation, equal for all axes: by its mean variance.
double rotationWeight(const PoseEdge2D& edge) { return edge.information(2, 2); }
double rotationWeight(const PoseEdge3D& edge) {
  return 3.0 / edge.information.bottomRightCorner<3, 3>().inverse().trace();
}

/// Of the position of `to`, along the axes of the error of edgeError turned to those of the graph.
Square<2> positionInformation(const PoseEdge2D& edge, const Square<2>& rotation_from) {
  return rotation_from * edge.information.topLeftCorner<2, 2>() * rotation_from.transpose();
}
Square<3> positionInformation(const PoseEdge3D& edge, const Square<3>& rotation_from) {
  const Square<3> turn = rotation_from * rotationOf(edge.T_from_to);
  return turn * edge.information.topLeftCorner<3, 3>() * turn.transpose();
}

/// The rotation nearest to a matrix (Frobenius).
template <int kSize>
Square<kSize> nearestRotation(const Square<kSize>& matrix) {
  const Eigen::JacobiSVD<Square<kSize>> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Square<kSize> mirror = Square<kSize>::Identity();
  mirror(kSize - 1, kSize - 1) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * mirror * svd.matrixV().transpose();
}

/// Least squares of equations x_to - factor * x_from = constant, each x a kSize by kColumns matrix, some x known.
template <int kSize, int kColumns>
class LinearGraph {
 public:
  using Value = Eigen::Matrix<double, kSize, kColumns>;

  explicit LinearGraph(std::vector<Value>& values, const std::vector<int>& known)
      : values_(values), unknown_(values.size(), 0) {
    for (const int index : known) unknown_[at(index)] = -1;
    for (Eigen::Index& index : unknown_)
      if (index >= 0) index = count_++;
    right_.setZero(kSize * count_, kColumns);
  }

  void add(int from, int to, const Square<kSize>& factor, Value constant, const Square<kSize>& weight) {
    const Eigen::Index i = unknown_[at(from)], j = unknown_[at(to)];
    if (i < 0) constant += factor * values_[at(from)];
    if (j < 0) constant -= values_[at(to)];
    const Square<kSize> pull = factor.transpose() * weight;
    if (i >= 0) addBlock(i, i, pull * factor);
    if (j >= 0) addBlock(j, j, weight);
    if (i >= 0 && j >= 0) i > j ? addBlock(i, j, -pull) : addBlock(j, i, -pull.transpose());
    if (i >= 0) right_.template middleRows<kSize>(kSize * i) -= pull * constant;
    if (j >= 0) right_.template middleRows<kSize>(kSize * j) += weight * constant;
  }

  /// False, with nothing changed, where the solution is not unique.
  bool solve() {
    if (count_ <= 0) return true;
    Eigen::SparseMatrix<double> matrix(kSize * count_, kSize * count_);
#ifndef __clang_analyzer__  // It takes the matrix for one without rows, inside Eigen.
    matrix.setFromTriplets(entries_.begin(), entries_.end());
#endif
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factorized(matrix);
    if (factorized.info() != Eigen::Success) return false;
    const Eigen::Matrix<double, Eigen::Dynamic, kColumns> solution = factorized.solve(right_);
    if (!solution.allFinite()) return false;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (unknown_[i] >= 0) values_[i] = solution.template middleRows<kSize>(kSize * unknown_[i]);
    return true;
  }

 private:
  /// Of the lower triangle.
  void addBlock(Eigen::Index row, Eigen::Index column, const Square<kSize>& block) {
    for (int r = 0; r < kSize; ++r)
      for (int c = 0; c < kSize; ++c)
        if (row != column || r >= c)
          entries_.emplace_back(static_cast<int>(kSize * row) + r, static_cast<int>(kSize * column) + c, block(r, c));
  }

  std::vector<Value>& values_;
  std::vector<Eigen::Index> unknown_;  ///< The place of each value among the unknown ones; -1 when it is known.
  Eigen::Index count_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::Matrix<double, Eigen::Dynamic, kColumns> right_;
};

template <int kSize, typename Graph>
auto start(const Graph& graph) {
  const std::vector<int> anchors = anchorsOf(graph);
  // R_to' = R_edge' * R_from'; the columns of R' are free at first.
  std::vector<Square<kSize>> transposed;
  for (const auto& pose : graph.poses) transposed.push_back(rotationOf(pose).transpose());
  LinearGraph<kSize, kSize> rotations(transposed, anchors);
  for (const auto& edge : graph.edges)
    rotations.add(edge.from, edge.to, rotationOf(edge.T_from_to).transpose(), Square<kSize>::Zero(),
                  rotationWeight(edge) * Square<kSize>::Identity());
  if (!rotations.solve()) return graph.poses;
  for (auto& rotation : transposed) rotation = nearestRotation<kSize>(rotation);

  // t_to - t_from = R_from * t_edge.
  std::vector<Eigen::Matrix<double, kSize, 1>> positions;
  for (const auto& pose : graph.poses) positions.push_back(positionOf(pose));
  LinearGraph<kSize, 1> translations(positions, anchors);
  for (const auto& edge : graph.edges) {
    const Square<kSize> rotation_from = transposed[at(edge.from)].transpose();
    translations.add(edge.from, edge.to, Square<kSize>::Identity(), rotation_from * positionOf(edge.T_from_to),
                     positionInformation(edge, rotation_from));
  }
  if (!translations.solve()) return graph.poses;
  auto poses = graph.poses;
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = poseFrom(transposed[i].transpose(), positions[i]);
  for (const int i : anchors) poses[at(i)] = graph.poses[at(i)];
  return poses;
}

}  // namespace

std::vector<Pose2> chordalStart(const PoseGraph2D& graph) { return start<2>(graph); }
std::vector<Pose3> chordalStart(const PoseGraph3D& graph) { return start<3>(graph); }

}  // namespace swiftlet::optimization
