// How far each edge of a pose graph is from what all the other edges predict: the squared Mahalanobis length of its
// innovation, which is chi-squared distributed with 3 or 6 degrees of freedom if the information matrices are right.
//
// The covariance of the prediction follows from entries of the inverse normal matrix at the pairs of poses that edges
// connect. They are computed without the rest of it, from the sparse Cholesky factor.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "optimization/graph_2d.hpp"
#include "optimization/graph_3d.hpp"
#include "optimization/selected_inverse.hpp"

namespace swiftlet::optimization {

/// 3 by 3 in the plane, 6 by 6 in space; no heap.
using ErrorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using ErrorVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

/// The covariance of the error is the identity if the edge's information is right.
struct WhitenedEdge {
  int from = 0;
  int to = 0;
  ErrorVector error;
  /// By steps of the pose: (x, y, yaw) is added; in space the position is added, and the rotation turned by small
  /// angles (half of them) about the axes of the pose.
  ErrorMatrix jacobian_from;
  ErrorMatrix jacobian_to;
};

std::vector<WhitenedEdge> whitenedEdges(const PoseGraph2D& graph, const std::vector<common::Pose2>& poses);
std::vector<WhitenedEdge> whitenedEdges(const PoseGraph3D& graph, const std::vector<common::Pose3>& poses);

/// Of each edge; 0 for one that is in no group, and for one that nothing predicts, because it is the only connection.
struct SquaredInnovations {
  std::vector<double> alone;          ///< Against all other edges that are kept.
  std::vector<double> without_group;  ///< Against those that are kept and are not of the edge's group.
};

class EdgeInnovations {
 public:
  /// `anchors` are the poses that do not move, as anchorsOf() gives them. No edge is in two of the `groups`.
  EdgeInnovations(std::size_t poses, const std::vector<int>& anchors, std::vector<std::vector<std::size_t>> groups);

  /// At the optimum of the edges that are kept; by linearization. Empty where the equations cannot be solved. The edges
  /// connect the same poses in every call.
  SquaredInnovations squared(const std::vector<WhitenedEdge>& edges, const std::vector<bool>& kept);

 private:
  void add(int row, int column, const ErrorMatrix& block);
  void addPattern(const std::vector<WhitenedEdge>& edges, const std::vector<std::size_t>& group);
  ErrorMatrix covariance(int pose, int other, Eigen::Index size) const;
  ErrorMatrix predictions(const WhitenedEdge& a, const WhitenedEdge& b) const;
  void judge(const std::vector<WhitenedEdge>& edges, const std::vector<bool>& kept,
             const std::vector<std::size_t>& group, SquaredInnovations& squared) const;

  std::vector<int> place_;  ///< Of each pose among those that move; -1 for an anchor.
  int places_ = 0;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<Eigen::Triplet<double>> entries_;
  SelectedInverse inverse_;
};

}  // namespace swiftlet::optimization
