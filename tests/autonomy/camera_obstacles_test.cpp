// What the camera sees at the height of the hull becomes an obstacle, if the laser does not see it.
#include "autonomy/camera_obstacles.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/key_pose.hpp"
#include "common/submap3d.hpp"
#include "tests/autonomy/voxel_room.hpp"

namespace swiftlet::autonomy {
namespace {

using common::occupancy::isOccupied;

/// One submap that is turned and shifted against the map.
class CameraObstaclesStory : public testing::Test {
 protected:
  void mark(const Eigen::Vector3d& point_map_m, int evidence = 40) {
    const Eigen::Vector3d point_m = T_map_submap_.inverse() * point_map_m;
    voxels_.set(voxels_.voxelAt(point_m), static_cast<std::int8_t>(evidence));
    drawn_ = nullptr;
  }
  void update(double height_m = 1.0) {
    if (!drawn_) drawn_ = std::make_shared<const common::VoxelMap>(voxels_.snapshot());
    auto layer = std::make_shared<common::Map3dLayer>();
    auto keys = std::make_shared<common::KeyPoses>();
    keys->keys.push_back({{}, {1.0, -2.0, 0.4}});
    common::Submap3d submap{0, common::lifted(keys->keys[0].T_map_key, 0.0).inverse() * T_map_submap_,
                            std::make_shared<const std::vector<common::SurfacePoint>>(), drawn_};
    layer->submaps = std::make_shared<const std::vector<common::Submap3d>>(1, submap);
    layer->keys = keys;
    obstacles_.update(layer, std::make_shared<const common::OccupancyGrid>(grid_.snapshot()), {1.0, 1.0, height_m});
  }

