// Drawing depth images against the slow, obvious way: every ray cell by cell into a dense grid.
#include "mapping3d/voxels/voxel_mapper.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/config_check.hpp"
#include "mapping3d/voxels/ray_walk.hpp"
#include "tests/mapping3d/rooms.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::DepthImage;
using common::Pose3;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

/// The log odds of voxels in steps of 0.05, one by one, within 8 m of the origin.
class DenseGrid {
 public:
  explicit DenseGrid(double range_m, bool clears_unknown_pixels = false)
      : range_m_(range_m), clears_unknown_pixels_(clears_unknown_pixels) {
    evidence_.assign(kSide * kSide * kSide, VoxelBlock::kUnknown);
    seen_.assign(evidence_.size(), Seen::kNot);
  }

  void insert(const DepthImage& depth, const common::PinholeCamera& camera, const Pose3& T_map_camera) {
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        float depth_m = depth.at(u, v);
        if (depth_m == DepthImage::kUnknown && clears_unknown_pixels_) depth_m = DepthImage::kTooFar;
        if (depth_m == DepthImage::kUnknown) continue;
        const bool too_far = depth_m == DepthImage::kTooFar;
        Eigen::Vector3d ray_m = T_map_camera.rotation * camera.point_camera_m(u, v, too_far ? 1.0 : depth_m);
        const bool hit = !too_far && ray_m.norm() <= range_m_;
        if (!hit) ray_m *= range_m_ / ray_m.norm();
        const Eigen::Vector3d origin = T_map_camera.position_m / 0.05;
        RayWalk walk(origin, (T_map_camera.position_m + ray_m) / 0.05);
        for (; !walk.atEnd(); walk.advance())
          if (Seen& seen = seen_[at(walk.cell())]; seen == Seen::kNot) seen = Seen::kCrossed;
        if (hit) seen_[at(walk.cell())] = Seen::kHit;
      }
    }
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (seen_[i] == Seen::kNot) continue;
      const int before = evidence_[i] == VoxelBlock::kUnknown ? 0 : evidence_[i];
      evidence_[i] = static_cast<std::int8_t>(std::clamp(before + (seen_[i] == Seen::kHit ? 17 : -8), -40, 70));
      seen_[i] = Seen::kNot;
    }
  }

  /// Of the voxels that are in this class here or in the map, the share that is in it in both.
  struct Agreement {
    double free = 0.0, occupied = 0.0;
  };
  Agreement agreementWith(const common::VoxelMap& map) const {
    // All that is here is in `either`; what is in the map is added where it is not here.
    std::array<std::ptrdiff_t, 2> both{}, either{};
    either[0] = std::count_if(evidence_.begin(), evidence_.end(), isFree);
    either[1] = std::count_if(evidence_.begin(), evidence_.end(), isOccupied);
    for (const VoxelIndex block : map.blocks())
      for (int i = 0; i < VoxelBlock::kVoxels; ++i) {
        const VoxelIndex voxel = VoxelMap::voxelOf(block, i);
        const std::int8_t here = evidence_[at(voxel)], there = map.block(block)->evidence[static_cast<std::size_t>(i)];
        if (isFree(there)) ++(isFree(here) ? both : either)[0];
        if (isOccupied(there)) ++(isOccupied(here) ? both : either)[1];
      }
    const auto share = [&](std::size_t kind) {
      return static_cast<double>(both[kind]) / static_cast<double>(either[kind]);
    };
    return {share(0), share(1)};
  }

 private:
  enum class Seen : std::uint8_t { kNot, kCrossed, kHit };
  static constexpr int kSide = 320;

  static bool isFree(std::int8_t evidence) { return evidence <= 0 && evidence != VoxelBlock::kUnknown; }
  static bool isOccupied(std::int8_t evidence) { return evidence > 0; }
  static std::size_t at(VoxelIndex voxel) {
    return static_cast<std::size_t>(((voxel.z + kSide / 2) * kSide + voxel.y + kSide / 2) * kSide + voxel.x +
                                    kSide / 2);
  }

  double range_m_;
  bool clears_unknown_pixels_;
  std::vector<std::int8_t> evidence_;
  std::vector<Seen> seen_;
};

/// Draws some frames in a random room in both ways.
DenseGrid::Agreement agreementAfterFrames(unsigned seed, const common::PinholeCamera& camera, DenseGrid dense,
                                          const VoxelConfig& config = {}) {
  std::mt19937 random(seed);
  const Room room = randomRoom(random);
  VoxelMapper mapper(config);
  for (int frame = 0; frame < 3; ++frame) {
    const Pose3 T_room_camera = randomView(room, random), T_map_camera = T_map_room * T_room_camera;
    const DepthImage depth = depthImage(room, camera, T_room_camera, random, 0.02, 0.0);
    mapper.insert(depth, camera, T_map_camera);
    dense.insert(depth, camera, T_map_camera);
  }
  return dense.agreementWith(mapper.map());
}

