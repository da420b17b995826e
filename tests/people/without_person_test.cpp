// The world without the person who is followed: what that person left in the map, and walls, which stay.
#include "perception/people/without_person.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/planning/grid_builder.hpp"

namespace swiftlet::perception {
namespace {

using Point = Eigen::Vector2d;

common::Time at(double seconds) { return common::Time::fromSeconds(seconds); }

/// The person walked from (4, 5) to (6, 5); the vehicle is at (2, 5) and sees 7 m far ahead, or as far as told.
class WithoutPerson : public testing::Test {
 protected:
  WithoutPerson() {
    planning::test::fill(grid_, {{0, 0}, {199, 199}}, planning::test::kFreeCell);
    for (double x_m = 4.0; x_m <= 6.01; x_m += 0.1) {
      common::DynamicObstacle person;
      person.id = 1;
      person.center_map_m = {x_m, 5.0};
      person.velocity_map_m_s = {0.5, 0.0};
      person.moving = true;
      person.last_seen = now_;
      if (!watch_.known()) watch_.choose(std::vector{person}, {2.0, 5.0});
      watch_.update(std::vector{person}, {std::make_shared<common::OccupancyGrid>(grid_.snapshot()), nullptr}, now_);
      now_ += common::Duration::fromMilliseconds(200);
    }
  }
  void mark(double x_m, double y_m) { grid_.set(grid_.cellAt(x_m, y_m), planning::test::kWallCell); }
  void see(double range_m) {
    seen_.from_map_m = {2.0, 5.0};
    for (int degree = -60; degree < 60; ++degree) {
      const double angle_rad = (degree + 0.5) * std::numbers::pi / 180.0;
      seen_.points_map_m.emplace_back(2.0 + range_m * std::cos(angle_rad), 5.0 + range_m * std::sin(angle_rad));
    }
  }
  common::OccupancyGrid without() {
    return mapWithout(watch_, now_, grid_.snapshot(), seen_.points_map_m.empty() ? nullptr : &seen_);
  }
  static bool occupied(const common::OccupancyGrid& grid, double x_m, double y_m) {
    return common::occupancy::isOccupied(grid.at(grid.cellAt(x_m, y_m)));
  }

  common::OccupancyGrid grid_ = common::makeOccupancyGrid(0.05);
  PersonWatch watch_;
  common::Time now_ = at(1.0);
  SeenPoints seen_;
};

TEST_F(WithoutPerson, ForgetsWhereThePersonWasIfTheScanSeesPast) {
  mark(4.5, 5.4);
  EXPECT_TRUE(occupied(without(), 4.5, 5.4)) << "without a scan it may be a wall";
  see(2.0);
  EXPECT_TRUE(occupied(without(), 4.5, 5.4)) << "a beam ends before it";
  seen_.points_map_m.clear();
  see(4.0);
  EXPECT_FALSE(occupied(without(), 4.5, 5.4));
}

TEST_F(WithoutPerson, ForgetsWhatIsWhereTheBodyWas) {
  mark(4.5, 5.2);
  EXPECT_FALSE(occupied(without(), 4.5, 5.2));
}

TEST_F(WithoutPerson, KeepsWhatTheScanEndsOnAndWhatIsNotOnTheTrail) {
  see(2.5);
  mark(4.5, 5.4);
  mark(4.0, 6.0);
  const common::OccupancyGrid grid = without();
  EXPECT_TRUE(occupied(grid, 4.5, 5.4));
  EXPECT_TRUE(occupied(grid, 4.0, 6.0));
}

TEST_F(WithoutPerson, ForgetsThePersonWhoIsThere) {
  see(3.9);
  mark(5.95, 5.1);
  EXPECT_FALSE(occupied(without(), 5.95, 5.1));
  EXPECT_TRUE(common::occupancy::isOccupied(grid_.at(grid_.cellAt(5.95, 5.1)))) << "the map itself is as it was";
}

TEST_F(WithoutPerson, LeavesOutTheDiscsOfThePersonOnly) {
  const std::vector discs = discsWithout(watch_, now_, {{{6.0, 5.0}, 0.5}, {{6.4, 5.0}, 0.5}, {{5.0, 6.5}, 0.5}});
  ASSERT_EQ(discs.size(), 1u);
  EXPECT_EQ(discs.front().center_map_m, Point(5.0, 6.5));
}

}  // namespace
}  // namespace swiftlet::perception
