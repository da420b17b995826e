// Pose graphs in space: the error is that of g2o, the Jacobians are its derivatives, and the optimum is that of a dense
// Gauss-Newton with numeric derivatives, which shares nothing with the solver but the definition of the error.
#include "optimization/pose_graph_3d.hpp"
#include "optimization/edge_error_3d.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/Cholesky>

#include "graphs.hpp"
#include "optimization/graph_parts.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose3;
using common::RandomStream;
using test::Graph3D;
using test::noisyGraph;
using test::randomPose3;
using test::sum;

RandomStream anyStream() { return {*rc::gen::arbitrary<std::uint64_t>(), "pose graph"}; }

/// The error computed with homogeneous matrices, as in its definition.
Vector6d errorByMatrices(const Pose3& from, const Pose3& to, const Pose3& seen) {
  const auto matrix = [](const Pose3& pose) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = pose.rotation.toRotationMatrix();
    T.translation() = pose.position_m;
    return T;
  };
  const Eigen::Isometry3d difference = matrix(seen).inverse() * matrix(from).inverse() * matrix(to);
  Eigen::Quaterniond rotation(difference.linear());
  if (rotation.w() < 0.0) rotation.coeffs() *= -1.0;
  Vector6d error;
  error << difference.translation(), rotation.vec();
  return error;
}

/// The pose moved by a small step: position in the graph's frame, rotation vector in the pose's own.
Pose3 moved(const Pose3& pose, const Vector6d& step) {
  return {(pose.rotation * common::expSO3(step.tail<3>())).normalized(), pose.position_m + step.head<3>()};
}

/// The derivative of the seven numbers of a pose with respect to the step of `moved`.
Eigen::Matrix<double, 7, 6> numbersByStep(const Pose3& pose) {
  const auto& q = pose.rotation;
  Eigen::Matrix<double, 7, 6> matrix = Eigen::Matrix<double, 7, 6>::Zero();
  matrix.topLeftCorner<3, 3>().setIdentity();
  matrix.bottomRightCorner<4, 3>() << q.w(), -q.z(), q.y(), q.z(), q.w(), -q.x(), -q.y(), q.x(), q.w(), -q.x(), -q.y(),
      -q.z();
  matrix.bottomRightCorner<4, 3>() *= 0.5;
  return matrix;
}

template <typename Function>
Eigen::Matrix<double, 6, 6> derivative(Function&& function) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, 6, 6> matrix;
  for (int i = 0; i < 6; ++i)
    matrix.col(i) = (function(Vector6d(kStep * Vector6d::Unit(i))) - function(Vector6d(-kStep * Vector6d::Unit(i)))) /
                    (2.0 * kStep);
  return matrix;
}

/// Whether the rotation error is close to half a turn, where the sign of its quaternion changes.
bool nearTurn(const Pose3& from, const Pose3& to, const Pose3& seen) {
  return edgeError(from, to, seen).error.tail<3>().norm() > 0.99;
}

RC_GTEST_PROP(PoseGraph3D, TheErrorEqualsTheDefinitionOfG2o, ()) {
  RandomStream random = anyStream();
  const Pose3 from = randomPose3(random, 2.0), to = randomPose3(random, 2.0), seen = randomPose3(random, 2.0);
  RC_PRE(!nearTurn(from, to, seen));
  RC_ASSERT((edgeError(from, to, seen).error - errorByMatrices(from, to, seen)).norm() < 1e-9);
}

RC_GTEST_PROP(PoseGraph3D, JacobiansAreTheNumericDerivativesOfTheError, ()) {
  RandomStream random = anyStream();
  const Pose3 from = randomPose3(random, 2.0), to = randomPose3(random, 2.0), seen = randomPose3(random, 2.0);
  RC_PRE(!nearTurn(from, to, seen));
  const EdgeError3D e = edgeError(from, to, seen);
  const auto by_from = derivative([&](const Vector6d& d) { return errorByMatrices(moved(from, d), to, seen); });
  const auto by_to = derivative([&](const Vector6d& d) { return errorByMatrices(from, moved(to, d), seen); });
  RC_ASSERT((e.jacobian_from * numbersByStep(from) - by_from).norm() < 1e-6 * (1.0 + by_from.norm()));
  RC_ASSERT((e.jacobian_to * numbersByStep(to) - by_to).norm() < 1e-6 * (1.0 + by_to.norm()));
}

