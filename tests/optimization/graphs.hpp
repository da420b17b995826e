// Random poses and small noisy graphs of the plane and of space, with the truth they were made from.
#pragma once

#include <vector>

#include "common/random.hpp"
#include "optimization/pose_graph_2d.hpp"
#include "optimization/pose_graph_3d.hpp"

namespace swiftlet::optimization::test {

inline common::Pose2 randomPose2(common::RandomStream& random, double size) {
  return {random.gaussian(size), random.gaussian(size), common::wrapAngle(random.gaussian(size))};
}

inline common::Pose3 randomPose3(common::RandomStream& random, double size) {
  const auto vector = [&] {
    return Eigen::Vector3d(random.gaussian(size), random.gaussian(size), random.gaussian(size));
  };
  const Eigen::Vector3d position_m = vector();
  return {common::expSO3(vector()), position_m};
}

/// A random symmetric positive definite matrix whose axes are not those of the frame.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> randomInformation(common::RandomStream& random) {
  Eigen::Matrix<double, kSize, kSize> root;
  for (int i = 0; i < root.size(); ++i) root.data()[i] = random.gaussian(3.0);
  return root * root.transpose() + Eigen::Matrix<double, kSize, kSize>::Identity();
}

struct Graph2D {
  using Graph = PoseGraph2D;
  static common::Pose2 randomPose(common::RandomStream& random, double size) { return randomPose2(random, size); }
  static Eigen::Matrix3d information(common::RandomStream& random) { return randomInformation<3>(random); }
};

struct Graph3D {
  using Graph = PoseGraph3D;
  static common::Pose3 randomPose(common::RandomStream& random, double size) { return randomPose3(random, size); }
  static Matrix6d information(common::RandomStream& random) { return randomInformation<6>(random); }
};

/// `size` poses. Noisy edges connect each pose to the one before and some to others. The guess is the disturbed truth.
template <typename Kind>
typename Kind::Graph noisyGraph(int size, double noise, double guess_noise, common::RandomStream& random) {
  typename Kind::Graph graph;
  decltype(graph.poses) truth;
  for (int i = 0; i < size; ++i) truth.push_back(Kind::randomPose(random, 1.0));
  const auto see = [&](int from, int to) {
    graph.edges.emplace_back();
    auto& edge = graph.edges.back();
    edge.from = from;
    edge.to = to;
    edge.T_from_to = truth[static_cast<std::size_t>(from)].inverse() * truth[static_cast<std::size_t>(to)] *
                     Kind::randomPose(random, noise);
    edge.information = Kind::information(random);
  };
  for (int i = 0; i + 1 < size; ++i) see(i, i + 1);
  for (int i = 0; i + 3 < size; i += 2) see(i + 3, i);
  graph.poses = truth;
  for (std::size_t i = 1; i < truth.size(); ++i) graph.poses[i] = truth[i] * Kind::randomPose(random, guess_noise);
  return graph;
}

template <typename Values>
double sum(const Values& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

}  // namespace swiftlet::optimization::test
