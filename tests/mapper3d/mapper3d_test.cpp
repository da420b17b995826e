// The 3D map of a rendered room: submaps, seeds and corrections of the 2D map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "common/random.hpp"
#include "mapping3d/model/map_contradiction.hpp"
#include "mapping3d/model/mapper3d.hpp"
#include "mapping3d/model/submap_fusion.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::KeyPoses;
using common::Pose2;
using common::Pose3;
using common::Submap3d;
using Eigen::Vector3d;

constexpr double kRate_Hz = 15.0;

/// The sum of what the submaps tell of a point; unknown if none of them knows it.
int evidenceAt(const Vector3d& point_map_m, const std::vector<Submap3d>& submaps, const KeyPoses& scans) {
  int sum = 0;
  bool known = false;
  for (const Submap3d& submap : submaps) {
    const common::VoxelIndex voxel = submap.voxels->voxelAt(submap.T_map_submap(scans).inverse() * point_map_m);
    if (!submap.voxels->isKnown(voxel)) continue;
    sum += submap.voxels->evidence(voxel);
    known = true;
  }
  return known ? sum : common::VoxelBlock::kUnknown;
}

/// Along the room and back, looking around.
Pose3 flight(double time_s) {
  return {common::quaternionFrom(
              {0.05 * std::sin(1.3 * time_s), 0.1 * std::sin(0.9 * time_s), 0.8 * std::sin(0.7 * time_s)}),
          {1.2 * std::sin(0.5 * time_s), 0.3 * std::sin(time_s), 0.1 * std::sin(0.8 * time_s)}};
}

std::shared_ptr<const KeyPoses> scansAt(std::uint64_t version, const std::vector<Pose2>& poses) {
  auto scans = std::make_shared<KeyPoses>();
  scans->version = version;
  for (const Pose2& pose : poses) scans->keys.push_back({{}, pose});
  return scans;
}

/// The distance of a point inside the room from its walls.
double offWall_m(const TexturedRoom& room, const Vector3d& point_m) {
  return (room.half_size_m - point_m.cwiseAbs()).cwiseAbs().minCoeff();
}

/// A seed with errors as those of laser SLAM and an AHRS.
CameraSeed noisySeed(double time_s, int scan) {
  common::RandomStream random(5, "seed", static_cast<std::uint64_t>(1e3 * time_s));
  const auto draw = [&](double sigma) {
    return Vector3d(random.gaussian(sigma), random.gaussian(sigma), random.gaussian(sigma));
  };
  const Pose3 truth = flight(time_s);
  return {{truth.rotation * common::expSO3(draw(0.01)), truth.position_m + draw(0.02)}, scan};
}

/// Without a 2D map the first seed places the map, and with it the first frame, which is a key frame.
TEST(Mapper3d, TheFirstOfSeedsThatAreNotInTheMapPlacesEachFrame) {
  const TexturedRoom room;
  Mapper3d mapper{Mapper3dConfig()};
  const Pose3 T_seed_map{common::expSO3({0.0, 0.0, 0.7}), {2.0, -1.0, 1.0}};
  std::vector<MappedFrame> mapped;
  for (int i = 0; i < 6; ++i) {
    const double time_s = i / kRate_Hz;
    mapped.push_back(mapper.add(room.seen(flight(time_s), time_s),
                                {CameraSeed{T_seed_map * flight(time_s), 0, false}, nullptr, {}}));
  }
  for (int i = 0; i < 6; ++i) {
    const MappedFrame& frame = mapped[static_cast<std::size_t>(i)];
    ASSERT_TRUE(frame.pose.isTracked()) << i;
    const Pose3 at = mapper.scans()->T_map_level(frame.pose.scan) * frame.T_scan_camera;
    EXPECT_LT((at.position_m - (T_seed_map * flight(i / kRate_Hz)).position_m).norm(), 0.01) << i;
  }
}

