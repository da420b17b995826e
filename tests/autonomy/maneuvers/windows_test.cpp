// Two walls across the room, each with a window, at heights that no plane joins: the vehicle changes its height for
// each where the voxels show room.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"
#include "tests/autonomy/voxel_room.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kWallCell;

class Windows : public ManeuverInFlight {
 protected:
  /// At x = 3 and 5 m, 0.8 m wide around y = 2 m.
  static constexpr double kLowBottom_m = 0.5, kHighBottom_m = 1.15, kTall_m = 0.75;

  void SetUp() override {
    ManeuverInFlight::SetUp();
    fill(grid_, {{60, 0}, {63, 80}}, kWallCell);
    fill(grid_, {{100, 0}, {103, 80}}, kWallCell);
  }
  void see(double high_bottom_m = kHighBottom_m) {
    VoxelRoom room;
    room.draw({0.2, 0.2, 0.1}, {7.8, 3.8, 2.1}, VoxelRoom::kSeenFree);
    const auto wall = [&](double x_m, double bottom_m) {
      room.draw({x_m, 0.0, 0.0}, {x_m + 0.15, 4.0, 2.2}, VoxelRoom::kSeenOccupied);
      room.draw({x_m - 0.1, 1.6, bottom_m}, {x_m + 0.25, 2.4, bottom_m + kTall_m}, VoxelRoom::kSeenFree);
    };
    wall(3.0, kLowBottom_m);
    wall(5.0, high_bottom_m);
    map3d_ = room.layer();
  }
  double height_m() const { return state_.T_odom_body.position_m.z(); }
  /// Flies to the end; the least room that the hull had to the frame of the window in which it was.
  double leastRoom_m(double limit_s) {
    constexpr double kHalfHull_m = 0.125, kRadius_m = 0.275;
    double least_m = 1.0;
    runUntil(
        [&] {
          for (const auto& [x_m, bottom_m] : {std::pair{3.0, kLowBottom_m}, std::pair{5.0, kHighBottom_m}}) {
            if (std::abs(position_m().x() - (x_m + 0.075)) > 0.075 + kRadius_m) continue;
            const double low_m = height_m() - kHalfHull_m - bottom_m,
                         high_m = bottom_m + kTall_m - height_m() - kHalfHull_m,
                         beside_m = 0.4 - kRadius_m - std::abs(position_m().y() - 2.0);
            least_m = std::min({least_m, low_m, high_m, beside_m});
          }
          return ended();
        },
        limit_s);
    return least_m;
  }
};

TEST_F(Windows, AreFlownThroughAtTheirHeights) {
  see();
  want(to(6.8, 2.0));
  EXPECT_GT(leastRoom_m(60.0), 0.0);
  ASSERT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({6.8, 2.0}), 0.05);
  EXPECT_NEAR(height_m(), kHeight_m, 0.05) << "it is back at the height of flight";
  EXPECT_EQ(executor_.dip_m(), 0.0);
  EXPECT_GE(timesSaid("changes its height"), 1);
}

TEST_F(Windows, AFlightBackAlongTheTrailHasTheSameHeights) {
  see();
  want(to(6.8, 2.0));
  ASSERT_EQ(runToTheEnd(60.0), IntentState::kSucceeded);
  std::vector<Eigen::Vector2d> back_map_m;
  for (double x_m = 6.8; x_m > 4.0; x_m -= 0.1) back_map_m.emplace_back(x_m, 2.0);
  want(common::RetraceIntent{back_map_m, {}});
  EXPECT_GT(leastRoom_m(60.0), -0.05);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
}

TEST_F(Windows, WhatIsTooHighForTheVehicleIsNotFlownThrough) {
  see(1.6);
  want(to(6.8, 2.0));
  EXPECT_EQ(runToTheEnd(60.0), IntentState::kFailed);
  EXPECT_LT(position_m().x(), 4.7);
}

}  // namespace
}  // namespace swiftlet::autonomy
