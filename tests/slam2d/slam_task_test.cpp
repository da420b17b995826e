#include "perception/slam2d/slam_task_data.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "perception/slam2d/loop_consensus.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;

Eigen::Matrix3d covarianceOf(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// Key scans along a line, a metre apart, connected in sequence.
SlamGraph line(int keys) {
  SlamGraph graph;
  for (int i = 0; i < keys; ++i) graph.keys.push_back({nullptr, Pose2{1.0 * i, 0.0, 0.0}, {}, {}});
  for (int i = 1; i < keys; ++i) graph.add({i - 1, i, Pose2{1.0, 0.0, 0.0}, covarianceOf(0.02, 0.005), false});
  return graph;
}

SlamTask lastTaskOf(const SlamGraph& graph) {
  auto data = std::make_shared<SlamTask::Data>();
  data->graph = graph;
  data->query = static_cast<int>(graph.keys.size()) - 1;
  data->is_last = true;
  data->config.live_map = false;
  return SlamTask{std::move(data)};
}

TEST(SlamTask, RejectsAClosureThatTheOthersContradict) {
  SlamGraph graph = line(12);
  graph.add({0, 11, Pose2{11.0, 0.05, 0.0}, covarianceOf(0.02, 0.005), true});
  graph.add({1, 10, Pose2{6.0, 2.0, 0.3}, covarianceOf(0.02, 0.005), true});  // Of another corridor, so it is false.
  graph.add({2, 9, Pose2{7.0, 0.0, 0.0}, covarianceOf(0.02, 0.005), true});
  const SlamResult result = run(lastTaskOf(graph));
  ASSERT_EQ(result.data->rejected_edges, std::vector<int>{12});
  ASSERT_EQ(result.data->T_map_key.size(), 12U);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(result.data->T_map_key[static_cast<std::size_t>(i)].x_m, i, 0.03);
    EXPECT_NEAR(result.data->T_map_key[static_cast<std::size_t>(i)].y_m, 0.0, 0.06);
  }
}

TEST(SlamTask, KeepsClosuresThatAgree) {
  SlamGraph graph = line(12);
  graph.add({0, 11, Pose2{11.03, 0.05, 0.0}, covarianceOf(0.02, 0.005), true});
  graph.add({2, 9, Pose2{7.01, 0.01, 0.002}, covarianceOf(0.02, 0.005), true});
  EXPECT_TRUE(run(lastTaskOf(graph)).data->rejected_edges.empty());
}

FoundLoop loopOf(int from, int to, const Pose2& T_from_to) {
  FoundLoop loop;
  loop.edge = {from, to, T_from_to, covarianceOf(0.02, 0.005), true};
  return loop;
}

/// There and back along a corridor, where the return path was closed a metre off. In truth the key scan i > 14 is at 29
/// - i; its estimate is 30 - i.
SlamGraph closedAMetreOff() {
  SlamGraph graph = line(30);
  for (int i = 15; i < 30; ++i) graph.keys[static_cast<std::size_t>(i)].T_map_body.x_m = 30.0 - i;
  for (SlamEdge& edge : graph.edges)
    if (edge.from >= 15) edge.T_from_to.x_m = -1.0;
  graph.edges[14].T_from_to.x_m = 0.5;  // Between 14 and 15 nothing was observable along the corridor.
  graph.edges[14].covariance = covarianceOf(1.0, 0.005);
  graph.add({6, 24, Pose2{0.0, 0.0, 0.0}, covarianceOf(0.02, 0.005), true});
  graph.add({4, 26, Pose2{0.0, 0.0, 0.0}, covarianceOf(0.02, 0.005), false});  // Matched to key scan 4.
  return graph;
}

TEST(LoopConsensus, EnoughAgreeingClosuresReplaceTheEdgesThatRejectedThem) {
  const SlamGraph graph = closedAMetreOff();
  std::vector<FoundLoop> rejected;
  for (const int key : {23, 25, 27}) {
    const FoundLoop loop = loopOf(29 - key, key, Pose2{});
    const LoopConsensus alone = optimizeWithRejection(graph, {loop}, {});
    EXPECT_TRUE(alone.accepted.empty() && alone.rejected_edges.empty()) << "one is not enough";
    rejected.push_back(loop);
    EXPECT_EQ(consensusOfRejected(graph, rejected, {}).has_value(), key == 27);
  }
  const auto over = consensusOfRejected(graph, rejected, {});
  ASSERT_TRUE(over);
  EXPECT_EQ(over->rejected_edges, (std::vector<int>{29, 30}));
  EXPECT_EQ(over->accepted.size(), 3U);
  for (int i = 15; i < 30; ++i) EXPECT_NEAR(over->T_map_key[static_cast<std::size_t>(i)].x_m, 29.0 - i, 0.05);
}

