#include "optimization/pose_graph_2d.hpp"

#include <cmath>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <Eigen/Cholesky>

#include "common/check.hpp"
#include "optimization/ceres_solver.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose2;
using RowMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

class EdgeCost2D final : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit EdgeCost2D(const PoseEdge2D& edge)
      : T_from_to_(edge.T_from_to), sqrt_information_(edge.information.llt().matrixU()) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Pose2 from{parameters[0][0], parameters[0][1], parameters[0][2]};
    const Pose2 to{parameters[1][0], parameters[1][1], parameters[1][2]};
    const EdgeError2D e = edgeError(from, to, T_from_to_);
    Eigen::Map<Eigen::Vector3d>(residuals, 3) = sqrt_information_ * e.error;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) Eigen::Map<RowMatrix3d>{jacobians[0]} = sqrt_information_ * e.jacobian_from;
    if (jacobians[1] != nullptr) Eigen::Map<RowMatrix3d>{jacobians[1]} = sqrt_information_ * e.jacobian_to;
    return true;
  }

 private:
  Pose2 T_from_to_;
  Eigen::Matrix3d sqrt_information_;
};

/// A weak prior that keeps poses without edges in place. Beside the edges of connected poses it is negligible.
class PriorCost final : public ceres::SizedCostFunction<3, 3> {
 public:
  explicit PriorCost(const Pose2& pose) : prior_(pose.x_m, pose.y_m, pose.yaw_rad) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::Vector3d>(residuals, 3) = kWeight * (Eigen::Map<const Eigen::Vector3d>(parameters[0]) - prior_);
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<RowMatrix3d>{jacobians[0]} = kWeight * RowMatrix3d::Identity();
    return true;
  }

 private:
  static constexpr double kWeight = 1e-6;  ///< A standard deviation of 1,000 km: nothing beside any edge.
  Eigen::Vector3d prior_;
};

}  // namespace

EdgeError2D edgeError(const Pose2& from, const Pose2& to, const Pose2& T_from_to) {
  const double c = std::cos(from.yaw_rad), s = std::sin(from.yaw_rad);
  Eigen::Matrix2d rotation_transposed;
  rotation_transposed << c, s, -s, c;
  const Eigen::Vector2d step(to.x_m - from.x_m, to.y_m - from.y_m);
  const Eigen::Vector2d seen = rotation_transposed * step;

  EdgeError2D e;
  e.error << seen - T_from_to.position_m(), common::wrapAngle(to.yaw_rad - from.yaw_rad - T_from_to.yaw_rad);
  e.jacobian_from.setZero();
  e.jacobian_from.topLeftCorner<2, 2>() = -rotation_transposed;
  e.jacobian_from.topRightCorner<2, 1>() = Eigen::Vector2d(seen.y(), -seen.x());
  e.jacobian_from(2, 2) = -1.0;
  e.jacobian_to.setZero();
  e.jacobian_to.topLeftCorner<2, 2>() = rotation_transposed;
  e.jacobian_to(2, 2) = 1.0;
  return e;
}

PoseGraphSolution<common::Pose2> optimize(const PoseGraph2D& graph, const PoseGraphConfig& config) {
  const int size = static_cast<int>(graph.poses.size());
  SWIFTLET_CHECK(size == 0 || (graph.fixed >= 0 && graph.fixed < size), graph.fixed, size);
  PoseGraphSolution<common::Pose2> solution;
  solution.poses = graph.poses;
  solution.converged = true;
  if (size == 0) return solution;

  std::vector<Eigen::Vector3d> values;
  values.reserve(graph.poses.size());
  for (const Pose2& pose : graph.poses) values.emplace_back(pose.x_m, pose.y_m, pose.yaw_rad);

  ceres::Problem problem;
  for (int i = 0; i < size; ++i) {
    auto* block = values[static_cast<std::size_t>(i)].data();
    problem.AddParameterBlock(block, 3);
    problem.AddResidualBlock(new PriorCost(graph.poses[static_cast<std::size_t>(i)]), nullptr, block);
  }
  for (const PoseEdge2D& edge : graph.edges) {
    SWIFTLET_CHECK(edge.from >= 0 && edge.from < size && edge.to >= 0 && edge.to < size && edge.from != edge.to,
                   edge.from, edge.to, size);
    problem.AddResidualBlock(new EdgeCost2D(edge), edge.robust ? new ceres::CauchyLoss(config.robust_width) : nullptr,
                             values[static_cast<std::size_t>(edge.from)].data(),
                             values[static_cast<std::size_t>(edge.to)].data());
  }
  problem.SetParameterBlockConstant(values[static_cast<std::size_t>(graph.fixed)].data());
  for (const int index : graph.also_fixed)
    problem.SetParameterBlockConstant(values[static_cast<std::size_t>(index)].data());

  const ceres::Solver::Summary summary = solve(problem, config);
  solution.iterations = stepsTried(summary);
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  if (summary.IsSolutionUsable())
    for (std::size_t i = 0; i < values.size(); ++i)
      solution.poses[i] = {values[i].x(), values[i].y(), common::wrapAngle(values[i].z())};

  for (const PoseEdge2D& edge : graph.edges) {
    const Eigen::Vector3d e = edgeError(solution.poses[static_cast<std::size_t>(edge.from)],
                                        solution.poses[static_cast<std::size_t>(edge.to)], edge.T_from_to)
                                  .error;
    solution.squared_errors.push_back(e.dot(edge.information * e));
  }
  return solution;
}

}  // namespace swiftlet::optimization