/// Of odd sizes: its rows are no whole number of blocks of pixels.
constexpr common::PinholeCamera kOdd{333, 251, 270.0, 270.0, 166.0, 125.0};

/// The pixels of the small camera are looked at one by one, those of larger ones in squares of four.
class AgreesWithADenseGrid : public testing::TestWithParam<common::PinholeCamera> {};
INSTANTIATE_TEST_SUITE_P(Cameras, AgreesWithADenseGrid, testing::Values(smallCamera(), xtion(), kOdd),
                         [](const auto& test) { return "Pixels" + std::to_string(test.param.pixels()); });

TEST_P(AgreesWithADenseGrid, InEachClass) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const DenseGrid::Agreement agreement = agreementAfterFrames(seed, GetParam(), DenseGrid(5.0));
    EXPECT_GE(agreement.free, 0.985) << seed;
    EXPECT_GE(agreement.occupied, 0.99) << seed;
  }
}

TEST_P(AgreesWithADenseGrid, WhereSurfacesAreBeyondTheRange) {
  VoxelConfig config;
  config.range_max_m = 2.0;
  const DenseGrid::Agreement agreement = agreementAfterFrames(12, GetParam(), DenseGrid(2.0), config);
  EXPECT_GE(agreement.free, 0.96);
  EXPECT_GE(agreement.occupied, 0.99);
}

TEST_P(AgreesWithADenseGrid, NotWithAPlantedMistake) {
  EXPECT_LT(agreementAfterFrames(1, GetParam(), DenseGrid(5.0, true)).free, 0.97);
  EXPECT_LT(agreementAfterFrames(1, GetParam(), DenseGrid(3.0)).free, 0.97);
}

/// As RealSense gives them.
TEST(VoxelMapper, WidePicturesAgreeWithADenseGrid) {
  const common::PinholeCamera wide{848, 480, 620.0, 620.0, 423.5, 239.5};
  const DenseGrid::Agreement agreement = agreementAfterFrames(1, wide, DenseGrid(5.0));
  EXPECT_GE(agreement.free, 0.985);
  EXPECT_GE(agreement.occupied, 0.99);
}

/// A camera at (0, 0, 1) that looks along x at a wall 2 m away.
struct WallView {
  common::PinholeCamera camera = smallCamera();
  Pose3 T_map_camera{Eigen::Quaterniond::Identity(), {0.01, 0.01, 1.01}};
  DepthImage depth{160, 120, std::vector<float>(160 * 120, 2.0F)};
};

TEST(VoxelMapper, ASurfaceIsOccupiedAndTheSpaceBeforeItFree) {
  WallView view;
  VoxelMapper mapper(VoxelConfig{});
  const InsertionCounts counts = mapper.insert(view.depth, view.camera, view.T_map_camera);
  EXPECT_EQ(counts.hits, 160 * 120);
  EXPECT_TRUE(mapper.map().isOccupied(mapper.map().voxelAt({2.01, 0.0, 1.0})));
  EXPECT_TRUE(mapper.map().isFree(mapper.map().voxelAt({1.0, 0.0, 1.0})));
  EXPECT_FALSE(mapper.map().isKnown(mapper.map().voxelAt({2.2, 0.0, 1.0})));
  EXPECT_FALSE(mapper.map().isKnown(mapper.map().voxelAt({-0.5, 0.0, 1.0})));
}

TEST(VoxelMapper, PixelsWithoutDepthClearNothing) {
  WallView view;
  view.depth.depth_m.assign(view.depth.depth_m.size(), DepthImage::kUnknown);
  VoxelMapper mapper(VoxelConfig{});
  EXPECT_EQ(mapper.insert(view.depth, view.camera, view.T_map_camera).unknown, 160 * 120);
  EXPECT_EQ(mapper.map().blockCount(), 0u);
}

TEST(VoxelMapper, PixelsThatAreTooFarClearUpToTheRange) {
  WallView view;
  view.depth.depth_m.assign(view.depth.depth_m.size(), DepthImage::kTooFar);
  VoxelMapper mapper(VoxelConfig{});
  mapper.insert(view.depth, view.camera, view.T_map_camera);
  EXPECT_TRUE(mapper.map().isFree(mapper.map().voxelAt({4.9, 0.0, 1.0})));
  EXPECT_FALSE(mapper.map().isKnown(mapper.map().voxelAt({5.1, 0.0, 1.0})));
}

TEST(VoxelMapper, WhatIsGoneFades) {
  WallView near, far;
  far.depth.depth_m.assign(far.depth.depth_m.size(), 3.0F);
  VoxelMapper mapper(VoxelConfig{});
  const VoxelIndex wall = mapper.map().voxelAt({2.01, 0.0, 1.0});
  for (int i = 0; i < 10; ++i) mapper.insert(near.depth, near.camera, near.T_map_camera);
  EXPECT_TRUE(mapper.map().isOccupied(wall));
  // From 3.5 down in steps of 0.4.
  for (int i = 0; i < 9; ++i) mapper.insert(far.depth, far.camera, far.T_map_camera);
  EXPECT_FALSE(mapper.map().isOccupied(wall));
}

