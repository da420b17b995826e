// What is known of the space of a flight: free only where the camera, the laser or the hull itself has shown it.
#include "autonomy/planning_jobs/flight_space.hpp"

#include <gtest/gtest.h>

#include "tests/autonomy/voxel_room.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::autonomy {
namespace {

using Eigen::Vector3d;
using planning::test::fill;

/// A room of 4 m by 4 m; nothing is known at the height of flight until it is drawn into the grid.
struct Space : testing::Test {
  bool free(double x_m, double y_m, double z_m) {
    PlanningRequest request;
    request.map3d = room.layer();
    request.discs = discs;
    request.T_map_body = here;
    planning::CellStates states(0.05);
    states.update(grid.snapshot());
    EXPECT_TRUE(space.update(request, {2.0, 2.0}, heights, states));
    return space.hull({0.1, 0.0}).isFree(Vector3d(x_m, y_m, z_m));
  }
  /// Seen free, 0.1 to 1.9 m high.
  Space() { room.draw({0, 0, 0.1}, {4, 4, 1.9}, VoxelRoom::kSeenFree); }

  VoxelRoom room;
  common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
  std::vector<common::Disc> discs;
  common::Pose2 here{1.0, 1.0, 0.0};
  FlightHeights heights{1.0, 1.0, 2.0, true};
  FlightSpace space{0.25};
};

TEST_F(Space, SeenSpaceIsFree) {
  EXPECT_TRUE(free(2.0, 2.0, 1.0));
  EXPECT_TRUE(free(2.0, 2.0, 1.6));
  EXPECT_FALSE(free(2.0, 2.0, 1.9)) << "nobody looked above";
  EXPECT_FALSE(free(6.0, 2.0, 1.0)) << "nobody looked there";
}

TEST_F(Space, TheHullKeepsOffTheFloor) {
  EXPECT_TRUE(free(2.0, 2.0, 0.55));
  EXPECT_FALSE(free(2.0, 2.0, 0.42));
}

TEST_F(Space, ABeamIsFlownUnderAndOverWithTheAirThatTheHullNeeds) {
  room.draw({1.9, 0, 1.0}, {2.1, 4, 1.1}, VoxelRoom::kSeenOccupied);
  EXPECT_FALSE(free(2.0, 2.0, 1.0));
  EXPECT_TRUE(free(2.0, 2.0, 0.75));
  EXPECT_FALSE(free(2.0, 2.0, 0.95));
  EXPECT_FALSE(free(2.0, 2.0, 1.30)) << "the flight controller would lift the path";
  EXPECT_TRUE(free(2.0, 2.0, 1.60));
}

TEST_F(Space, WhatOneFrameSawIsNeitherFreeNorOccupied) {
  room.draw({1.9, 0, 1.0}, {2.1, 4, 1.1}, 17);
  EXPECT_FALSE(free(2.0, 2.0, 1.0));
}

TEST_F(Space, WhatALaterSubmapSawFreeHasGone) {
  room.draw({1.9, 1.9, 0.1}, {2.1, 2.1, 1.5}, VoxelRoom::kSeenOccupied);
  room.beginSubmap(1.5);
  EXPECT_FALSE(free(2.0, 2.0, 1.0));
  for (int look = 0; look < 2; ++look) {  // Two are as certain as the one that saw it there.
    room.draw({0, 0, 0.1}, {4, 4, 1.9}, VoxelRoom::kSeenFree);
    room.beginSubmap(1.5);
  }
  EXPECT_TRUE(free(2.0, 2.0, 1.0));
}

TEST_F(Space, AtTheHeightOfFlightTheGridSaysWhatTheCameraDidNotSee) {
  fill(grid, {{100, 0}, {160, 80}}, planning::test::kFreeCell);
  EXPECT_TRUE(free(6.0, 2.0, 1.0));
  EXPECT_FALSE(free(6.0, 2.0, 1.3));
  fill(grid, {{118, 30}, {122, 50}}, planning::test::kWallCell);
  EXPECT_FALSE(free(6.0, 2.0, 1.0));
}

TEST_F(Space, WhereTheHullHasBeenItMayBeAgain) {
  here = {5.0, 2.0, 0.0};
  heights.reference_m = 1.5;
  EXPECT_TRUE(free(5.0, 2.0, 1.5));
  here = {5.6, 2.0, 0.0};
  EXPECT_TRUE(free(5.3, 2.0, 1.5));
}

TEST_F(Space, PeopleAreInTheWayAtAllHeights) {
  discs = {{{2.0, 2.0}, 0.3}};
  EXPECT_FALSE(free(2.0, 2.0, 1.6));
  EXPECT_TRUE(free(3.0, 2.0, 1.6));
  discs.clear();
  EXPECT_TRUE(free(2.0, 2.0, 1.6)) << "they have gone";
}

TEST_F(Space, TheGridOfAHeightIsFreeWhereTheHullIs) {
  room.draw({2.0, 0, 1.0}, {2.2, 4, 1.1}, VoxelRoom::kSeenOccupied);
  (void)free(1.0, 1.0, 1.0);
  const common::OccupancyGrid low = space.gridAt(0.6, here.position_m(), 0.05),
                              high = space.gridAt(1.0, here.position_m(), 0.05);
  EXPECT_TRUE(common::occupancy::isFree(low.at(low.cellAt(2.1, 1.0))));
  EXPECT_TRUE(common::occupancy::isOccupied(high.at(high.cellAt(2.1, 1.0))));
  EXPECT_TRUE(common::occupancy::isUnknown(high.at(high.cellAt(-1.0, 1.0))));
}

}  // namespace
}  // namespace swiftlet::autonomy