  common::Pose3 T_map_submap_{common::expSO3({0.0, 0.0, 0.7}), {0.5, 0.2, 0.0}};
  common::VoxelMap voxels_{0.05};
  std::shared_ptr<const common::VoxelMap> drawn_;  ///< A snapshot, the same object until something is marked.
  common::OccupancyGrid grid_ = common::makeOccupancyGrid(0.05);
  CameraObstacles obstacles_{0.25};
};

TEST_F(CameraObstaclesStory, ALampAtTheHeightOfTheHullIsOne) {
  mark({2.0, 1.0, 1.2});
  update();
  ASSERT_EQ(obstacles_.cells_map_m().size(), 1u);
  const Eigen::Vector2d cell_map_m = obstacles_.cells_map_m()[0];
  EXPECT_LT((cell_map_m - Eigen::Vector2d(2.0, 1.0)).norm(), 0.07) << "half a voxel and half a cell";
  EXPECT_TRUE(isOccupied(obstacles_.grid()->at(obstacles_.grid()->cellAt(cell_map_m))));
}

TEST_F(CameraObstaclesStory, WhatIsAboveOrBelowTheHullIsNone) {
  mark({2.0, 1.0, 1.35});
  mark({2.0, 2.0, 0.65});
  update();
  EXPECT_TRUE(obstacles_.cells_map_m().empty());
  // Lower down the vehicle would meet the second one.
  update(0.8);
  EXPECT_EQ(obstacles_.cells_map_m().size(), 1u);
}

TEST_F(CameraObstaclesStory, TheFloorIsNone) {
  mark({2.0, 1.0, 0.02});
  update(0.2);
  EXPECT_TRUE(obstacles_.cells_map_m().empty());
}

TEST_F(CameraObstaclesStory, OneFrameIsNotEnough) {
  mark({2.0, 1.0, 1.0}, 17);
  update();
  EXPECT_TRUE(obstacles_.cells_map_m().empty());
}

TEST_F(CameraObstaclesStory, AWallThatTheLaserSeesTooIsNotWidened) {
  grid_.set(grid_.cellAt(2.05, 1.0), 60);
  mark({2.0, 1.0, 1.0});
  mark({2.0, 2.0, 1.0});
  update();
  EXPECT_EQ(obstacles_.cells_map_m().size(), 1u);
  EXPECT_NEAR(obstacles_.cells_map_m()[0].y(), 2.0, 0.06);
}

TEST_F(CameraObstaclesStory, WhatTheLaserSeesOrForgetsLaterCounts) {
  grid_.set(grid_.cellAt(2.05, 9.0), 60);  // The tiles are there from the beginning.
  mark({2.0, 1.0, 1.0});
  mark({2.0, 9.0, 1.0});
  update();
  ASSERT_EQ(obstacles_.cells_map_m().size(), 1u);
  EXPECT_NEAR(obstacles_.cells_map_m()[0].y(), 1.0, 0.06);
  grid_.set(grid_.cellAt(2.05, 1.0), 60);
  update();
  EXPECT_TRUE(obstacles_.cells_map_m().empty());
  grid_.set(grid_.cellAt(2.05, 9.0), -60);
  update();
  ASSERT_EQ(obstacles_.cells_map_m().size(), 1u);
  EXPECT_NEAR(obstacles_.cells_map_m()[0].y(), 9.0, 0.06);
}

/// Somebody whom laser and camera saw, and of whom the laser has seen that he has gone.
class WhoHasGone : public CameraObstaclesStory {
 protected:
  WhoHasGone() {
    upright(0.3, 1.7);
    grid_.set(grid_.cellAt(2.0, 1.0), 60);
    update();
  }
  void upright(double from_m, double to_m) {
    for (double z_m = from_m; z_m <= to_m; z_m += 0.05) mark({2.0, 1.0, z_m});
  }
  void leaves() {
    grid_.set(grid_.cellAt(2.0, 1.0), -60);
    obstacles_.forget({{{2.0, 1.0}, 1.0}});
    update();
  }
};

TEST_F(WhoHasGone, IsNoObstacleOfTheCameraEither) {
  EXPECT_TRUE(obstacles_.cells_map_m().empty()) << "the laser has him";
  leaves();
  EXPECT_TRUE(obstacles_.cells_map_m().empty());
  mark({4.0, 1.0, 1.0});  // The submap grows.
  update();
  EXPECT_EQ(obstacles_.cells_map_m().size(), 1u) << "and what was forgotten stays so";
}

TEST_F(WhoHasGone, IsOneAgainWhenTheCameraMeetsHimAgain) {
  leaves();
  mark({2.0, 1.0, 1.0}, 20);
  update();
  EXPECT_TRUE(obstacles_.cells_map_m().empty()) << "it has seen less";
  mark({2.0, 1.0, 1.0}, 37);
  update();
  EXPECT_EQ(obstacles_.cells_map_m().size(), 1u);
}

/// The beams passed above the table, and below the lamp.
TEST_F(WhoHasGone, WhatTheBeamsDidNotPassStays) {
  for (double x_m = 2.0; x_m < 2.5; x_m += 0.02) mark({x_m, 1.3, 0.8});
  mark({2.0, 0.7, 1.25});
  update();
  const std::size_t before = obstacles_.cells_map_m().size();
  ASSERT_GT(before, 5u);
  grid_.set(grid_.cellAt(2.0, 1.0), -60);
  for (const double y_m : {0.7, 1.0, 1.3}) obstacles_.forget({{{2.0, y_m}, 1.0}, {{2.2, y_m}, 1.0}});
  update();
  EXPECT_EQ(obstacles_.cells_map_m().size(), before);
}

TEST_F(CameraObstaclesStory, TheyMoveWithTheirSubmap) {
  mark({2.0, 1.0, 1.0});
  update();
  T_map_submap_.position_m.x() += 0.5;
  update();
  ASSERT_EQ(obstacles_.cells_map_m().size(), 1u);
  EXPECT_NEAR(obstacles_.cells_map_m()[0].x(), 2.5, 0.06);
}

TEST_F(CameraObstaclesStory, NearOnesAreGivenToTheReactiveLayer) {
  mark({2.0, 1.0, 1.0});
  mark({6.0, 1.0, 1.0});
  update();
  const auto points = obstacles_.pointsNear_level_m({1.0, 1.0, 0.0}, 2.0);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].x(), 1.0F, 0.06F);
}

