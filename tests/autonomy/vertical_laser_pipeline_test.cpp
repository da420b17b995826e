// Sweeps of an upright laser on their way into the 3D map: when they are placed and drawn, and what is said.
#include "autonomy/estimation/vertical_laser_pipeline.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/submap3d.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

class VerticalLaserStory : public testing::Test {
 protected:
  static common::LaserConfig upright() {
    common::LaserConfig laser;
    laser.mount.pitch_deg = 90.0;
    return laser;
  }
  static std::shared_ptr<const common::KeyPoses> keysAt(std::uint64_t version, const common::Pose2& pose) {
    return std::make_shared<const common::KeyPoses>(common::KeyPoses{version, {{{}, pose}}});
  }
  /// In a pipe of 2.02 m radius along the axis of flight, all beams have the same range.
  static std::shared_ptr<const common::VerticalScan> sweepAt(double time_s) {
    const common::LaserConfig laser = upright();
    common::VerticalScan sweep;
    sweep.stamps = {Time::fromSeconds(time_s), Time::fromSeconds(time_s + 0.03)};
    sweep.time_increment = common::Duration::fromNanoseconds(17'361);
    sweep.angle_min_rad = laser.angleMin_rad();
    sweep.angle_increment_rad = laser.angleIncrement_rad();
    sweep.range_min_m = laser.range_min_m;
    sweep.range_max_m = laser.range_max_m;
    sweep.ranges_m.assign(static_cast<std::size_t>(laser.beams), 2.02F);
    return std::make_shared<const common::VerticalScan>(std::move(sweep));
  }
  /// The vehicle flies along the pipe with 1 m/s.
  static SweepSituation flying() {
    return {0, [](Time time) { return common::Pose3{Eigen::Quaterniond::Identity(), {time.seconds(), 0.0, 1.0}}; }, {}};
  }
  void see(double time_s, const std::optional<SweepSituation>& situation = flying()) {
    pipeline_.add(sweepAt(time_s));
    ASSERT_TRUE(pipeline_.next());
    pipeline_.place(situation);
    pipeline_.draw(keys_, Time::fromSeconds(time_s + 0.04));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.1));
  }
  std::vector<std::string> texts() {
    std::vector<std::string> texts;
    for (const common::Event& event : log_.take()) texts.push_back(event.text);
    return texts;
  }

  std::shared_ptr<const common::KeyPoses> keys_ = keysAt(1, {});
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  common::EventLog log_;
  VerticalLaserPipeline pipeline_{VerticalLaserPipelineConfig(), upright(), *jobs_, log_};
};

TEST_F(VerticalLaserStory, DrawsThePipeThatItFliesThrough) {
  EXPECT_EQ(pipeline_.layer(keys_), nullptr);
  for (int i = 0; i < 60; ++i) see(0.025 * i);
  const auto layer = pipeline_.layer(keys_);
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->frame, nullptr) << "there is no camera";
  ASSERT_EQ(layer->submaps->size(), 1u);
  const common::Submap3d& submap = layer->submaps->front();
  EXPECT_GT(submap.points->size(), 5'000u);
  for (const common::SurfacePoint& point : *submap.points) {
    const Eigen::Vector3d at = submap.T_map_submap(*keys_) * point.position_m.cast<double>();
    EXPECT_NEAR(std::hypot(at.y(), at.z() - 1.0), 2.02, 0.01);
    EXPECT_LT(at.x(), 1.5);
  }
  const common::Pose3 T_submap_map = submap.T_map_submap(*keys_).inverse();
  const auto at = [&](double x_m, double y_m, double z_m) {
    return submap.voxels->voxelAt(T_submap_map * Eigen::Vector3d(x_m, y_m, z_m));
  };
  EXPECT_TRUE(submap.voxels->isFree(at(0.8, 0.9, 1.0)));
  EXPECT_TRUE(submap.voxels->isOccupied(at(0.8, 2.02, 1.02)));
  EXPECT_FALSE(submap.voxels->isKnown(at(0.8, 0.0, 2.5))) << "it does not look straight up";
}

TEST_F(VerticalLaserStory, TheMapMovesWithTheKeyScans) {
  for (int i = 0; i < 20; ++i) see(0.025 * i);
  const auto first = pipeline_.layer(keys_);
  EXPECT_EQ(pipeline_.layer(keys_), first) << "nothing has changed";
  const auto moved_keys = keysAt(2, {0.5, 0.0, 0.0});
  const auto moved = pipeline_.layer(moved_keys);
  EXPECT_EQ(moved->submaps, first->submaps) << "nothing is drawn again";
  EXPECT_NEAR(moved->submaps->front().T_map_submap(*moved->keys).position_m.x() -
                  first->submaps->front().T_map_submap(*first->keys).position_m.x(),
              0.5, 1e-9);
}

