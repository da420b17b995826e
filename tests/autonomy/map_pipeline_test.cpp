// The map as a step of the estimator: scans in, corrections out. What is relative to key scans moves with them.
#include "autonomy/estimation/map_pipeline.hpp"

#include <gtest/gtest.h>

#include "perception/slam2d/slam_method.hpp"
#include "tests/slam2d/ring.hpp"

namespace swiftlet::autonomy {
namespace {

using common::KeyPoses;
using common::Pose2;
using common::Time;

TEST(KeyPoses, APoseRelativeToAKeyScanMovesWithIt) {
  const common::KeyRelativePose seen{1, common::lifted(Pose2{0.5, 0.0, 0.0}, 1.2)};
  const KeyPoses before{1, {{Time{}, {0, 0, 0}}, {Time{}, {10, 0, 0}}}};
  EXPECT_TRUE(before.inMap(seen).position_m.isApprox(Eigen::Vector3d(10.5, 0, 1.2)));
  const KeyPoses after{2, {{Time{}, {0, 0, 0}}, {Time{}, {10, 1, 0.5 * std::numbers::pi}}}};
  EXPECT_TRUE(after.inMap(seen).position_m.isApprox(Eigen::Vector3d(10, 1.5, 1.2)));
}

/// One round of a square corridor with an odometry that has errors of heading and scale.
TEST(MapPipeline, ALoopClosureCorrectsEarlierScans) {
  const test::Ring ring;
  const auto jobs = common::makeLockstepJobs(0);
  common::EventLog log;
  MapPipeline map({}, common::Duration::fromSeconds(0.4), *jobs, log);
  struct Seen {
    common::KeyRelativePose at_key;
    Pose2 T_map_body, truth;
  };
  std::vector<Seen> seen;
  std::vector<common::Event> events;
  ring.fly(1.25, [&](const perception::ProjectedScan& scan, const Pose2& T_odom_body, const Eigen::Matrix3d& covariance,
                     const Pose2& truth) {
    jobs->deliverDue(scan.stamp);
    const MapStep step = map.add({scan, common::lifted(T_odom_body, 1.0), covariance, true}, scan.stamp);
    ASSERT_TRUE(step.at_key);
    EXPECT_LT((planar(map.keyPoses()->inMap(*step.at_key)).position_m() - step.T_map_body.position_m()).norm(), 1e-9);
    seen.push_back({*step.at_key, step.T_map_body, truth});
    for (common::Event& event : log.take()) events.push_back(std::move(event));
  });
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].text.substr(0, 11), "loop closed");

  const auto keys = map.keyPoses();
  double worst_then_m = 0.0, worst_now_m = 0.0;
  for (const Seen& s : seen) {
    worst_then_m = std::max(worst_then_m, (s.T_map_body.position_m() - s.truth.position_m()).norm());
    worst_now_m = std::max(worst_now_m, (planar(keys->inMap(s.at_key)).position_m() - s.truth.position_m()).norm());
  }
  EXPECT_GT(worst_then_m, 0.25) << "the odometry drifts that far";
  EXPECT_LT(worst_now_m, 0.5 * worst_then_m) << "nothing was measured again";
  EXPECT_EQ(map.keyPoses(), keys) << "the same object until a key scan is added or moved";
}

/// This holds for every SLAM method.
TEST(MapPipeline, AScanThatDidNotMatchIsPlacedButNotDrawn) {
  using perception::SlamMethod;
  for (const SlamMethod method : {SlamMethod::kGraph, SlamMethod::kParticles, SlamMethod::kScanToMap}) {
    const test::Ring ring;
    const auto jobs = common::makeLockstepJobs(0);
    perception::SlamMethodConfig config;
    config.method = method;
    common::EventLog log;
    MapPipeline map(config, common::Duration::fromSeconds(0.4), *jobs, log);
    int scans = 0;
    ring.fly(0.1, [&](const perception::ProjectedScan& scan, const Pose2& T_odom_body,
                      const Eigen::Matrix3d& covariance, const Pose2&) {
      const bool matched = ++scans <= 10;
      const auto grid = map.grid();
      const MapStep step = map.add({scan, common::lifted(T_odom_body, 1.0), covariance, matched}, scan.stamp);
      ASSERT_TRUE(step.at_key);
      EXPECT_LT((planar(map.keyPoses()->inMap(*step.at_key)).position_m() - step.T_map_body.position_m()).norm(), 1e-9);
      EXPECT_TRUE(matched || map.grid() == grid);
    });
    EXPECT_EQ(map.counts().scans, 10u);
    EXPECT_EQ(map.keyPoses()->keys.size(), map.counts().key_scans);
  }
}

TEST(MapPipeline, ThereIsNoKeyScanBeforeTheFirstScan) {
  const auto jobs = common::makeLockstepJobs(0);
  common::EventLog log;
  MapPipeline map({}, common::Duration::fromSeconds(0.4), *jobs, log);
  EXPECT_TRUE(map.keyPoses()->keys.empty());
  EXPECT_FALSE(map.add({perception::ProjectedScan{}, {}, Eigen::Matrix3d::Zero(), false}, Time{}).at_key);
}

}  // namespace
}  // namespace swiftlet::autonomy