/// A door in which somebody stood while one submap was drawn.
class DoorStory : public testing::Test {
 protected:
  static constexpr double kDoor_m = 2.0;  ///< Its x and y.
  DoorStory() {
    lookThrough();
    somebodyAt(kDoor_m);
  }
  void lookThrough() { room_.draw({1.4, 1.4, 0.3}, {2.6, 2.6, 1.6}, -25); }
  void somebodyAt(double y_m) {
    room_.draw({kDoor_m - 0.15, y_m - 0.15, 0.3}, {kDoor_m + 0.15, y_m + 0.15, 1.6}, VoxelRoom::kSeenOccupied);
  }
  std::size_t obstacles() {
    obstacles_.update(room_.layer(), grid_, {0.0, 0.0, 1.0});
    return obstacles_.cells_map_m().size();
  }
  VoxelRoom room_;
  std::shared_ptr<const common::OccupancyGrid> grid_ =
      std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  CameraObstacles obstacles_{0.25};
};

TEST_F(DoorStory, IsOpenWhenALaterSubmapSeesThroughIt) {
  ASSERT_GT(obstacles(), 20u);
  room_.beginSubmap(3.0);
  EXPECT_GT(obstacles(), 20u) << "nobody has looked";
  lookThrough();
  EXPECT_EQ(obstacles(), 0u);
}

TEST_F(DoorStory, StaysShutWhileSomebodyStandsThere) {
  room_.beginSubmap(3.0);
  lookThrough();
  somebodyAt(kDoor_m + 0.05);  // The two submaps differ by a voxel.
  EXPECT_GT(obstacles(), 20u);
}

TEST_F(DoorStory, StaysShutBySomebodyWhoCameAfterTheOtherSubmapWasBegun) {
  room_.beginSubmap(3.0, -10);
  lookThrough();
  EXPECT_GT(obstacles(), 20u) << "which of the two was later is not known";
}

/// A building of 60 submaps, each with its blocks in one piece and a lamp in the middle.
TEST(CameraObstacles, InALargeMapTheNearestAreReadFirstAndTheOthersSoon) {
  constexpr int kSubmaps = 60;
  common::VoxelMap voxels(0.05);
  for (int z = 0; z < 6; ++z)
    for (int y = -15; y < 15; ++y)
      for (int x = -15; x < 15; ++x) voxels.mutableBlock({x, y, z}).evidence.fill(-40);
  voxels.set(voxels.voxelAt({0.0, 0.0, 1.2}), 40);
  voxels.set(voxels.voxelAt({1.0, 0.0, 1.8}), 40);
  auto layer = std::make_shared<common::Map3dLayer>();
  auto keys = std::make_shared<common::KeyPoses>();
  std::vector<common::Submap3d> submaps;
  for (int i = 0; i < kSubmaps; ++i) {
    keys->keys.push_back({{}, {5.0 * i, 0.0, 0.0}});
    submaps.push_back({i,
                       {},
                       std::make_shared<const std::vector<common::SurfacePoint>>(),
                       std::make_shared<const common::VoxelMap>(voxels.snapshot())});
  }
  layer->submaps = std::make_shared<const std::vector<common::Submap3d>>(submaps);
  layer->keys = keys;
  const auto grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  CameraObstacles obstacles(0.25);
  for (const double height_m : {1.2, 1.8}) {
    obstacles.update(layer, grid, {150.0, 0.0, height_m});
    const double lamp_m = 150.0 + (height_m > 1.5 ? 1.0 : 0.0);
    const auto isLampAt = [&](double x_m) {
      const auto& cells = obstacles.cells_map_m();
      return std::any_of(cells.begin(), cells.end(), [&](const auto& cell) { return std::abs(cell.x() - x_m) < 0.06; });
    };
    EXPECT_TRUE(isLampAt(lamp_m)) << "at once";
    EXPECT_FALSE(isLampAt(lamp_m - 150.0)) << "an update is short";
    for (int i = 0; i < 40; ++i) obstacles.update(layer, grid, {150.0, 0.0, height_m});
    EXPECT_TRUE(isLampAt(lamp_m - 150.0));
    EXPECT_EQ(obstacles.cells_map_m().size(), static_cast<std::size_t>(kSubmaps));
  }
}

TEST(CameraObstacles, WithoutA3DMapTheGridIsTheSameObject) {
  CameraObstacles obstacles(0.25);
  const auto grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  obstacles.update(nullptr, grid, {0.0, 0.0, 1.0});
  EXPECT_EQ(obstacles.grid(), grid);
}

}  // namespace
}  // namespace swiftlet::autonomy
