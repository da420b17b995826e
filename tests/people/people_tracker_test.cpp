// A vehicle in a known room tracks the people who walk through it, and leaves them out of the match.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "perception/people/people_tracker.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::perception {
namespace {

using common::Disc;
using common::Pose2;
using common::Time;
using Point = Eigen::Vector2d;

/// End points on the side of a person that faces the vehicle.
void addPerson(ProjectedScan& scan, const Point& center_level_m, float height_m = 0.0F) {
  const double facing_rad = std::atan2(-center_level_m.y(), -center_level_m.x());
  for (double a = -1.2; a <= 1.2; a += 0.08) {
    const double angle_rad = facing_rad + a;
    scan.points_level_m.push_back(
        (center_level_m + 0.25 * Point(std::cos(angle_rad), std::sin(angle_rad))).cast<float>());
    scan.heights_level_m.push_back(height_m);
  }
}

struct People : testing::Test {
  std::shared_ptr<const common::OccupancyGrid> room =
      std::make_shared<common::OccupancyGrid>(planning::test::room(200, 160));
  PeopleTracker tracker{HeightBand{}};
  Pose2 T_map_body{5, 4, 0.5 * std::numbers::pi};  // It looks along y.

  ProjectedScan scanAt(double s) const {
    ProjectedScan scan;
    scan.stamp = Time::fromSeconds(s);
    return scan;
  }
  /// A person walks along x of the map, 2 m ahead of the vehicle, at 1 m/s.
  void walk(double from_s, double to_s, const Pose2& T_map_odom = {}) {
    for (double t = from_s; t < to_s; t += 0.025) {
      ProjectedScan scan = scanAt(t);
      addPerson(scan, T_map_body.inverse() * Point(4.0 + t, 6.0));
      tracker.update(scan, T_map_body, T_map_odom, room);
    }
  }
};

TEST_F(People, AWalkerIsTrackedInTheMapAndPredictedToTheNextScan) {
  walk(0.0, 1.0);
  ASSERT_EQ(tracker.obstacles().size(), 1u);
  EXPECT_TRUE(tracker.anyMoves());
  const auto expected = tracker.expectedAt(Time::fromSeconds(1.1));
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_NEAR((expected[0].center_map_m - Point(5.1, 6.0)).norm(), 0.0, 0.2);
  EXPECT_TRUE(expected[0].covers(Point(5.1, 5.75))) << "the side that faces the laser";
}

TEST_F(People, WhatIsBelowTheHeightOfTheMapCannotBeCompared) {
  const auto seenBelow = [&](double below_map_m, float height_m) {
    PeopleTracker low{HeightBand{}};
    for (double t = 0.0; t < 1.0; t += 0.025) {
      ProjectedScan scan = scanAt(t);
      addPerson(scan, T_map_body.inverse() * Point(4.0 + t, 6.0), height_m);
      low.update(scan, T_map_body, {}, room, std::nullopt, below_map_m);
    }
    return low.obstacles().size();
  };
  EXPECT_EQ(seenBelow(0.0, 0.0F), 1u);
  EXPECT_EQ(seenBelow(0.45, 0.0F), 0u) << "a chair that the map at the height of flight does not have";
  EXPECT_EQ(seenBelow(0.45, 0.45F), 1u) << "at the height of the map";
}

TEST_F(People, WhatTheGivenMapHasIsNoPerson) {
  // A pillar that the flight's own map does not have, in a given map whose frame is turned and shifted.
  const Pose2 T_grid_map{3.0, -1.0, 0.7};
  auto pillar = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  for (double x = -0.25; x <= 0.25; x += 0.02)
    for (double y = -0.25; y <= 0.25; y += 0.02)
      pillar->set(pillar->cellAt(T_grid_map * Point(5.0 + x, 6.0 + y)), common::occupancy::kMaxSteps);
  const auto seen = [&](const std::optional<GivenBackground>& given) {
    PeopleTracker with{HeightBand{}};
    for (double t = 0.0; t < 1.0; t += 0.025) {
      ProjectedScan scan = scanAt(t);
      addPerson(scan, T_map_body.inverse() * Point(5.0, 6.0));
      with.update(scan, T_map_body, {}, room, given);
    }
    return with.obstacles().size();
  };
  EXPECT_EQ(seen(std::nullopt), 1u);
  EXPECT_EQ(seen(GivenBackground{pillar, T_grid_map}), 0u);
  EXPECT_EQ(seen(GivenBackground{pillar, Pose2{9.0, 0.0, 0.0}}), 1u) << "elsewhere in the given map";
}

TEST_F(People, AnOldDetectionIsStillAvoidedButNotPredicted) {
  walk(0.0, 1.0);
  EXPECT_TRUE(tracker.expectedAt(Time::fromSeconds(1.5)).empty());
  EXPECT_FALSE(tracker.discs(Time::fromSeconds(1.5)).empty());
}

TEST_F(People, PointsAboveOrBelowTheHullAreNotTracked) {
  for (const float height_m : {0.3F, -0.3F}) {
    ProjectedScan scan = scanAt(height_m > 0 ? 1.0 : 2.0);
    addPerson(scan, Point(2, 0), height_m);
    tracker.update(scan, T_map_body, {}, room);
    EXPECT_TRUE(tracker.obstacles().empty()) << height_m;
  }
}

/// The old background shows free space where the corrected map has a wall.
TEST_F(People, ALoopClosureRestartsTheBackground) {
  common::OccupancyGrid with_wall = planning::test::room(200, 160);
  planning::test::fill(with_wall, {{70, 112}, {130, 130}}, planning::test::kWallCell);
  const auto corrected = std::make_shared<common::OccupancyGrid>(with_wall);
  ProjectedScan scan = scanAt(5.0);
  tracker.update(scan, T_map_body, {}, room);
  scan = scanAt(5.1);
  addPerson(scan, Point(2, 0));
  tracker.update(scan, T_map_body, Pose2{0.2, 0, 0}, corrected);
  EXPECT_TRUE(tracker.obstacles().empty());
  scan.stamp = Time::fromSeconds(5.2);
  PeopleTracker without_jump{HeightBand{}};
  without_jump.update(scanAt(5.0), T_map_body, {}, room);
  without_jump.update(scan, T_map_body, {}, corrected);
  EXPECT_EQ(without_jump.obstacles().size(), 1u) << "without the jump the background is still the old one";
}

TEST_F(People, WhoWalksIsNotDrawnAndTheWayThereIsFree) {
  walk(0.0, 1.0);
  const Time now = Time::fromSeconds(1.0);
  ASSERT_EQ(tracker.walkersAt(now).size(), 1u);
  ProjectedScan scan = scanAt(1.0);
  scan.laser_height_level_m = 0.1F;
  scan.points_level_m.push_back({3.0F, 2.0F});
  scan.heights_level_m.push_back(0.2F);
  scan.moves.push_back(true);
  addPerson(scan, T_map_body.inverse() * Point(5.0, 6.0));
  scan.moves.resize(scan.points_level_m.size(), false);
  const ProjectedScan drawn = withoutWalkers(tracker.walkersAt(now), T_map_body, scan);
  ASSERT_EQ(drawn.points_level_m.size(), 1u);
  EXPECT_EQ(drawn.points_level_m[0], scan.points_level_m[0]);
  EXPECT_EQ(drawn.heights_level_m, std::vector{0.2F});
  EXPECT_EQ(drawn.moves, std::vector{true});
  ASSERT_EQ(drawn.misses_level_m.size(), scan.points_level_m.size() - 1);
  for (std::size_t i = 0; i < drawn.misses_level_m.size(); ++i) {
    const Eigen::Vector2f end = scan.points_level_m[i + 1];
    EXPECT_NEAR(drawn.misses_level_m[i].head<2>().norm(), end.norm() - 0.3F, 1e-4F);
    EXPECT_GT(drawn.misses_level_m[i].z(), 0.0F) << "the beam begins at the laser, and ends lower";
  }
  for (double t = 1.0; t < 2.3; t += 0.025) {  // The person stands: the map may have it.
    ProjectedScan standing = scanAt(t);
    addPerson(standing, T_map_body.inverse() * Point(5.0, 6.0));
    tracker.update(standing, T_map_body, {}, room);
  }
  EXPECT_TRUE(tracker.walkersAt(Time::fromSeconds(2.3)).empty());
  EXPECT_EQ(withoutWalkers({}, T_map_body, scan).points_level_m.size(), scan.points_level_m.size());
}

TEST_F(People, PointsOnPeopleAreLeftOutOfTheMatch) {
  ProjectedScan scan = scanAt(0.0);
  for (int i = 0; i < 100; ++i) {
    scan.points_level_m.push_back({3.0F, 0.05F * static_cast<float>(i) - 2.5F});
    scan.heights_level_m.push_back(0.0F);
  }
  addPerson(scan, Point(2, 0));
  const std::size_t all = scan.points_level_m.size();
  const Disc person{T_map_body * Point(2, 0), 0.45};
  const ProjectedScan standing = withoutPeople(std::vector{person}, T_map_body, scan);
  EXPECT_EQ(standing.points_level_m.size(), 100u);
  EXPECT_EQ(standing.heights_level_m.size(), 100u);
  EXPECT_EQ(withoutPeople({}, T_map_body, scan).points_level_m.size(), all);
}

TEST_F(People, PointsOnPeopleStayInTheMatchWhenTooFewWouldRemain) {
  ProjectedScan scan = scanAt(0.0);
  addPerson(scan, Point(2, 0));
  const Disc person{T_map_body * Point(2, 0), 0.45};
  EXPECT_EQ(withoutPeople(std::vector{person}, T_map_body, scan).points_level_m.size(), scan.points_level_m.size());
}

}  // namespace
}  // namespace swiftlet::perception
