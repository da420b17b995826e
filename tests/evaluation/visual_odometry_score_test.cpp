// The score of visual odometry alone.
#include "evaluation/figure_measures.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::evaluation {
namespace {

using common::Time;

common::Pose3 onTheWay(double seconds) {
  common::Pose3 pose;
  pose.position_m = {seconds, std::sin(seconds), 1.0 + 0.1 * std::cos(2.0 * seconds)};
  pose.rotation = common::quaternionFrom({0.0, 0.0, 0.3 * seconds});
  return pose;
}

common::Trajectory truth() {
  common::Trajectory trajectory;
  for (int i = 0; i <= 200; ++i) trajectory.push_back({Time::fromSeconds(0.05 * i), onTheWay(0.05 * i)});
  return trajectory;
}

/// The same path in a frame of its own, at times between those of the truth.
VisualOdometryRecord tracked(double drift) {
  common::Pose3 T_own_map;
  T_own_map.position_m = {3.0, -2.0, 0.5};
  T_own_map.rotation = common::quaternionFrom({0.1, -0.2, 2.0});
  VisualOdometryRecord record;
  for (double at_s = 0.52; at_s < 9.5; at_s += 0.0667) {
    common::Pose3 pose = onTheWay(at_s);
    pose.position_m.y() += drift * at_s * at_s;
    record.body.push_back({Time::fromSeconds(at_s), T_own_map * pose});
  }
  record.frames = record.body.size();
  return record;
}

FlightScore measured(const VisualOdometryRecord& record, const common::Trajectory& trajectory = truth()) {
  FlightScore score;
  measureVisualOdometry(record, trajectory, score);
  return score;
}

TEST(VisualOdometryScore, ThePathCountsAndNotItsFrame) {
  const FlightScore score = measured(tracked(0.0));
  EXPECT_LT(score.figure("visual_odometry_rms_m").value(), 0.002) << "the truth between two samples";
  EXPECT_EQ(score.figure("visual_odometry_lost_share"), 0.0);
  EXPECT_GT(measured(tracked(0.02)).figure("visual_odometry_rms_m").value(), 0.1);
}

TEST(VisualOdometryScore, LostFramesAreCountedAndTooFewHaveNoError) {
  VisualOdometryRecord record = tracked(0.0);
  record.frames = 2 * record.body.size();
  record.lost = record.body.size();
  EXPECT_EQ(measured(record).figure("visual_odometry_lost_share"), 0.5);
  record.body.resize(1);
  EXPECT_FALSE(measured(record).figure("visual_odometry_rms_m"));
  EXPECT_FALSE(measured({}).figure("visual_odometry_lost_share"));
}

TEST(VisualOdometryScore, WhereTheTruthHasAGapNothingIsCompared) {
  VisualOdometryRecord record = tracked(0.0);
  common::Trajectory gap = truth();
  gap.erase(gap.begin() + 1, gap.end() - 1);
  EXPECT_FALSE(measured(record, gap).figure("visual_odometry_rms_m"));
}

}  // namespace
}  // namespace swiftlet::evaluation
