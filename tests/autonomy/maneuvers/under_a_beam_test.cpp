// A beam crosses the room at the height of flight: the vehicle flies below it where the voxels show room, and comes
// back up behind it. A laser alone sees a wall.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"
#include "tests/autonomy/voxel_room.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kWallCell;

/// The beam is at x = 4 to 4.15 m, from 0.9 to 1.2 m over the floor.
class UnderABeam : public ManeuverInFlight {
 protected:
  void SetUp() override {
    ManeuverInFlight::SetUp();
    fill(grid_, {{80, 0}, {83, 80}}, kWallCell);
  }
  /// `bottom_m`: of the beam; the camera has seen what is below.
  void see(double bottom_m = 0.9) {
    VoxelRoom room;
    room.draw({0.2, 0.2, 0.1}, {7.8, 3.8, 1.35}, VoxelRoom::kSeenFree);
    room.draw({4.0, 0.0, bottom_m}, {4.15, 4.0, 1.2}, VoxelRoom::kSeenOccupied);
    map3d_ = room.layer();
  }
  double height_m() const { return state_.T_odom_body.position_m.z(); }
  /// Flies to the end; the greatest height while the hull was below the beam.
  double fliesBelowBeam_m(double limit_s) {
    double highest_m = 0.0;
    runUntil(
        [&] {
          const double off_m = std::max(4.0 - position_m().x(), position_m().x() - 4.15);
          if (off_m < 0.275) highest_m = std::max(highest_m, height_m());
          return ended();
        },
        limit_s);
    return highest_m;
  }
};

TEST_F(UnderABeam, TheVehicleFliesBelowItAndComesBackUp) {
  see();
  want(to(6.5, 2.0));
  const double below_m = fliesBelowBeam_m(40.0);
  ASSERT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({6.5, 2.0}), 0.05);
  EXPECT_NEAR(height_m(), kHeight_m, 0.05);
  EXPECT_GE(below_m, 0.5);
  EXPECT_LT(below_m, 0.9 - 0.125 - 0.1) << "half the hull and air below the beam";
  EXPECT_EQ(timesSaid("changes its height"), 1);
  EXPECT_EQ(executor_.dip_m(), 0.0) << "it is back at the height of flight";
}

TEST_F(UnderABeam, WhileItIsLowerTheMapStaysAtTheHeightOfFlight) {
  see();
  want(to(6.5, 2.0));
  runUntil([&] { return position_m().x() > 3.9; }, 40.0);
  EXPECT_NEAR(height_m() + executor_.dip_m(), kHeight_m, 0.02);
  const auto costs = executor_.costMapHere();
  ASSERT_TRUE(costs);
  EXPECT_NE(costs->costAt(costs->cellAt(position_m())), planning::CostMap::kLethal) << "free at the lower height";
  EXPECT_EQ(executor_.desk().costMap()->costAt(costs->cellAt(position_m())), planning::CostMap::kLethal);
}

TEST_F(UnderABeam, ABeamTooLowForTheHullIsNotFlownUnder) {
  see(0.65);
  want(to(6.5, 2.0));
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed);
  EXPECT_LT(position_m().x(), 3.7);
}

TEST_F(UnderABeam, WhatNobodyHasSeenBelowItIsNotFlownThrough) {
  VoxelRoom room;
  room.draw({0.2, 0.2, 0.1}, {3.9, 3.8, 1.35}, VoxelRoom::kSeenFree);
  map3d_ = room.layer();
  want(to(6.5, 2.0));
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed);
  EXPECT_LT(position_m().x(), 3.7);
}

TEST_F(UnderABeam, WithALaserAloneItIsUnknownAndSaidOnce) {
  want(to(6.5, 2.0));
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed);
  EXPECT_EQ(timesSaid("room below the obstacle on the path is unknown"), 1);
  want(to(6.5, 3.0));
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed);
  EXPECT_EQ(timesSaid("room below the obstacle on the path is unknown"), 1);
}

TEST_F(UnderABeam, AFlightBackAlongTheTrailIsAsLow) {
  see();
  want(to(6.5, 2.0));
  ASSERT_EQ(runToTheEnd(40.0), IntentState::kSucceeded);
  std::vector<Eigen::Vector2d> back_map_m;
  for (double x_m = 6.5; x_m > 1.5; x_m -= 0.1) back_map_m.emplace_back(x_m, 2.0);
  want(common::RetraceIntent{back_map_m, {}});
  EXPECT_LT(fliesBelowBeam_m(40.0), 0.9 - 0.125 - 0.1);
  ASSERT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_NEAR(height_m(), kHeight_m, 0.05);
}

TEST_F(UnderABeam, AHoldBelowItStaysThereAndTheNextGoalLeadsOut) {
  see();
  want(to(6.5, 2.0));
  runUntil([&] { return position_m().x() > 4.05; }, 40.0);
  want(common::HoldIntent{});
  run(3.0);
  EXPECT_LT(height_m(), 0.9 - 0.125 - 0.1);
  want(to(1.5, 2.0));
  EXPECT_LT(fliesBelowBeam_m(40.0), 0.9 - 0.125 - 0.1);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_NEAR(height_m(), kHeight_m, 0.05);
}

TEST_F(UnderABeam, WithoutTheVoxelsItLeavesThePlaceBelowAsLowAsItIs) {
  see();
  want(to(6.5, 2.0));
  runUntil([&] { return position_m().x() > 3.95; }, 40.0);
  want(common::HoldIntent{});
  run(1.0);
  ASSERT_GT(position_m().x(), 3.75);
  ASSERT_LT(position_m().x(), 4.3) << "below the beam";
  map3d_.reset();
  want(to(6.5, 2.0));
  EXPECT_LT(fliesBelowBeam_m(40.0), 0.9 - 0.125 - 0.1);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_NEAR(height_m(), kHeight_m, 0.05);
}

}  // namespace
}  // namespace swiftlet::autonomy