TEST_F(VerticalLaserStory, PeopleAreCutOut) {
  SweepSituation situation = flying();
  situation.people = {{{0.0, 1.9}, 0.4}};
  see(0.0, situation);
  const auto layer = pipeline_.layer(keys_);
  ASSERT_TRUE(layer);
  const common::Submap3d& submap = layer->submaps->front();
  for (const common::SurfacePoint& point : *submap.points)
    EXPECT_GT((submap.T_map_submap(*keys_) * point.position_m.cast<double>() - Eigen::Vector3d(0.0, 1.9, 1.0))
                  .head<2>()
                  .norm(),
              0.35);
}

TEST_F(VerticalLaserStory, ASweepWithoutAPlaceIsLeftOut) {
  see(0.0, std::nullopt);
  EXPECT_EQ(pipeline_.counts().unplaced, 1u);
  EXPECT_EQ(pipeline_.layer(keys_), nullptr);
}

TEST_F(VerticalLaserStory, SweepsThatCannotBeUsedAreCountedAndSaidOnce) {
  see(1.0);
  pipeline_.add(sweepAt(1.0));
  common::VerticalScan future = *sweepAt(90.0);
  future.stamps.arrived = Time::fromSeconds(1.1);
  pipeline_.add(std::make_shared<const common::VerticalScan>(future));
  EXPECT_FALSE(pipeline_.next());
  EXPECT_EQ(pipeline_.counts().skipped, 2u);
  EXPECT_THAT(texts(), testing::ElementsAre("a sweep of the upright laser cannot be used"));
  see(1.2);
  EXPECT_EQ(pipeline_.counts().sweeps, 2u) << "a stamp of the future does not end the map";
}

TEST_F(VerticalLaserStory, WhatIsNoNumberChangesNothing) {
  common::VerticalScan broken = *sweepAt(1.0);
  broken.ranges_m.assign(broken.ranges_m.size(), NAN);
  pipeline_.add(std::make_shared<const common::VerticalScan>(broken));
  pipeline_.place(flying());
  pipeline_.draw(keys_, Time::fromSeconds(1.1));
  jobs_->deliverDue(Time::fromSeconds(1.2));
  ASSERT_TRUE(pipeline_.layer(keys_));
  EXPECT_TRUE(pipeline_.layer(keys_)->submaps->empty());
}

TEST_F(VerticalLaserStory, WhileNothingIsDrawnTheOldestAreLeftOut) {
  for (int i = 0; i < 30; ++i) pipeline_.add(sweepAt(0.025 * i));
  EXPECT_EQ(pipeline_.counts().skipped, 10u);
  EXPECT_EQ(pipeline_.next()->begin, Time::fromSeconds(0.025 * 10));
}

TEST_F(VerticalLaserStory, ASilentLaserIsReportedOnceAndSoIsItsReturn) {
  see(1.0);
  for (const double time_s : {1.9, 2.1, 2.2}) pipeline_.draw(keys_, Time::fromSeconds(time_s));
  EXPECT_THAT(texts(), testing::ElementsAre("upright laser is silent"));
  see(3.0);
  EXPECT_THAT(texts(), testing::ElementsAre("upright laser sends again"));
}

TEST_F(VerticalLaserStory, ALaserWhoseClockHasJumpedBackSendsNothingUsable) {
  see(20.0);
  for (int i = 1; i < 50; ++i) {
    common::VerticalScan sweep = *sweepAt(10.0 + 0.025 * i);
    sweep.stamps.arrived = Time::fromSeconds(20.0 + 0.025 * i);
    pipeline_.add(std::make_shared<const common::VerticalScan>(sweep));
    pipeline_.draw(keys_, sweep.stamps.arrived);
  }
  EXPECT_THAT(texts(), testing::ElementsAre("a sweep of the upright laser cannot be used",
                                            "upright laser sends nothing usable"));
}

TEST_F(VerticalLaserStory, WhatWasSeenLastIsPublishedWhenTheLaserStops) {
  see(1.0);
  see(1.025);
  const auto first = pipeline_.layer(keys_)->submaps;
  pipeline_.draw(keys_, Time::fromSeconds(2.0));
  jobs_->deliverDue(Time::fromSeconds(2.1));
  EXPECT_NE(pipeline_.layer(keys_)->submaps, first);
  EXPECT_EQ(pipeline_.counts().drawn, 2u);
}

}  // namespace
}  // namespace swiftlet::autonomy
