// What has changed since the given map was made, and what is only noise of two maps of one place.
#include "autonomy/given_map/map_changes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swiftlet::autonomy {
namespace {

using common::OccupancyGrid;
using common::Pose2;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kCell_m = 0.05;

/// A room of 6 m by 4 m, free, with a wall at x = 5 m, as both maps have it at first.
class MapChangesStory : public testing::Test {
 protected:
  MapChangesStory() {
    for (OccupancyGrid* grid : {&flown_, &laid_}) {
      fill(*grid, 0.0, 6.0, 0.0, 4.0, -100);
      fill(*grid, 5.0, 5.1, 0.0, 4.0, 100);
    }
  }
  static void fill(OccupancyGrid& grid, double x_min, double x_max, double y_min, double y_max, int value) {
    for (double y = y_min + 0.5 * kCell_m; y < y_max; y += kCell_m)
      for (double x = x_min + 0.5 * kCell_m; x < x_max; x += kCell_m)
        grid.set(grid.cellAt(x, y), static_cast<common::occupancy::Cell>(value));
  }
  std::vector<common::Event> checks(int count) {
    for (int i = 0; i < count; ++i) {
      now_ += common::Duration::fromSeconds(2.0);
      changes_.update(now_, flown_, laid_, T_map_given_);
    }
    return log_.take();
  }

  OccupancyGrid flown_ = common::makeOccupancyGrid(kCell_m), laid_ = common::makeOccupancyGrid(kCell_m);
  Pose2 T_map_given_;
  common::EventLog log_;
  MapChanges changes_{log_};
  common::Time now_;
};

TEST_F(MapChangesStory, NothingIsSaidOfOneRoomInTwoMaps) {
  fill(flown_, 5.0, 5.1, 0.0, 4.0, -100);
  fill(flown_, 5.2, 5.3, 0.0, 4.0, 100);  // The same wall, 20 cm off.
  EXPECT_THAT(checks(10), IsEmpty());
}

TEST_F(MapChangesStory, ANewBoxIsSaidOnceWithItsPlaceInTheGivenMap) {
  T_map_given_ = {1.0, 0.0, 0.0};
  fill(flown_, 3.0, 3.4, 2.1, 2.3, 100);
  EXPECT_THAT(checks(2), IsEmpty()) << "somebody may walk by";
  const auto events = checks(1);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "obstacle that is not in the given map");
  EXPECT_EQ(events[0].reason, "within half a metre of (2.5, 2.5) in the given map");
  EXPECT_THAT(checks(10), IsEmpty());
}

TEST_F(MapChangesStory, WhatIsGoneIsSaidToo) {
  fill(laid_, 1.0, 1.4, 1.0, 1.4, 100);
  const auto events = checks(3);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "obstacle of the given map not seen at this height");
  EXPECT_THAT(events[0].reason, HasSubstr("(1.5, 1.5)"));
}

TEST_F(MapChangesStory, WhoWalksByOrIsTooSmallIsNotSaid) {
  fill(flown_, 3.0, 3.4, 2.1, 2.3, 100);
  EXPECT_THAT(checks(2), IsEmpty());
  fill(flown_, 3.0, 3.4, 2.1, 2.3, -100);
  EXPECT_THAT(checks(1), IsEmpty());
  fill(flown_, 3.0, 3.4, 2.1, 2.3, 100);
  EXPECT_THAT(checks(2), IsEmpty()) << "its checks do not add up";
  fill(flown_, 3.0, 3.4, 2.1, 2.3, -100);
  fill(flown_, 3.0, 3.1, 2.1, 2.2, 100);
  EXPECT_THAT(checks(5), IsEmpty());
}

}  // namespace
}  // namespace swiftlet::autonomy
