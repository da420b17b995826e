// Obstacles that a stereo pair sees and a laser does not: pairs, their depths, voxels, and cells for the planner.
#include "autonomy/estimation/stereo_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "autonomy/camera_obstacles.hpp"
#include "autonomy/estimation/stereo_pipeline.hpp"
#include "pair_rig.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose3;
using common::Time;

/// A carpeted room with a box 0.9 m high, 1 m ahead: a laser 0.08 m above a body that flies at 1 m sees over it.
simulation::WorldModel roomWith(bool box) {
  simulation::WorldModel room = simulation::boxRoom();
  if (box) room.shapes.push_back(simulation::boxShape("box", {1.0, -0.4, 0.0}, {1.6, 0.4, 0.9}));
  for (simulation::Shape& shape : room.shapes) shape.pattern = simulation::Pattern::kCarpet;
  return room;
}

common::RgbdCameraConfig tiltedPair() {
  common::RgbdCameraConfig sheet = shippedPair();
  sheet.mount.pitch_deg = 20.0;
  return sheet;
}

/// A vehicle that hovers, and moves a little, with a tilted pair; the laser has seen nothing.
struct Hover {
  explicit Hover(bool box) : rig(sheet, roomWith(box)) { keys->keys.push_back({}); }

  void see(int pairs, bool supported = true, const std::vector<common::Disc>& people = {}) {
    for (int i = 0; i < pairs; ++i, time_s += 0.25) {
      const Pose3 pose = hovering(1.0, 0.02 * std::sin(2.0 * time_s), 0.02 * std::cos(2.0 * time_s));
      common::RgbdFrame pair = rig.taken(pose, time_s);
      const Time now = pair.stamps.arrived = Time::fromSeconds(time_s + 0.3);
      pipeline.add(std::make_shared<const common::RgbdFrame>(std::move(pair)), now);
      pipeline.watch(now);
      jobs->deliverDue(now + common::Duration::fromMilliseconds(60));
      if (auto frame = pipeline.takeFrame()) map.add(std::move(frame));
      if (!map.next()) continue;
      FrameSituation situation;
      situation.at_key = common::KeyRelativePose{0, pose};
      situation.supported = supported;
      situation.keys = keys;
      situation.people = people;
      map.map(situation, now);
      map.watch(keys, now);
      jobs->deliverDue(now + common::Duration::fromMilliseconds(200));
    }
  }
  std::vector<Eigen::Vector2d> obstacles() {
    CameraObstacles obstacles(0.25);
    const auto grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
    obstacles.update(map.layer(keys), grid, {0.0, 0.0, 1.0});
    return obstacles.cells_map_m();
  }

  common::RgbdCameraConfig sheet = tiltedPair();
  PairRig rig;
  std::unique_ptr<common::JobRunner> jobs = common::makeLockstepJobs(0);
  common::EventLog log;
  StereoPipeline pipeline{sheet, *jobs, log};
  StereoMap map{{}, sheet, pipeline.noise(), *jobs};
  std::shared_ptr<common::KeyPoses> keys = std::make_shared<common::KeyPoses>();
  double time_s = 1.0;
};

TEST(StereoMap, ABoxBelowThePlaneOfTheLaserIsAnObstacle) {
  Hover hover(true);
  hover.see(8);
  const auto cells_map_m = hover.obstacles();
  std::set<int> columns;
  for (const Eigen::Vector2d& cell_m : cells_map_m) {
    EXPECT_GT(cell_m.x(), 0.85) << "before the box is nothing: " << cell_m.transpose();
    EXPECT_LT(std::abs(cell_m.y()), 0.55) << cell_m.transpose();
    if (cell_m.x() < 1.15) columns.insert(static_cast<int>(std::floor(cell_m.y() / 0.05)));
  }
  EXPECT_GE(columns.size(), 13U) << "of the 16 cells of its front";
}

TEST(StereoMap, AnEmptyRoomHasNoObstacle) {
  Hover hover(false);
  hover.see(16);
  ASSERT_NE(hover.map.layer(hover.keys), nullptr);
  EXPECT_TRUE(hover.obstacles().empty());
  EXPECT_GT(hover.map.layer(hover.keys)->submaps->front().voxels->blockCount(), 20U) << "it was looked at";
}

TEST(StereoMap, TheLayerHasTheFrameAndItsPlace) {
  Hover hover(true);
  EXPECT_EQ(hover.map.layer(hover.keys), nullptr);
  hover.see(3);
  const auto layer = hover.map.layer(hover.keys);
  ASSERT_NE(layer, nullptr);
  EXPECT_TRUE(layer->tracked);
  EXPECT_EQ(layer->frame->stamps.measured, Time::fromSeconds(1.5));
  EXPECT_FALSE(layer->frame->depth.depth_m.empty());
  const Pose3 expected = hovering(1.0, 0.02 * std::sin(3.0), 0.02 * std::cos(3.0)) * hover.sheet.mount.pose();
  EXPECT_LT((layer->T_map_camera.position_m - expected.position_m).norm(), 1e-9);
  EXPECT_EQ(hover.map.layer(hover.keys), layer) << "the same until something changes";
}

TEST(StereoMap, AFrameWhosePlaceIsOnlyPredictedIsLeftOut) {
  Hover hover(true);
  hover.see(4, false);
  EXPECT_EQ(hover.map.layer(hover.keys), nullptr);
}

TEST(StereoMap, PeopleAreNoObstacle) {
  Hover hover(true);
  hover.see(6, true, {{{1.3, 0.0}, 1.0}});
  EXPECT_TRUE(hover.obstacles().empty());
}

/// A pair that is made by another sheet than it is read by.
TEST(StereoMap, DepthsThatTheBeamsDownContradictAreNotMapped) {
  common::RgbdCameraConfig shorter = shippedPair();
  shorter.baseline_m = 0.10;
  PairRig rig(shorter, roomWith(false));
  const auto jobs = common::makeLockstepJobs(0);
  common::EventLog log;
  StereoPipeline pipeline(shippedPair(), *jobs, log);
  std::vector<bool> frames;
  for (double time_s = 1.0; time_s < 6.0; time_s += 0.25) {
    const Time now = Time::fromSeconds(time_s + 0.1);
    pipeline.addBeams(Time::fromSeconds(time_s), 1.1, Eigen::Quaterniond::Identity());
    common::RgbdFrame pair = rig.taken(hovering(1.1), time_s);
    pair.stamps.arrived = now;
    pipeline.add(std::make_shared<const common::RgbdFrame>(std::move(pair)), now);
    pipeline.watch(now);
    jobs->deliverDue(Time::fromSeconds(time_s + 0.2));
    frames.push_back(pipeline.takeFrame() != nullptr);
    EXPECT_EQ(pipeline.takeFrame(), nullptr) << "each frame once";
  }
  EXPECT_TRUE(frames.front()) << "as long as it is not known";
  EXPECT_FALSE(frames.back());
}

}  // namespace
}  // namespace swiftlet::autonomy