TEST(VoxelMapper, APersonIsNotDrawn) {
  WallView view;
  VoxelMapper mapper(VoxelConfig{});
  const std::vector<common::Disc> people = {{{2.0, 0.0}, 0.3}};
  EXPECT_GT(mapper.insert(view.depth, view.camera, view.T_map_camera, people).ignored, 1000);
  EXPECT_FALSE(mapper.map().isKnown(mapper.map().voxelAt({2.01, 0.0, 1.0})));
  EXPECT_TRUE(mapper.map().isFree(mapper.map().voxelAt({1.5, 0.0, 1.0})));
  EXPECT_TRUE(mapper.map().isOccupied(mapper.map().voxelAt({2.01, 0.7, 1.0})));
}

TEST(VoxelMapper, AFullMapForgetsTheFarthestBlocks) {
  WallView view;
  VoxelConfig config;
  config.blocks_max = 100;
  VoxelMapper mapper(config);
  EXPECT_GT(mapper.insert(view.depth, view.camera, view.T_map_camera).forgotten, 0);
  EXPECT_LE(mapper.map().blockCount(), 100u);
  EXPECT_TRUE(mapper.map().isKnown(mapper.map().voxelAt({0.3, 0.0, 1.0})));
}

TEST(VoxelMapper, BeamsOfALaserAreDrawnAsPixelsAre) {
  VoxelMapper mapper(VoxelConfig{});
  const std::vector<Eigen::Vector3d> points_map_m = {{2.01, 0.01, 1.01}, {0.01, 9.0, 1.01}, {NAN, 0, 0}};
  const InsertionCounts counts = mapper.insert(raysFrom({0.01, 0.01, 1.01}, points_map_m));
  EXPECT_EQ(counts.hits, 1);
  EXPECT_EQ(counts.too_far, 1);
  EXPECT_EQ(counts.unknown, 1);
  EXPECT_TRUE(mapper.map().isOccupied(mapper.map().voxelAt(points_map_m[0])));
  EXPECT_TRUE(mapper.map().isFree(mapper.map().voxelAt({0.01, 4.9, 1.01})));
}

TEST(VoxelMapper, EachRayOfASweepHasItsOwnOrigin) {
  VoxelMapper mapper(VoxelConfig{});
  const std::vector<Ray> rays{{{0.0, 0.01, 1.01}, {0.0, 2.0, 1.01}},
                              {{0.2, 0.01, 1.01}, {0.2, 2.0, 1.01}},
                              {{3.0, 0.01, 1.01}, {3.0, 2.0, 1.01}},
                              {{NAN, 0, 0}, {0, 1, 0}}};
  const std::vector<common::Disc> people{{{0.2, 2.0}, 0.15}};
  const InsertionCounts counts = mapper.insert(rays, people);
  EXPECT_EQ(counts.hits, 1);
  EXPECT_EQ(counts.ignored, 1) << "it ended on a person";
  EXPECT_EQ(counts.unknown, 2) << "no sweep is metres long";
  const common::VoxelMap& map = mapper.map();
  EXPECT_TRUE(map.isOccupied(map.voxelAt({0.0, 2.0, 1.01})));
  EXPECT_TRUE(map.isFree(map.voxelAt({0.2, 1.0, 1.01})));
  EXPECT_FALSE(map.isKnown(map.voxelAt({0.2, 2.0, 1.01})));
  EXPECT_FALSE(map.isKnown(map.voxelAt({0.1, 1.0, 1.01}))) << "between the rays";
}

TEST(VoxelMapper, ASweepWithoutARayChangesNothing) {
  VoxelMapper mapper(VoxelConfig{});
  EXPECT_EQ(mapper.insert(std::span<const Ray>{}).hits, 0);
  const std::vector<Ray> rays{{{NAN, 0, 0}, {0, 1, 0}}};
  EXPECT_EQ(mapper.insert(rays).unknown, 1);
  EXPECT_EQ(mapper.map().blockCount(), 0u);
}

/// All blocks around the sensor would be kept.
TEST(VoxelConfig, ARangeOfManyVoxelsIsRefused) {
  const auto problems = [](double resolution_m, double range_max_m) {
    return common::config::problemsOf(VoxelConfig{.resolution_m = resolution_m, .range_max_m = range_max_m});
  };
  EXPECT_TRUE(problems(0.05, 5.0).empty());
  EXPECT_TRUE(problems(0.01, 5.0).empty());
  EXPECT_TRUE(problems(0.1, 50.0).empty());
  EXPECT_THAT(problems(0.01, 50.0),
              testing::ElementsAre(test_support::ProblemIs("voxels.too-many", "range_max_m", "500")));
}

}  // namespace
}  // namespace swiftlet::mapping3d