TEST(LoopConsensus, DisagreeingClosuresReplaceNothing) {
  const SlamGraph graph = closedAMetreOff();
  const std::vector<FoundLoop> rejected{loopOf(7, 22, Pose2{0.6, 0.3, 0.0}), loopOf(5, 24, Pose2{-0.8, 0.0, 0.2}),
                                        loopOf(3, 26, Pose2{2.0, 0.0, 0.0})};
  EXPECT_FALSE(consensusOfRejected(graph, rejected, {}));
}

TEST(SlamGraph, UncertaintyToGivenKeysEqualsThatOfTheFullSearch) {
  SlamGraph graph = line(40);
  graph.add({3, 30, Pose2{27.0, 0.0, 0.0}, covarianceOf(0.03, 0.01), true});
  const std::vector<int> wanted{2, 5, 30};
  const auto all = projectUncertainty(graph, 0, 100.0), some = projectUncertainty(graph, 0, 100.0, wanted);
  ASSERT_EQ(all.size(), 40U);
  ASSERT_LT(some.size(), 30U);
  for (const int key : wanted) {
    const auto of = [&](const std::vector<ProjectedUncertainty>& in) {
      return std::find_if(in.begin(), in.end(), [&](const ProjectedUncertainty& u) { return u.key == key; });
    };
    ASSERT_NE(of(some), some.end()) << key;
    EXPECT_EQ(of(some)->sigma_m, of(all)->sigma_m);
  }
}

TEST(SlamGraph, RemovedEdgesCarryNoUncertainty) {
  SlamGraph graph = line(6);
  graph.add({0, 5, Pose2{5.0, 0.0, 0.0}, covarianceOf(0.001, 0.0001), true});
  graph.add({1, 4, Pose2{3.0, 0.0, 0.0}, covarianceOf(0.001, 0.0001), true});
  const auto sigmaOf = [&](int key) {
    for (const ProjectedUncertainty& u : projectUncertainty(graph, 0, 100.0))
      if (u.key == key) return u.sigma_m;
    return -1.0;
  };
  const double closed_m = sigmaOf(5);
  graph.remove(5);
  ASSERT_EQ(graph.edges.size(), 6U);
  EXPECT_EQ(graph.edges.back().from, 1);
  EXPECT_GT(sigmaOf(5), 5.0 * closed_m);
  for (std::size_t key = 0; key < graph.keys.size(); ++key)
    for (const int edge : graph.keys[key].edges) {
      const SlamEdge& e = graph.edges.at(static_cast<std::size_t>(edge));
      EXPECT_TRUE(e.from == static_cast<int>(key) || e.to == static_cast<int>(key));
    }
}

/// The scans that saw somebody go are not all kept; the map that is drawn again has nobody there, wherever its key
/// scans have moved, until somebody comes back.
TEST(SlamGraph, WhatHasGoneStaysGoneWhenTheMapIsDrawnAgain) {
  const auto scanOf = [](double range_m, double at_s) {
    auto scan = std::make_shared<DrawnScan>();
    scan->stamp = common::Time::fromSeconds(at_s);
    scan->body_height_m = 1.0;
    for (double angle = -0.3; angle < 0.3; angle += 0.01)
      scan->hits_level_m.emplace_back(range_m * std::cos(angle), range_m * std::sin(angle), 0.0);
    return scan;
  };
  SlamGraph graph = line(2);
  for (int i = 0; i < 8; ++i) graph.keys[0].drawn.push_back({scanOf(1.5, 1.0 + 0.25 * i), {}});
  const auto occupiedAt = [&](double x_m) {
    const common::OccupancyGrid grid = drawMap(graph, {}).atFlightHeight();
    return common::occupancy::isOccupied(grid.at(grid.cellAt(x_m, 0.0)));
  };
  ASSERT_TRUE(occupiedAt(1.5));
  graph.keys[1].T_map_body = {};
  AttachedScan last{scanOf(3.0, 4.0), {}};
  for (double angle = -0.35; angle < 0.35; angle += 0.01)
    last.gone_key_m.emplace_back(1.5 * std::cos(angle), 1.5 * std::sin(angle));
  graph.keys[1].drawn.push_back(last);
  EXPECT_FALSE(occupiedAt(1.5));
  for (KeyScan& key : graph.keys) key.T_map_body.x_m = 0.63;
  EXPECT_FALSE(occupiedAt(2.13));
  for (int i = 0; i < 4; ++i) graph.keys[1].drawn.push_back({scanOf(1.5, 5.0 + 0.25 * i), {}});
  EXPECT_TRUE(occupiedAt(2.13));
}

}  // namespace
}  // namespace swiftlet::perception
