// Which paths stay where there are walls around.
#include "planning/exploration/held_path.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tests/planning/grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// A room of 5 m by 5 m with a doorway to the right, outside of which 12 m of free ground were seen and no wall.
class RoomWithADoor : public testing::Test {
 protected:
  RoomWithADoor() {
    common::OccupancyGrid grid = test::room(100, 100);
    test::fill(grid, {{100, 45}, {101, 65}}, test::kFreeCell);
    test::fill(grid, {{101, -200}, {340, 300}}, test::kFreeCell);
    map_.update(grid.snapshot(), {});
  }
  bool staysHeld(const Points& path_map_m) const { return planning::staysHeld(map_, path_map_m); }

  CostMap map_{CostMap::Config{}, 0.05};
};

TEST_F(RoomWithADoor, PlacesAreHeldInsideOnly) {
  EXPECT_TRUE(isHeld(map_, {2.5, 2.5}));
  EXPECT_FALSE(isHeld(map_, {11.0, 2.7}));
  EXPECT_TRUE(isHeld(map_, {500.0, 0.0})) << "nothing is known of it";
}

TEST_F(RoomWithADoor, PathsInsideAreHeld) {
  EXPECT_TRUE(staysHeld({}));
  EXPECT_TRUE(staysHeld({{1.0, 1.0}}));
  EXPECT_TRUE(staysHeld({{1.0, 1.0}, {4.0, 1.0}, {4.0, 4.0}}));
}

TEST_F(RoomWithADoor, APathFarOutsideIsNot) {
  EXPECT_FALSE(staysHeld({{1.0, 2.7}, {14.0, 2.7}}));
  EXPECT_FALSE(staysHeld({{1.0, 2.7}, {5.2, 2.7}, {5.5, 2.7}, {9.0, 2.7}, {14.0, 2.7}})) << "in legs of any length";
}

TEST_F(RoomWithADoor, NoPathEndsOutside) {
  EXPECT_FALSE(isHeld(map_, {8.0, 2.7}));
  EXPECT_FALSE(staysHeld({{1.0, 2.7}, {8.0, 2.7}})) << "only 3 m of it are outside";
}

TEST_F(RoomWithADoor, AVehicleOutsideMayFlyBackButNotOn) {
  EXPECT_TRUE(staysHeld({{14.0, 2.7}, {1.0, 2.7}}));
  EXPECT_FALSE(staysHeld({{8.0, 2.7}, {14.0, 2.7}}));
  EXPECT_FALSE(staysHeld({{8.0, 2.7}, {8.0, 4.7}}));
}

}  // namespace
}  // namespace swiftlet::planning