RC_GTEST_PROP(PoseGraph3D, PosesFormAGroup, ()) {
  RandomStream random = anyStream();
  const auto near = [](const Pose3& a, const Pose3& b) {
    return (a.position_m - b.position_m).norm() < 1e-9 && a.rotation.angularDistance(b.rotation) < 1e-7;
  };
  const Pose3 a = randomPose3(random, 2.0), b = randomPose3(random, 2.0), c = randomPose3(random, 2.0);
  RC_ASSERT(near((a * b) * c, a * (b * c)));
  RC_ASSERT(near(a * a.inverse(), Pose3{}));
  RC_ASSERT(near((a * b).inverse(), b.inverse() * a.inverse()));
}

RC_GTEST_PROP(PoseGraph3D, TheErrorDoesNotDependOnTheFrameOfTheMap, ()) {
  RandomStream random = anyStream();
  const Pose3 from = randomPose3(random, 1.0), to = randomPose3(random, 1.0), seen = randomPose3(random, 1.0);
  const Pose3 frame = randomPose3(random, 5.0);
  RC_PRE(!nearTurn(from, to, seen));
  RC_ASSERT((edgeError(frame * from, frame * to, seen).error - edgeError(from, to, seen).error).norm() < 1e-9);
  RC_ASSERT(edgeError(from, from * seen, seen).error.norm() < 1e-9);
}

/// Plain Gauss-Newton on a dense matrix, the first pose fixed.
std::vector<Pose3> denseGaussNewton(const PoseGraph3D& graph) {
  std::vector<Pose3> poses = graph.poses;
  const auto size = static_cast<Eigen::Index>(6 * poses.size());
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(size);
    for (const PoseEdge3D& edge : graph.edges) {
      const Pose3 &from = poses[static_cast<std::size_t>(edge.from)], &to = poses[static_cast<std::size_t>(edge.to)];
      Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian = Eigen::MatrixXd::Zero(6, size);
      jacobian.middleCols<6>(Eigen::Index{6} * edge.from) =
          derivative([&](const Vector6d& d) { return errorByMatrices(moved(from, d), to, edge.T_from_to); });
      jacobian.middleCols<6>(Eigen::Index{6} * edge.to) =
          derivative([&](const Vector6d& d) { return errorByMatrices(from, moved(to, d), edge.T_from_to); });
      hessian += jacobian.transpose() * edge.information * jacobian;
      gradient += jacobian.transpose() * edge.information * errorByMatrices(from, to, edge.T_from_to);
    }
    const Eigen::VectorXd step = hessian.bottomRightCorner(size - 6, size - 6).ldlt().solve(-gradient.tail(size - 6));
    for (std::size_t i = 1; i < poses.size(); ++i)
      poses[i] = moved(poses[i], step.segment<6>(6 * static_cast<Eigen::Index>(i - 1)));
  }
  return poses;
}

TEST(PoseGraph3D, TheOptimumEqualsThatOfDenseGaussNewton) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, "dense");
    const PoseGraph3D graph = noisyGraph<Graph3D>(8, 0.05, 0.05, random);
    PoseGraphConfig config;
    config.relative_decrease = 1e-14;
    const PoseGraphSolution<common::Pose3> solution = optimize(graph, config);
    const std::vector<Pose3> expected = denseGaussNewton(graph);
    EXPECT_TRUE(solution.converged);
    EXPECT_NEAR(sum(solution.squared_errors), sum(squaredErrors(graph, expected)), 1e-6);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LT((solution.poses[i].position_m - expected[i].position_m).norm(), 1e-5);
      EXPECT_LT(solution.poses[i].rotation.angularDistance(expected[i].rotation), 1e-5);
    }
  }
}

