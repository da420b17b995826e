// Loop closures that are right, wrong, and impossible for the path between their key frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "common/random.hpp"
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

/// A second piece, whose frame of reference has nothing to do with the first: nodes 10 to 19 of the truth.
const Pose3 kGuess{common::expSO3({0.0, 0.3, 1.0}), {3.0, -2.0, 1.0}};
KeyFrameGraph inTwoPieces() {
  KeyFrameGraph graph({});
  for (int i = 0; i < 20; ++i) {
    const bool begins = i == 0 || i == 10;
    const std::vector<KeyFrameEdge> edges{{i - 1, truth(i - 1).inverse() * truth(i), informationOf(0.005, 0.003)}};
    (void)graph.add(common::Time::fromSeconds(i), (i < 10 ? Pose3{} : kGuess) * truth(i),
                    begins ? std::span<const KeyFrameEdge>{} : edges);
  }
  return graph;
}

TEST(KeyFrameGraph, TwoMeetingsThatAgreeJoinTwoPieces) {
  KeyFrameGraph graph = inTwoPieces();
  EXPECT_EQ(graph.pieceOf(9), 0);
  EXPECT_EQ(graph.pieceOf(10), 1);
  EXPECT_FALSE(graph.join(std::vector{rightLoop(8, 19)}));
  KeyFrameEdge wrong = rightLoop(3, 19);
  wrong.T_from_to.position_m.x() += 1.0;
  EXPECT_FALSE(graph.join(std::vector{wrong})) << "it contradicts the first";
  EXPECT_EQ(graph.pieceOf(19), 1);
  const auto joined = graph.join(std::vector{rightLoop(7, 19)});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->from, 1);
  EXPECT_EQ(joined->into, 0);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(graph.pieceOf(i), 0) << i;
    EXPECT_LT(errorAt_m(graph, i), 0.01) << i;
  }
}

/// The camera is back in the older piece when it meets the newer one.
TEST(KeyFrameGraph, TheNewerPieceMovesWhicheverHasTheNewestKeyFrame) {
  KeyFrameGraph graph = inTwoPieces();
  const std::vector<KeyFrameEdge> edges{{9, truth(9).inverse() * truth(20), informationOf(0.005, 0.003)}};
  (void)graph.add(common::Time::fromSeconds(20), truth(20), edges);
  ASSERT_TRUE(graph.join(std::vector{rightLoop(18, 20), rightLoop(17, 20)}));
  for (int i = 0; i <= 20; ++i) EXPECT_LT(errorAt_m(graph, i), 0.01) << i;
}

/// Each key frame is aligned to the three before it; each alignment errs by itself.
TEST(KeyFrameGraph, EdgesToAllThatOverlapLessenTheDrift) {
  double sums_m[2] = {};
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const int edges_each : {1, 3}) {
      common::RandomStream random(seed, "alignment");
      KeyFrameGraph graph({});
      (void)graph.add({}, {}, {});
      for (int i = 1; i < 24; ++i) {
        std::vector<KeyFrameEdge> edges;
        for (int from = i - 1; from >= std::max(0, i - 3); --from) {
          const Eigen::Vector3d turn(random.gaussian(), random.gaussian(), random.gaussian());
          const Pose3 error{common::expSO3(0.003 * turn), {random.gaussian(0.005), random.gaussian(0.005), 0.0}};
          if (i - from <= edges_each)
            edges.push_back({from, truth(from).inverse() * truth(i) * error, informationOf(0.005, 0.003)});
        }
        (void)graph.add(common::Time::fromSeconds(i), graph.poses()->T_map_level(i - 1) * edges.front().T_from_to,
                        edges);
        graph.adjustNewest();
      }
      sums_m[edges_each / 3] += errorAt_m(graph, 23);
    }
  EXPECT_LT(sums_m[1], 0.8 * sums_m[0]) << sums_m[1] / 20 << " m and " << sums_m[0] / 20 << " m";
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
