// Places that something has left are free soon after level beams pass them, at every height.
#include "autonomy/estimation/vacated_places.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::Time;
using common::occupancy::isOccupied;

class VacatedPlacesStory : public testing::Test {
 protected:
  VacatedPlacesStory() {
    // The outline of who stands at (3, 0), a wall, and a shelf that no level beam meets.
    for (double y_m = -0.2; y_m <= 0.2; y_m += 0.02) occupy({2.8, y_m});
    for (double y_m = -3.0; y_m <= 3.0; y_m += 0.02) occupy({3.9, y_m});
    occupy({2.8, 1.5});
  }
  void occupy(const Eigen::Vector2d& at_m) { map_.set(map_.cellAt(at_m), 70); }

  /// Scans of `seconds` at 20 Hz from the vehicle, by beams that end on the wall or on who stands before it. Returns
  /// how often the cleared cells changed.
  int watch(double seconds, bool somebody_stands, float height_m = 0.0F) {
    int changes = 0;
    for (long i = 0; i < std::lround(seconds * 20.0); ++i) {
      perception::ProjectedScan scan;
      now_s_ += 0.05;
      vehicle_.x_m += 0.05 * speed_m_s_;
      scan.stamp = Time::fromSeconds(now_s_);
      for (double y_m = -2.9; y_m <= 2.9; y_m += 0.01) {
        const double depth_m = 3.9 - vehicle_.x_m, to_body_m = 2.8 - vehicle_.x_m;
        Eigen::Vector2d end(depth_m, y_m);
        if (somebody_stands && std::abs(y_m * to_body_m / depth_m) < 0.2) end *= to_body_m / depth_m;
        scan.points_level_m.push_back(end.cast<float>());
        scan.heights_level_m.push_back(height_m);
      }
      changes += places_.update(scan, vehicle_, published()) ? 1 : 0;
    }
    return changes;
  }
  common::OccupancyGrid published() {
    common::OccupancyGrid grid = map_.snapshot();
    places_.clear(grid, [this](common::CellIndex cell) { return kept_ && *kept_ == cell; });
    return grid;
  }
  bool occupiedAt(const Eigen::Vector2d& at_m) {
    const common::OccupancyGrid grid = published();
    return isOccupied(grid.at(grid.cellAt(at_m)));
  }

  common::OccupancyGrid map_ = common::makeOccupancyGrid(0.05);
  VacatedPlaces places_;
  std::optional<common::CellIndex> kept_;
  common::Pose2 vehicle_;
  double now_s_ = 0.0, speed_m_s_ = 0.0;
};

TEST_F(VacatedPlacesStory, WhatStandsStaysInTheMap) {
  watch(2.0, true);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
  EXPECT_TRUE(occupiedAt({3.9, 1.0}));
}

TEST_F(VacatedPlacesStory, WhatHasLeftIsGoneWithinHalfASecond) {
  watch(2.0, true);
  EXPECT_EQ(watch(0.2, false), 0);
  EXPECT_TRUE(occupiedAt({2.8, 0.0})) << "not at once: a return may be missing";
  EXPECT_GT(watch(0.3, false), 0);
  for (const double y_m : {-0.2, 0.0, 0.2}) EXPECT_FALSE(occupiedAt({2.8, y_m})) << y_m;
  EXPECT_TRUE(occupiedAt({3.9, 0.0})) << "the wall";
  EXPECT_TRUE(isOccupied(map_.at(map_.cellAt({2.8, 0.0})))) << "the method's own map is not changed";
}

TEST_F(VacatedPlacesStory, WhoComesBackIsThereAtOnce) {
  watch(2.0, true);
  watch(1.0, false);
  EXPECT_FALSE(occupiedAt({2.8, 0.0}));
  EXPECT_GT(watch(0.05, true), 0);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
}

TEST_F(VacatedPlacesStory, WhatLevelBeamsNeverMetIsKept) {
  watch(5.0, false);
  EXPECT_TRUE(occupiedAt({2.8, 1.5})) << "a shelf below or above";
  EXPECT_TRUE(occupiedAt({2.8, 0.0})) << "it was drawn by other beams than these";
}

TEST_F(VacatedPlacesStory, BeamsAtOtherHeightsSayNothing) {
  watch(2.0, true);
  watch(2.0, false, 0.3F);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
}

TEST_F(VacatedPlacesStory, TheTopOfATableJustBelowTheBeamsIsKept) {
  watch(2.0, true, -0.06F);
  watch(2.0, false);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
}

TEST_F(VacatedPlacesStory, WhatTheMapKnowsToEndBelowTheBeamsIsKept) {
  kept_ = map_.cellAt(2.8, 0.0);
  watch(2.0, true);
  watch(2.0, false);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
  EXPECT_FALSE(occupiedAt({2.8, 0.2}));
}

TEST_F(VacatedPlacesStory, InFlightTheMapClearsItself) {
  watch(2.0, true);
  speed_m_s_ = 0.5;
  watch(1.0, false);
  EXPECT_TRUE(occupiedAt({2.8, 0.0}));
}

}  // namespace
}  // namespace swiftlet::autonomy