TEST(Mapper3d, MapsTheWallsFromNoisySeeds) {
  const TexturedRoom room;
  Mapper3d mapper{Mapper3dConfig()};
  const auto scans = scansAt(1, {{}});
  for (int i = 0; i < 60; ++i) {
    const double time_s = i / kRate_Hz;
    const auto mapped = mapper.add(room.seen(flight(time_s), time_s), {noisySeed(time_s, 0), scans, {}});
    ASSERT_TRUE(mapped.pose.isTracked()) << i;
    EXPECT_LT((mapped.pose.T_map_camera.position_m - flight(time_s).position_m).norm(), 0.05) << i;
  }
  const std::vector<Submap3d> submaps = mapper.submaps();
  ASSERT_EQ(submaps.size(), 1u);
  double sum_m = 0.0;
  for (const common::SurfacePoint& point : *submaps.front().points)
    sum_m += offWall_m(room, submaps.front().T_map_submap(*scans) * point.position_m.cast<double>());
  EXPECT_GT(submaps.front().points->size(), 20'000u);
  EXPECT_LT(sum_m / static_cast<double>(submaps.front().points->size()), 0.03);
}

/// Two submaps on two key scans. When it draws the second one, the 2D map has drifted; then a loop closure corrects it.
struct LoopClosure {
  LoopClosure() {
    SubmapConfig config;
    config.reach_m = 0.8;
    SubmapStore store(config, VoxelConfig(), vision::DepthNoiseConfig());
    for (int i = 0; i < 45; ++i) {
      const Pose3 truth = flight(i / kRate_Hz);
      const int scan = truth.position_m.x() < 0.7 ? 0 : 1;
      frames.push_back(room.seen(truth, i / kRate_Hz));
      store.draw({frames.back(), frames.back(), scan == 0 ? truth : drift() * truth, scan, {}, false}, *before);
    }
    submaps = store.snapshot();
  }
  /// From where things are to where they were believed to be.
  Pose3 drift() const {
    return common::lifted(before->keys[1].T_map_key, 0.0) * common::lifted(after->keys[1].T_map_key, 0.0).inverse();
  }

  TexturedRoom room;
  std::shared_ptr<const KeyPoses> before = scansAt(1, {{}, {1.0, 0.12, 0.4}});
  std::shared_ptr<const KeyPoses> after = scansAt(2, {{}, {0.7, 0.0, 0.3}});
  std::vector<common::RgbdFrame> frames;
  std::vector<Submap3d> submaps;
};

const LoopClosure& loopClosure() {
  static const LoopClosure story;
  return story;
}

double meanOffWall_m(const LoopClosure& story, const KeyPoses& scans) {
  double sum_m = 0.0;
  for (const common::SurfacePoint& point : *story.submaps[1].points)
    sum_m += offWall_m(story.room, story.submaps[1].T_map_submap(scans) * point.position_m.cast<double>());
  return sum_m / static_cast<double>(story.submaps[1].points->size());
}

TEST(Submaps, ALoopClosureMovesThemAtOnce) {
  const LoopClosure& story = loopClosure();
  ASSERT_EQ(story.submaps.size(), 2u);
  EXPECT_EQ(story.submaps[0].key, 0);
  ASSERT_EQ(story.submaps[1].key, 1);
  ASSERT_GT(story.submaps[1].points->size(), 5000u);
  EXPECT_GT(meanOffWall_m(story, *story.before), 0.1);
  EXPECT_LT(meanOffWall_m(story, *story.after), 0.01);
  // A point of a wall that the second submap has is found where the wall is.
  const Vector3d wall_m(story.room.half_size_m.x() + 0.001, 1.1, 0.2);
  EXPECT_LE(evidenceAt(wall_m, {story.submaps[1]}, *story.before), 0);
  EXPECT_GT(evidenceAt(wall_m, {story.submaps[1]}, *story.after), 0);
}

/// Whether the voxel or one beside it is occupied.
bool occupiedNear(const common::VoxelMap& map, common::VoxelIndex voxel) {
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (map.isOccupied({voxel.x + x, voxel.y + y, voxel.z + z})) return true;
  return false;
}

/// The part of the occupied voxels of `a` that have an occupied one of `b` beside them.
double partNear(const common::VoxelMap& a, const common::VoxelMap& b) {
  int near = 0, all = 0;
  for (const common::VoxelIndex block : a.blocks())
    for (int i = 0; i < common::VoxelBlock::kVoxels; ++i) {
      const common::VoxelIndex voxel = common::VoxelMap::voxelOf(block, i);
      if (!a.isOccupied(voxel)) continue;
      ++all;
      near += occupiedNear(b, voxel) ? 1 : 0;
    }
  return all > 0 ? static_cast<double>(near) / all : 0.0;
}

/// The second submap was drawn with a drift of 12 cm and 23 degrees; at its right place nothing contradicts.
TEST(MapContradiction, TellsAMapWithAWrongSubmapFromARightOne) {
  const LoopClosure& story = loopClosure();
  const MapContradiction wrong = contradictionOf(story.submaps, *story.before);
  const MapContradiction right = contradictionOf(story.submaps, *story.after);
  EXPECT_GT(right.seen_twice, 500u);
  EXPECT_LT(right.share(), 0.01);
  EXPECT_GT(wrong.share(), 0.1);
  EXPECT_EQ(contradictionOf({story.submaps.data(), 1}, *story.after).share(), 0.0) << "one submap is no evidence";
}

TEST(SubmapFusion, EqualsAMapThatIsDrawnWithTheCorrectedPoses) {
  const LoopClosure& story = loopClosure();
  VoxelMapper drawn{VoxelConfig()};
  for (std::size_t i = 0; i < story.frames.size(); ++i)
    drawn.insert(story.frames[i].depth, story.frames[i].camera, flight(static_cast<double>(i) / kRate_Hz));
  const common::VoxelMap fused = fuse(story.submaps, *story.after, 0.05);
  EXPECT_GT(partNear(fused, drawn.map()), 0.99);
  EXPECT_GT(partNear(drawn.map(), fused), 0.99);
  EXPECT_LT(partNear(fuse(story.submaps, *story.before, 0.05), drawn.map()), 0.9) << "the correction matters";
}

TEST(SubmapFusion, WithoutACorrectionNothingIsLost) {
  const LoopClosure& story = loopClosure();
  const common::VoxelMap fused = fuse({story.submaps[0]}, *story.before, 0.05);
  const Vector3d shift_m = story.submaps[0].T_map_submap(*story.before).position_m;
  ASSERT_GT(fused.blockCount(), 100u);
  for (const common::VoxelIndex block : fused.blocks()) {
    const common::VoxelIndex first = common::VoxelMap::firstOf(block);
    const common::VoxelIndex in = story.submaps[0].voxels->voxelAt(fused.centerOf(first) - shift_m);
    ASSERT_EQ(fused.evidence(first), story.submaps[0].voxels->evidence(in));
  }
}

TEST(Mapper3d, AfterACorrectionItTracksOnAgainstTheMovedKeyFrames) {
  const TexturedRoom room;
  Mapper3d mapper{Mapper3dConfig()};
  const auto before = scansAt(1, {{}}), after = scansAt(2, {{0.4, -0.3, 0.2}});
  const Pose3 moved = common::lifted(after->keys[0].T_map_key, 0.0);
  for (int i = 0; i < 8; ++i) {
    const Pose3 truth = flight(i / kRate_Hz), seed = i < 5 ? truth : moved * truth;
    const auto mapped = mapper.add(room.seen(truth, i / kRate_Hz), {CameraSeed{seed, 0}, i < 5 ? before : after, {}});
    ASSERT_TRUE(mapped.pose.isTracked());
    EXPECT_LT((mapped.pose.T_map_camera.position_m - seed.position_m).norm(), 0.01);
    EXPECT_LT((mapped.T_scan_camera.position_m - truth.position_m).norm(), 0.01);
  }
}

TEST(Mapper3d, AFrameThatDoesNotFitIsLeftOutAndTheMapBeginsAnewAfterSeveral) {
  const TexturedRoom room;
  TexturedRoom other;
  other.walls = 100;
  other.half_size_m = {1.3, 3.0, 1.1};
  Mapper3d mapper{Mapper3dConfig()};
  const auto scans = scansAt(1, {{}});
  for (int i = 0; i < 10; ++i)
    ASSERT_TRUE(
        mapper.add(room.seen(flight(0.0), i / kRate_Hz), {CameraSeed{flight(0.0), 0}, scans, {}}).pose.isTracked());
  const std::size_t keys = mapper.keyFrames().size();
  std::vector<TrackState> states;
  for (int i = 10; i < 18; ++i)
    states.push_back(mapper.add(other.seen({}, i / kRate_Hz), {CameraSeed{flight(0.0), 0}, scans, {}}).pose.state);
  EXPECT_EQ(states[0], TrackState::kLost);
  EXPECT_EQ(states[4], TrackState::kLost);
  EXPECT_EQ(states[5], TrackState::kFoundAgain);
  EXPECT_EQ(states[6], TrackState::kTracked);
  EXPECT_EQ(mapper.keyFrames().size(), keys + 1);
}

TEST(Mapper3d, PeopleAreCutOut) {
  const TexturedRoom room;
  Mapper3d mapper{Mapper3dConfig()};
  const auto scans = scansAt(1, {{}});
  const Pose3 pose;
  common::RgbdFrame frame = room.seen(pose, 0.0);
  // Somebody stands 1.5 m in front of the camera.
  for (int v = 60; v < 240; ++v)
    for (int u = 130; u < 190; ++u) frame.depth.depth_m[static_cast<std::size_t>(v * 320 + u)] = 1.5F;
  const std::vector<common::Disc> people{{{1.6, 0.0}, 0.35}};
  (void)mapper.add(frame, {CameraSeed{pose, 0}, scans, people});
  const std::vector<Submap3d> submaps = mapper.submaps();
  for (const common::SurfacePoint& point : *submaps.front().points)
    ASSERT_FALSE(people.front().covers(point.position_m.head<2>().cast<double>()));
  EXPECT_EQ(evidenceAt({1.501, 0.0, 0.0}, submaps, *scans), common::VoxelBlock::kUnknown);
  EXPECT_LT(evidenceAt({1.0, 0.0, 0.0}, submaps, *scans), 0);
}

/// Somebody stands in the view, walks through it and is gone; nothing recognizes a person.
TEST(Mapper3d, WhereAPersonStoodAndWalkedThereIsFreeSpaceAfterwards) {
  const TexturedRoom room;
  Mapper3d mapper{Mapper3dConfig()};
  const auto scans = scansAt(1, {{}});
  const Pose3 pose;
  std::vector<Vector3d> places_m;
  for (int i = 0; i < 40; ++i) {
    common::RgbdFrame frame = room.seen(pose, i / kRate_Hz);
    const int left_px = 20 + 20 * std::max(0, i - 6);
    if (i < 18) {
      for (int v = 60; v < 240; ++v)
        for (int u = left_px; u < left_px + 50; ++u) frame.depth.depth_m[static_cast<std::size_t>(v * 320 + u)] = 1.5F;
      places_m.push_back(room.camera.point_camera_m(left_px + 25, 120, 1.501));
    }
    ASSERT_TRUE(mapper.add(frame, {CameraSeed{pose, 0}, scans, {}}).pose.isTracked()) << i;
    if (i == 6) {
      EXPECT_GT(evidenceAt(places_m.front(), mapper.submaps(), *scans), 0);
    }
  }
  for (const Vector3d& place_m : places_m) EXPECT_LT(evidenceAt(place_m, mapper.submaps(), *scans), 0);
}

TEST(SubmapStore, StaysWithinItsPoints) {
  const TexturedRoom room;
  Mapper3dConfig config;
  config.submaps.reach_m = 0.5;
  config.submaps.points_max = 30'000;
  Mapper3d mapper(config);
  const auto scans = scansAt(1, {{}});
  for (int i = 0; i < 40; ++i) {
    const double time_s = i / 8.0;
    (void)mapper.add(room.seen(flight(time_s), time_s), {CameraSeed{flight(time_s), 0}, scans, {}});
  }
  const std::vector<Submap3d> submaps = mapper.submaps();
  ASSERT_GT(submaps.size(), 2u);
  std::size_t points = 0;
  for (std::size_t i = 0; i + 1 < submaps.size(); ++i) points += submaps[i].points->size();
  EXPECT_LE(points, 30'000u);
  EXPECT_GT(points, 5'000u);
}

/// The voxels of all submaps together are limited; what is forgotten is the oldest, and the newest goes on.
TEST(SubmapStore, StaysWithinItsVoxels) {
  const TexturedRoom room;
  Mapper3dConfig config;
  config.submaps.reach_m = 0.5;
  config.submaps.blocks_max = 300;
  Mapper3d mapper(config);
  const auto scans = scansAt(1, {{}});
  for (int i = 0; i < 40; ++i) {
    const double time_s = i / 8.0;
    ASSERT_TRUE(
        mapper.add(room.seen(flight(time_s), time_s), {CameraSeed{flight(time_s), 0}, scans, {}}).pose.isTracked());
    std::size_t blocks = 0, largest = 0;
    for (const Submap3d& submap : mapper.submaps()) {
      blocks += submap.voxels->blockCount();
      largest = std::max(largest, submap.voxels->blockCount());
    }
    ASSERT_LE(blocks, 300u + largest) << "the one that grows comes on top";
  }
  EXPECT_GT(mapper.submaps().size(), 1u);
}

}  // namespace
}  // namespace swiftlet::mapping3d
