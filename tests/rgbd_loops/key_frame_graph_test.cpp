// Loop closures that are right, wrong, and impossible for the path between their key frames.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "mapping3d/loops/key_frame_graph.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

Matrix6d informationOf(double sigma_m, double sigma_rad) {
  Matrix6d information = Matrix6d::Zero();
  information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
  information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return information;
}

/// A square of 4 x 8 steps of 0.5 m that turns at its corners.
Pose3 truth(int i) {
  Pose3 pose;
  for (int k = 1; k <= i; ++k)
    pose = pose * (k % 8 == 0 ? Pose3{common::expSO3({0.0, 0.0, 0.5 * std::numbers::pi}), {0.5, 0.0, 0.0}}
                              : Pose3{Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0}});
  return pose;
}

/// The same as it is measured: each step turns by 0.15 degrees too much and tilts by half of that.
KeyFrameGraph drifted(const KeyFrameGraphConfig& config, int nodes) {
  const Pose3 error{common::expSO3({0.0, 0.0013, 0.0026}), Eigen::Vector3d::Zero()};
  KeyFrameGraph graph(config);
  Pose3 pose;
  for (int i = 0; i < nodes; ++i) {
    if (i == 0) {
      (void)graph.add(common::Time::fromSeconds(i), pose, {});
      continue;
    }
    const Pose3 step = truth(i - 1).inverse() * truth(i) * error;
    pose = pose * step;
    const std::vector<KeyFrameEdge> edges{{i - 1, step, informationOf(0.005, 0.003)}};
    (void)graph.add(common::Time::fromSeconds(i), pose, edges);
  }
  return graph;
}

double errorAt_m(const KeyFrameGraph& graph, int i) {
  return (graph.poses()->T_map_level(i).position_m - truth(i).position_m).norm();
}

KeyFrameEdge rightLoop(int from, int to) {
  return {from, truth(from).inverse() * truth(to), informationOf(0.005, 0.003)};
}

TEST(KeyFrameGraph, ALoopClosureSpreadsTheDriftOverTheLoop) {
  KeyFrameGraph graph = drifted({}, 33);
  const double middle_m = errorAt_m(graph, 16);
  EXPECT_GT(errorAt_m(graph, 32), 0.2);
  EXPECT_EQ(graph.close(std::vector{rightLoop(0, 32)}), 1);
  EXPECT_LT(errorAt_m(graph, 32), 0.02);
  EXPECT_LT(errorAt_m(graph, 16), middle_m);
  EXPECT_EQ(errorAt_m(graph, 0), 0.0);
}

TEST(KeyFrameGraph, ALoopThatThePathDoesNotAllowIsRejected) {
  KeyFrameGraph graph = drifted({}, 30);
  const double before_m = errorAt_m(graph, 29);
  KeyFrameEdge turned = rightLoop(0, 29);
  turned.T_from_to.rotation = turned.T_from_to.rotation * common::expSO3({0.0, 0.0, 0.5});
  KeyFrameEdge aside = rightLoop(0, 29);
  aside.T_from_to.position_m.y() += 6.0;
  EXPECT_EQ(graph.close(std::vector{turned, aside}), 0);
  EXPECT_EQ(graph.rejected(), 2);
  EXPECT_EQ(errorAt_m(graph, 29), before_m);

  KeyFrameGraphConfig unchecked;
  unchecked.drift_m = unchecked.drift_rad = 100.0;
  unchecked.greatest_error = 1e6;
  unchecked.optimization.robust_width = 100.0;
  KeyFrameGraph bent = drifted(unchecked, 30);
  EXPECT_EQ(bent.close(std::vector{turned, aside}), 2);
  EXPECT_GT(errorAt_m(bent, 29), 2.0 * before_m) << "the checks matter";
}

TEST(KeyFrameGraph, ALoopThatTheOthersDoNotConfirmIsTakenOut) {
  KeyFrameGraph graph = drifted({}, 33);
  KeyFrameEdge wrong = rightLoop(1, 32);
  wrong.T_from_to.position_m.x() += 0.4;  // The path allows it.
  ASSERT_TRUE(graph.allows(32, wrong));
  EXPECT_EQ(graph.close(std::vector{rightLoop(0, 32), rightLoop(2, 32), wrong}), 2);
  EXPECT_EQ(graph.rejected(), 1);
  EXPECT_LT(errorAt_m(graph, 32), 0.02);
}

TEST(KeyFrameGraph, EqualEdgesGiveEqualBits) {
  KeyFrameGraph one = drifted({}, 33), other = drifted({}, 33);
  (void)one.close(std::vector{rightLoop(0, 32)});
  (void)other.close(std::vector{rightLoop(0, 32)});
  for (int i = 0; i < 33; ++i)
    EXPECT_EQ(one.poses()->T_map_level(i).position_m, other.poses()->T_map_level(i).position_m);
}

}  // namespace
}  // namespace swiftlet::mapping3d
