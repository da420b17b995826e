#include "optimization/pose_graph_3d.hpp"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/product_manifold.h>
#include <ceres/sized_cost_function.h>
#include <Eigen/Cholesky>

#include "optimization/ceres_solver.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose3;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using RowMatrix67d = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

Pose3 poseOf(const double* block) {
  return {Eigen::Quaterniond(block + 3), Eigen::Vector3d(block[0], block[1], block[2])};
}

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

/// The vector part of a * b is leftVector(a) * b.coeffs().
Eigen::Matrix<double, 3, 4> leftVector(const Eigen::Quaterniond& a) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << a.w() * Eigen::Matrix3d::Identity() + cross(a.vec()), a.vec();
  return matrix;
}

/// The vector part of a * b is rightVector(b) * a.coeffs().
Eigen::Matrix<double, 3, 4> rightVector(const Eigen::Quaterniond& b) {
  Eigen::Matrix<double, 3, 4> matrix;
  matrix << b.w() * Eigen::Matrix3d::Identity() - cross(b.vec()), b.vec();
  return matrix;
}

class EdgeCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost(const PoseEdge3D& edge)
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
    problem.AddResidualBlock(new EdgeCost(edge), edge.robust ? new ceres::CauchyLoss(config.robust_width) : nullptr,
                             values[static_cast<std::size_t>(edge.from)].data(),
                             values[static_cast<std::size_t>(edge.to)].data());
}

}  // namespace

EdgeError3D edgeError(const Pose3& from, const Pose3& to, const Pose3& T_from_to) {
  const Eigen::Quaterniond back = T_from_to.rotation.conjugate();
  const Eigen::Quaterniond turned = back * from.rotation.conjugate();
  const Eigen::Quaterniond difference = turned * to.rotation;
  const double sign = difference.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Matrix3d R_back = back.toRotationMatrix(), R_turned = turned.toRotationMatrix();
  const Eigen::Vector3d step = to.position_m - from.position_m;

  EdgeError3D e;
  e.error << R_turned * step - R_back * T_from_to.position_m, sign * difference.vec();

  // With u, w of the rotation of `from`: R_from' * step = step - 2 w (u x step) + 2 u x (u x step).
  const Eigen::Vector3d u = from.rotation.vec();
  Eigen::Matrix<double, 3, 4> by_rotation;
  by_rotation << 2.0 * (from.rotation.w() * cross(step) + u.dot(step) * Eigen::Matrix3d::Identity() +
                        u * step.transpose() - 2.0 * step * u.transpose()),
      -2.0 * u.cross(step);

  const Eigen::Vector4d conjugation(-1.0, -1.0, -1.0, 1.0);
  e.jacobian_from.topLeftCorner<3, 3>() = -R_turned;
  e.jacobian_from.topRightCorner<3, 4>().noalias() = R_back * by_rotation;
  e.jacobian_from.bottomLeftCorner<3, 3>().setZero();
  // back * conjugate(from) * to, linear in `from`.
  Eigen::Matrix4d by_conjugate;
  const Eigen::Quaterniond& b = to.rotation;
  by_conjugate << rightVector(b), -b.x(), -b.y(), -b.z(), b.w();
  e.jacobian_from.bottomRightCorner<3, 4>().noalias() =
      sign * leftVector(back) * by_conjugate * conjugation.asDiagonal();
  e.jacobian_to.topLeftCorner<3, 3>() = R_turned;
  e.jacobian_to.topRightCorner<3, 4>().setZero();
  e.jacobian_to.bottomLeftCorner<3, 3>().setZero();
  e.jacobian_to.bottomRightCorner<3, 4>() = sign * leftVector(turned);
  return e;
}

PoseGraph3DSolution optimize(const PoseGraph3D& graph, const PoseGraphConfig& config) {
  PoseGraph3DSolution solution;
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
