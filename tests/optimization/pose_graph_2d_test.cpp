#include "optimization/pose_graph_2d.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace swiftlet::optimization {
namespace {

using common::Pose2;

Pose2 randomPose(common::RandomStream& random) {
  return {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.1, 3.1)};
}

Pose2 added(const Pose2& pose, int axis, double step) {
  Pose2 moved = pose;
  (axis == 0 ? moved.x_m : axis == 1 ? moved.y_m : moved.yaw_rad) += step;
  return moved;
}

/// A ring of poses with a noisy edge from each to the next, and one edge that closes the ring.
PoseGraph2D ring(int size, std::uint64_t seed, std::vector<Pose2>& truth) {
  common::RandomStream random(seed, "ring");
  truth.clear();
  for (int i = 0; i < size; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / size;
    truth.push_back({10.0 * std::cos(angle), 10.0 * std::sin(angle), common::wrapAngle(angle + 1.0)});
  }
  PoseGraph2D graph;
  graph.poses.push_back(truth.front());
  const Eigen::Matrix3d information = Eigen::Vector3d(1e4, 1e4, 1e5).asDiagonal();
  for (int i = 0; i < size; ++i) {
    const int next = (i + 1) % size;
    Pose2 seen = truth[static_cast<std::size_t>(i)].inverse() * truth[static_cast<std::size_t>(next)];
    seen.x_m += random.gaussian(0.01);
    seen.y_m += random.gaussian(0.01);
    seen.yaw_rad += random.gaussian(0.00316);
    graph.edges.push_back({i, next, seen, information, next == 0});
    if (next != 0) graph.poses.push_back(graph.poses.back() * seen);
  }
  return graph;
}

double worst(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    distance = std::max(distance, (a[i].position_m() - b[i].position_m()).norm());
  return distance;
}

TEST(PoseGraph2D, JacobiansAreTheNumericDerivativesOfTheError) {
  common::RandomStream random(1, "jacobians");
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < 100; ++trial) {
    const Pose2 from = randomPose(random), to = randomPose(random);
    const Pose2 near = Pose2{random.gaussian(0.1), random.gaussian(0.1), random.gaussian(0.1)};
    const Pose2 seen = from.inverse() * to * near;
    const EdgeError2D e = edgeError(from, to, seen);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d by_from =
          (edgeError(added(from, axis, kStep), to, seen).error - edgeError(added(from, axis, -kStep), to, seen).error) /
          (2.0 * kStep);
      const Eigen::Vector3d by_to =
          (edgeError(from, added(to, axis, kStep), seen).error - edgeError(from, added(to, axis, -kStep), seen).error) /
          (2.0 * kStep);
      EXPECT_LT((e.jacobian_from.col(axis) - by_from).norm(), 1e-6);
      EXPECT_LT((e.jacobian_to.col(axis) - by_to).norm(), 1e-6);
    }
  }
}

TEST(PoseGraph2D, ClosingTheRingRemovesTheDrift) {
  std::vector<Pose2> truth;
  const PoseGraph2D graph = ring(100, 3, truth);
  const PoseGraphSolution<common::Pose2> solution = optimize(graph, {});
  EXPECT_TRUE(solution.converged);
  EXPECT_LT(worst(solution.poses, truth), 0.5 * worst(graph.poses, truth));
  // With one loop, the errors have three degrees of freedom.
  double sum = 0.0;
  for (const double e : solution.squared_errors) sum += e;
  EXPECT_LT(sum, 20.0);
}

TEST(PoseGraph2D, AFalseClosureDoesNotBendTheMap) {
  std::vector<Pose2> truth;
  PoseGraph2D graph = ring(100, 3, truth);
  const double honest_m = worst(optimize(graph, {}).poses, truth);
  PoseEdge2D lie{10, 60, {0.0, 0.0, 0.0}, Eigen::Vector3d(1e4, 1e4, 1e5).asDiagonal(), true};
  graph.edges.push_back(lie);
  const PoseGraphSolution<common::Pose2> robust = optimize(graph, {});
  EXPECT_LT(worst(robust.poses, truth), honest_m + 0.10);
  EXPECT_GT(robust.squared_errors.back(), 1000.0);
  // Without the robust kernel the false closure bends the map.
  graph.edges.back().robust = false;
  EXPECT_GT(worst(optimize(graph, {}).poses, truth), 1.0);
}

TEST(PoseGraph2D, TheSameGraphGivesIdenticalResults) {
  std::vector<Pose2> truth;
  const PoseGraph2D graph = ring(200, 5, truth);
  const auto a = optimize(graph, {}), b = optimize(graph, {});
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].x_m, b.poses[i].x_m);
    EXPECT_EQ(a.poses[i].y_m, b.poses[i].y_m);
    EXPECT_EQ(a.poses[i].yaw_rad, b.poses[i].yaw_rad);
  }
}

TEST(PoseGraph2D, PosesWithoutEdgesStay) {
  PoseGraph2D graph;
  graph.poses = {{0, 0, 0}, {1.2, 0, 0}, {7, 8, 1}};
  graph.edges.push_back({0, 1, {1, 0, 0}, Eigen::Matrix3d::Identity(), false});
  const auto solution = optimize(graph, {});
  EXPECT_NEAR(solution.poses[1].x_m, 1.0, 1e-6);
  EXPECT_NEAR(solution.poses[2].x_m, 7.0, 1e-9);
  EXPECT_TRUE(optimize(PoseGraph2D{}, PoseGraphConfig{}).poses.empty());
}

TEST(PoseGraph2D, StopsAfterTheIterationLimit) {
  std::vector<Pose2> truth;
  PoseGraphConfig config;
  config.max_iterations = 1;
  const auto solution = optimize(ring(100, 3, truth), config);
  EXPECT_EQ(solution.iterations, 1);
  EXPECT_FALSE(solution.converged);
}

}  // namespace
}  // namespace swiftlet::optimization