/// A closed ring in space that climbs and comes back, with an edge from each pose to the next.
PoseGraph3D ring(int size, RandomStream& random, std::vector<Pose3>& truth) {
  PoseGraph3D graph;
  for (int i = 0; i < size; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / size;
    truth.push_back({common::quaternionFrom({0.2 * std::sin(angle), 0.1, angle}),
                     {10.0 * std::cos(angle), 10.0 * std::sin(angle), 2.0 * std::sin(2.0 * angle)}});
  }
  for (int i = 0; i < size; ++i) {
    PoseEdge3D edge;
    edge.from = i;
    edge.to = (i + 1) % size;
    edge.T_from_to = truth[static_cast<std::size_t>(edge.from)].inverse() * truth[static_cast<std::size_t>(edge.to)] *
                     randomPose3(random, 0.01);
    edge.information = 1e4 * Matrix6d::Identity();
    graph.edges.push_back(edge);
  }
  graph.poses = truth;
  graph.poses = chainedPoses(graph);
  return graph;
}

double worst(const std::vector<Pose3>& a, const std::vector<Pose3>& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) distance = std::max(distance, (a[i].position_m - b[i].position_m).norm());
  return distance;
}

TEST(PoseGraph3D, AFalseClosureDoesNotBendTheMap) {
  RandomStream random(3, "ring");
  std::vector<Pose3> truth;
  PoseGraph3D graph = ring(60, random, truth);
  const double honest_m = worst(optimize(graph, {}).poses, truth);
  EXPECT_LT(honest_m, 0.5);
  PoseEdge3D lie;
  lie.from = 5;
  lie.to = 35;
  lie.information = 1e4 * Matrix6d::Identity();
  lie.robust = true;
  graph.edges.push_back(lie);
  const PoseGraphSolution<common::Pose3> robust = optimize(graph, {});
  EXPECT_LT(worst(robust.poses, truth), honest_m + 0.10);
  EXPECT_GT(robust.squared_errors.back(), 1000.0);
  graph.edges.back().robust = false;
  EXPECT_GT(worst(optimize(graph, {}).poses, truth), 1.0) << "without the kernel it does";
}

TEST(PoseGraph3D, TheSameGraphGivesIdenticalResults) {
  RandomStream random(5, "ring");
  std::vector<Pose3> truth;
  const PoseGraph3D graph = ring(100, random, truth);
  const auto a = optimize(graph, {}), b = optimize(graph, {});
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].position_m, b.poses[i].position_m);
    EXPECT_EQ(a.poses[i].rotation.coeffs(), b.poses[i].rotation.coeffs());
  }
}

TEST(PoseGraph3D, FixedPosesAndPosesWithoutEdgesStay) {
  RandomStream random(6, "fixed");
  PoseGraph3D graph = noisyGraph<Graph3D>(6, 0.05, 0.05, random);
  graph.fixed = {2, 4};
  graph.poses.push_back(randomPose3(random, 3.0));
  const PoseGraphSolution<common::Pose3> solution = optimize(graph, {});
  for (const std::size_t i : {2, 4, 6}) {
    EXPECT_EQ(solution.poses[i].position_m, graph.poses[i].position_m) << i;
    EXPECT_LT(solution.poses[i].rotation.angularDistance(graph.poses[i].rotation), 1e-12) << i;
  }
  EXPECT_NE(solution.poses[0].position_m, graph.poses[0].position_m);
  EXPECT_TRUE(optimize(PoseGraph3D{}, {}).poses.empty());
}

TEST(PoseGraph3D, StopsAfterTheIterationLimit) {
  RandomStream random(7, "stop");
  PoseGraphConfig config;
  config.max_iterations = 1;
  const auto solution = optimize(noisyGraph<Graph3D>(20, 0.1, 0.3, random), config);
  EXPECT_LE(solution.iterations, 1);
  EXPECT_FALSE(solution.converged);
}

}  // namespace
}  // namespace swiftlet::optimization
