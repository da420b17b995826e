#include "optimization/pose_graph_3d.hpp"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <ceres/sized_cost_function.h>
#include <Eigen/Cholesky>

#include "optimization/ceres_solver.hpp"
#include "optimization/edge_error_3d.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose3;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using RowMatrix67d = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

Pose3 poseOf(const double* block) {
  return {Eigen::Quaterniond(block + 3), Eigen::Vector3d(block[0], block[1], block[2])};
}

class EdgeCost3D final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost3D(const PoseEdge3D& edge)
      : T_from_to_(edge.T_from_to), sqrt_information_(edge.information.llt().matrixU()) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const EdgeError3D e = edgeError(poseOf(parameters[0]), poseOf(parameters[1]), T_from_to_);
    Eigen::Map<Vector6d>(residuals, 6).noalias() = sqrt_information_ * e.error;
    if (jacobians == nullptr) return true;
    if (jacobians[0] != nullptr) Eigen::Map<RowMatrix67d>(jacobians[0]).noalias() = sqrt_information_ * e.jacobian_from;
    if (jacobians[1] != nullptr) Eigen::Map<RowMatrix67d>(jacobians[1]).noalias() = sqrt_information_ * e.jacobian_to;
    return true;
  }

 private:
  Pose3 T_from_to_;
  Matrix6d sqrt_information_;
};

void addPoses(ceres::Problem& problem, const PoseGraph3D& graph, std::vector<Vector7d>& values) {
  auto* manifold = new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>;
  values.reserve(graph.poses.size());
  for (const Pose3& pose : graph.poses) {
    values.emplace_back();
    values.back() << pose.position_m, pose.rotation.coeffs();
    problem.AddParameterBlock(values.back().data(), 7, manifold);
  }
  for (const int anchor : anchorsOf(graph))
    problem.SetParameterBlockConstant(values[static_cast<std::size_t>(anchor)].data());
}

void addEdges(ceres::Problem& problem, const PoseGraph3D& graph, const PoseGraphConfig& config,
              std::vector<Vector7d>& values) {
  for (const PoseEdge3D& edge : graph.edges)
    problem.AddResidualBlock(new EdgeCost3D(edge), edge.robust ? new ceres::CauchyLoss(config.robust_width) : nullptr,
                             values[static_cast<std::size_t>(edge.from)].data(),
                             values[static_cast<std::size_t>(edge.to)].data());
}

}  // namespace

PoseGraphSolution<common::Pose3> optimize(const PoseGraph3D& graph, const PoseGraphConfig& config) {
  PoseGraphSolution<common::Pose3> solution;
  solution.poses = graph.poses;
  solution.converged = true;
  if (graph.poses.empty()) return solution;

  std::vector<Vector7d> values;
  ceres::Problem problem;
  addPoses(problem, graph, values);
  addEdges(problem, graph, config, values);
  const ceres::Solver::Summary summary = solve(problem, config);
  solution.iterations = stepsTried(summary);
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  if (summary.IsSolutionUsable())
    for (std::size_t i = 0; i < values.size(); ++i) {
      solution.poses[i] = poseOf(values[i].data());
      solution.poses[i].rotation.normalize();
    }
  solution.squared_errors = squaredErrors(graph, solution.poses);
  return solution;
}

}  // namespace swiftlet::optimization
