// How scans are drawn into the grid of the map.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "perception/slam2d/sliced_map.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::Pose2;

DrawnScan around(double radius_m, int beams) {
  DrawnScan scan;
  for (int i = 0; i < beams; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / beams;
    scan.hits_level_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
  }
  return scan;
}

TEST(GridDrawing, BeamsDrawFreeThenOccupiedAndLeaveTheRestUnknown) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  const Pose2 pose{0.51, -0.32, 0.4};
  for (int i = 0; i < 3; ++i) map.draw(around(2.0, 720), pose);
  const common::OccupancyGrid grid = map.atFlightHeight();
  int occupied = 0;
  grid.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    const double range_m = (grid.centerOf(c) - pose.position_m()).norm();
    EXPECT_TRUE(range_m > 1.9 || common::occupancy::isFree(value)) << c.x << ' ' << c.y;
    EXPECT_TRUE(range_m < 2.1 || common::occupancy::isUnknown(value)) << c.x << ' ' << c.y;
    occupied += common::occupancy::isOccupied(value) ? 1 : 0;
  });
  EXPECT_GT(occupied, 200);  // 2 pi 2 m / 5 cm = 251 cells.
}

TEST(GridDrawing, ClearsAWalkerWhoLeft) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  DrawnScan person = around(3.0, 720);
  for (Eigen::Vector3f& p : person.hits_level_m)
    if (std::abs(std::atan2(p.y(), p.x())) < 0.15F) p *= 0.5F;
  for (int i = 0; i < 50; ++i) map.draw(person, {});
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  EXPECT_EQ(where(), config.max_steps);  // The confidence is capped, however long the person stood there.
  int scans = 0;
  for (; common::occupancy::isOccupied(where()) && scans < 100; ++scans) map.draw(around(3.0, 720), {});
  EXPECT_LE(scans, 12);
}

/// The scan of a laser at (0, y) that faces a wall along x = 2 m, from -3 m to 3 m. Its middle third is dark: beams
/// that meet it at less than 45 degrees do not return.
DrawnScan ofDarkWall(double y_m) {
  constexpr double kWall_m = 2.001;  // Within a cell.
  DrawnScan scan;
  for (double angle = -1.2; angle < 1.2; angle += 0.005) {
    const double at_m = y_m + kWall_m * std::tan(angle);
    if (std::abs(at_m) > 3.0) continue;
    const Eigen::Vector2d ahead(std::cos(angle), std::sin(angle));
    if (std::abs(at_m) < 1.0 && std::abs(angle) > 0.25 * std::numbers::pi)
      scan.no_returns_level_m.emplace_back(10.0 * ahead.x(), 10.0 * ahead.y(), 0.0);
    else
      scan.hits_level_m.emplace_back(kWall_m, at_m - y_m, 0.0);
  }
  return scan;
}

TEST(GridDrawing, BeamsWithoutReturnDoNotClearBehindADarkWall) {
  SlicedMap map{GridDrawingConfig{}};
  const auto at = [&](double x_m, double y_m) {
    return map.atFlightHeight().at(map.atFlightHeight().cellAt(x_m, y_m));
  };
  for (int i = 0; i < 3; ++i) map.draw(ofDarkWall(0.0), {});  // Seen head on, all of the wall returns the beams.
  for (int i = 0; i < 50; ++i) map.draw(ofDarkWall(-2.5), {0.0, -2.5, 0.0});
  for (int i = 0; i < 50; ++i) map.draw(ofDarkWall(2.5), {0.0, 2.5, 0.0});
  for (double y_m = -2.9; y_m < 2.9; y_m += 0.05) {
    EXPECT_TRUE(common::occupancy::isOccupied(at(2.01, y_m))) << y_m;
    for (double x_m = 2.1; x_m < 8.0; x_m += 0.05)
      EXPECT_TRUE(common::occupancy::isUnknown(at(x_m, y_m))) << x_m << ' ' << y_m;
  }
  EXPECT_TRUE(common::occupancy::isFree(at(1.8, 0.0))) << "up to the wall they do clear";
}

TEST(GridDrawing, BeamsWithoutReturnDoNotClearPastHitsOfNeighbouringBeams) {
  SlicedMap map{GridDrawingConfig{}};
  DrawnScan scan;
  for (int i = -20; i <= 20; ++i) {  // Every second beam does not return.
    const float y_m = 0.02F * static_cast<float>(i);
    if (i % 2 == 0)
      scan.hits_level_m.emplace_back(2.01F, y_m, 0.0F);
    else
      scan.no_returns_level_m.emplace_back(4.0F * 2.01F, 4.0F * y_m, 0.0F);
  }
  map.draw(scan, {});
  const common::OccupancyGrid grid = map.atFlightHeight();
  grid.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
    EXPECT_TRUE(grid.centerOf(c).x() < 2.1 || common::occupancy::isUnknown(value)) << c.x << ' ' << c.y;
  });
  EXPECT_TRUE(common::occupancy::isOccupied(grid.at(grid.cellAt({2.01, 0.0}))));
}

TEST(GridDrawing, BeamsWithoutReturnClearOpenSpace) {
  SlicedMap map{GridDrawingConfig{}};
  DrawnScan scan = around(1.0, 720);
  std::erase_if(scan.hits_level_m, [](const Eigen::Vector3f& p) { return p.x() > 0.5F; });
  scan.no_returns_level_m = {{9.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.2F}, {9.0F, 0.0F, -0.2F}};
  for (int i = 0; i < 3; ++i) map.draw(scan, {});
  const common::OccupancyGrid grid = map.atFlightHeight();
  for (double x_m = 0.1; x_m < 8.9; x_m += 0.05)
    EXPECT_TRUE(common::occupancy::isFree(grid.at(grid.cellAt(x_m, 0.0)))) << x_m;
}

TEST(GridDrawing, UnchangedTilesStayShared) {
  const GridDrawingConfig config;
  SlicedMap map(config);
  for (int i = 0; i < 30; ++i) map.draw(around(1.0, 360), {});
  const common::OccupancyGrid before = map.atFlightHeight();
  map.draw(around(1.0, 360), {});
  EXPECT_EQ(before.tileIdentity({0, 0}), map.atFlightHeight().tileIdentity({0, 0}));
}

/// A round wall at 3 m, and in front of it a lower obstacle that is hit by beams which point `below_m` down.
DrawnScan over(double below_m, double body_height_m) {
  DrawnScan scan = around(3.0, 720);
  scan.body_height_m = body_height_m;
  for (Eigen::Vector3f& p : scan.hits_level_m) {
    const bool ahead = std::abs(std::atan2(p.y(), p.x())) < 0.2F;
    if (ahead && below_m > 0.0) p *= 0.5F;
    if (ahead) p.z() = static_cast<float>(-below_m);
  }
  return scan;
}

TEST(GridDrawing, LevelBeamsDoNotSoonEraseLowerObstacles) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  for (int i = 0; i < 10; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
  map.draw(over(0.15, 1.0), {});  // The vehicle pitches for one scan.
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  // The obstacle stays in the map long enough to be measured again on approach; if it is not measured again, it fades.
  for (int i = 0; i < 50; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  for (int i = 0; i < 50; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
  // Just below the level beams an obstacle fades sooner, because those beams dip to that height now and then.
  map.draw(over(0.06, 1.0), {});
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  for (int i = 0; i < 25; ++i) map.draw(over(0.0, 1.0), {});
  EXPECT_TRUE(common::occupancy::isFree(where()));
}

/// The map that is updated cell by cell while drawing equals the map that is combined afresh from all slices.
TEST(GridDrawing, TheMapAtFlightHeightEqualsItsCombinedSlices) {
  common::RandomStream random(1, "slices");
  SlicedMap map{GridDrawingConfig{}};
  for (int i = 0; i < 300; ++i) {
    DrawnScan scan = around(random.uniform(1.0, 3.0), 360);
    scan.body_height_m = random.uniform(0.7, 1.3);
    for (Eigen::Vector3f& p : scan.hits_level_m) p.z() = static_cast<float>(random.uniform(-0.4, 0.4));
    map.draw(scan, {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-3.0, 3.0)});
    if (i % 20 != 0) continue;
    const common::OccupancyGrid kept_up = map.atFlightHeight();
    ASSERT_TRUE(map.setFlightHeight(5.0));
    ASSERT_TRUE(map.setFlightHeight(1.0));
    const common::OccupancyGrid anew = map.atFlightHeight();
    int known = 0, different = 0;
    anew.forEachCell([&](CellIndex c, common::occupancy::Cell value) {
      known += common::occupancy::isUnknown(value) ? 0 : 1;
      if (i > 0) different += value == kept_up.at(c) ? 0 : 1;  // The first flight height is that of the first scan.
    });
    EXPECT_GT(known, 500);
    EXPECT_EQ(different, 0) << "after " << i + 1 << " scans";
  }
}

TEST(GridDrawing, LowObstaclesCountOnlyNearTheFlightHeight) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  for (int i = 0; i < 3; ++i) map.draw(over(0.0, 0.6), {});
  for (int i = 0; i < 3; ++i) map.draw(over(0.01, 0.6), {});  // An obstacle 0.6 m high.
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  EXPECT_TRUE(map.setFlightHeight(1.4));
  for (int i = 0; i < 3; ++i) map.draw(over(0.0, 1.4), {});  // Seen from far above it.
  EXPECT_TRUE(common::occupancy::isFree(where()));
  map.draw(over(0.4, 1.4), {});  // A view that ends far below says that the hull's height is free.
  EXPECT_TRUE(common::occupancy::isFree(where()));
  EXPECT_TRUE(map.setFlightHeight(0.6));
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
}

TEST(GridDrawing, BeamsBeginAtTheHeightOfTheLaser) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(0.6, 0.0)); };
  map.draw(over(0.0, 1.0), {});
  DrawnScan down = around(0.6, 720);  // The vehicle pitches: its beams end on a table as high as its body.
  down.body_height_m = 1.0;
  map.draw(down, {});
  ASSERT_TRUE(common::occupancy::isOccupied(where()));
  DrawnScan level = around(3.0, 720);  // 10 cm above the table at each place, not only where they end.
  level.body_height_m = 1.0;
  level.laser_height_m = 0.10F;
  for (Eigen::Vector3f& p : level.hits_level_m) p.z() = 0.10F;
  for (int i = 0; i < 10; ++i) map.draw(level, {});
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
}

/// Draws scans of one kind over `duration_s`, as a flight does four times a second.
class Watching {
 public:
  explicit Watching(SlicedMap& map) : map_(map) {}
  void draw(DrawnScan scan, double duration_s) {
    for (double at_s = 0.0; at_s < duration_s; at_s += 0.25) {
      scan.stamp = scan.stamp + common::Duration::fromSeconds(now_s_ += 0.25);
      map_.draw(scan, {});
      scan.stamp = {};
    }
  }

 private:
  SlicedMap& map_;
  double now_s_ = 0.0;
};

/// Beams that reach the wall and are 30 cm below the body where the obstacle stood.
DrawnScan through() {
  DrawnScan scan = over(0.0, 1.0);
  for (Eigen::Vector3f& p : scan.hits_level_m) p.z() = -0.6F;
  return scan;
}

/// A person at 1.5 m, at whom beams of all tilts end, and who leaves. The vehicle hovers: all beams pass at one height.
class PersonWhoLeaves : public testing::Test {
 protected:
  PersonWhoLeaves() {
    for (const double below_m : {0.0, 0.2, 0.0, 0.15, -0.15, 0.1, 0.0, -0.1, -0.2, 0.05, -0.05, 0.0})
      watching_.draw(upright(below_m), 1.0);
  }
  /// Level beams meet the person as well, and pass beside.
  static DrawnScan upright(double below_m) {
    DrawnScan scan = over(std::max(below_m, 1e-6), 1.0);
    for (Eigen::Vector3f& p : scan.hits_level_m)
      if (p.head<2>().norm() < 2.0F) p.z() = static_cast<float>(-below_m);
    return scan;
  }
  common::occupancy::Cell at(double x_m, double y_m) {
    return map_.atFlightHeight().at(map_.atFlightHeight().cellAt(x_m, y_m));
  }
  bool stands() {
    for (double y_m = -0.25; y_m <= 0.25; y_m += 0.02)
      if (common::occupancy::isOccupied(at(1.5, y_m))) return true;
    return false;
  }
  SlicedMap map_{GridDrawingConfig{}};
  Watching watching_{map_};
};

TEST_F(PersonWhoLeaves, IsGoneAtEveryHeightAfterTwoSecondsOfPassing) {
  ASSERT_TRUE(stands());
  watching_.draw(over(0.0, 1.0), 1.5);
  EXPECT_TRUE(stands()) << "not at once: a return may be missing";
  watching_.draw(over(0.0, 1.0), 1.0);
  EXPECT_FALSE(stands());
  EXPECT_TRUE(common::occupancy::isOccupied(at(3.01, 0.0))) << "the wall behind stays";
}

/// What does not go by this rule is not told: another map may see it otherwise.
TEST_F(PersonWhoLeaves, IsToldWithThePlaceAndTheHeightOfTheBeams) {
  EXPECT_TRUE(map_.takeGone().empty());
  watching_.draw(over(0.0, 1.0), 2.5);
  const std::vector<GoneColumn> gone = map_.takeGone();
  ASSERT_GT(gone.size(), 5u);
  for (const GoneColumn& column : gone) {
    EXPECT_LT((column.place_map_m - Eigen::Vector2d(1.5, 0.0)).norm(), 0.4);
    EXPECT_NEAR(column.height_m, 1.0, 0.03);
  }
  EXPECT_TRUE(map_.takeGone().empty()) << "once";
}

TEST_F(PersonWhoLeaves, PassingIsSummedUpWhileNobodyLooksInBetween) {
  watching_.draw(over(0.0, 1.0), 1.25);
  DrawnScan elsewhere = around(3.0, 720);
  std::erase_if(elsewhere.hits_level_m, [](const Eigen::Vector3f& p) { return p.x() > 0.0F; });
  watching_.draw(elsewhere, 60.0);
  EXPECT_TRUE(stands());
  watching_.draw(over(0.0, 1.0), 1.25);
  EXPECT_FALSE(stands());
}

TEST_F(PersonWhoLeaves, ComesBackAtOnce) {
  watching_.draw(over(0.0, 1.0), 2.5);
  ASSERT_FALSE(stands());
  watching_.draw(upright(0.0), 0.25);
  EXPECT_TRUE(stands());
}

TEST_F(PersonWhoLeaves, IsNotPassedByBeamsAboveTheHead) {
  DrawnScan above = over(0.0, 1.5);
  watching_.draw(above, 20.0);
  EXPECT_TRUE(stands());
}

/// Who leans, or sways, is drawn in other cells below the level beams than in their plane.
TEST_F(PersonWhoLeaves, IsGoneWhereOnlyTiltedBeamsMetHim) {
  for (int sway = 0; sway < 3; ++sway) {
    watching_.draw(upright(0.0), 1.0);
    for (const double below_m : {0.2, 0.25}) {
      DrawnScan leaning = upright(below_m);
      for (Eigen::Vector3f& p : leaning.hits_level_m)
        if (p.head<2>().norm() < 2.0F) p.head<2>() *= 1.45F / 1.5F;
      watching_.draw(leaning, 1.0);
    }
  }
  ASSERT_TRUE(common::occupancy::isOccupied(at(1.45, 0.0)));
  watching_.draw(over(0.0, 1.0), 2.5);
  EXPECT_FALSE(common::occupancy::isOccupied(at(1.45, 0.0)));
  EXPECT_FALSE(stands());
}

/// Ends of which no two are at one height, some below the level beams and some above: a person, and no table.
TEST_F(PersonWhoLeaves, IsNoLowObstacleWhereBeamsEndedAboveThoseOfTheLaser) {
  for (int sway = 0; sway < 3; ++sway) {
    watching_.draw(over(0.0, 1.0), 1.0);
    for (const double below_m : {-0.15, 0.15, 0.15, -0.1, 0.1, -0.05}) {
      DrawnScan leaning = upright(below_m);
      for (Eigen::Vector3f& p : leaning.hits_level_m)
        if (p.head<2>().norm() < 2.0F) p.head<2>() *= 1.35F / 1.5F;
      watching_.draw(leaning, 0.25);
    }
  }
  ASSERT_TRUE(common::occupancy::isOccupied(at(1.35, 0.0)));
  watching_.draw(over(0.0, 1.0), 2.5);
  EXPECT_FALSE(common::occupancy::isOccupied(at(1.35, 0.0)));
}

/// What was met below somebody's middle, a cell beside, before the level beams met him.
TEST(GridDrawing, TheOutlineOfSomebodyGoesWithThem) {
  SlicedMap map{GridDrawingConfig{}};
  const auto at = [&](double x_m) { return map.atFlightHeight().at(map.atFlightHeight().cellAt(x_m, 0.0)); };
  const auto standing = [](double at_m, double below_m) {
    DrawnScan scan = around(3.0, 720);
    scan.body_height_m = 1.0;
    for (Eigen::Vector3f& p : scan.hits_level_m)
      if (p.x() > 0.0F && std::abs(p.y()) < 0.4F)
        p = {static_cast<float>(at_m), p.y() * static_cast<float>(at_m / 3.0), static_cast<float>(-below_m)};
    return scan;
  };
  Watching watching(map);
  watching.draw(standing(1.43, 0.15), 0.75);
  watching.draw(standing(0.93, 0.15), 0.75);  // Of something else.
  for (const double below_m : {0.0, 0.1, -0.1, 0.0}) watching.draw(standing(1.48, below_m), 1.0);
  ASSERT_TRUE(common::occupancy::isOccupied(at(1.48)));
  ASSERT_TRUE(common::occupancy::isOccupied(at(1.43)));
  watching.draw(over(0.0, 1.0), 2.5);
  EXPECT_FALSE(common::occupancy::isOccupied(at(1.48)));
  EXPECT_FALSE(common::occupancy::isOccupied(at(1.43)));
  EXPECT_TRUE(common::occupancy::isOccupied(at(0.93))) << "beams 15 cm above it tell nothing of it";
}

/// 4 m away the height of a beam is known to two slices. What seemed to be low, and reaches two slices higher, is met
/// now and then by beams at its top if it is there.
TEST(GridDrawing, ALowObstacleThatBeamsPassAtItsTopIsGoneAfterAWhile) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(4.0, 0.0)); };
  const auto scanOf = [](bool met, double below_m) {
    DrawnScan scan = around(5.0, 1440);
    scan.body_height_m = 1.0;
    for (Eigen::Vector3f& p : scan.hits_level_m) {
      p.z() = static_cast<float>(-below_m * 5.0 / 4.0);
      if (met && p.x() > 0.0F && std::abs(p.y()) < 0.4F) p *= 0.8F;
    }
    return scan;
  };
  Watching watching(map);
  for (int tilt = 0; tilt < 3; ++tilt) {
    watching.draw(scanOf(false, 0.0), 5.0);
    watching.draw(scanOf(true, 0.15), 0.75);
  }
  watching.draw(scanOf(true, 0.25), 0.5);
  watching.draw(scanOf(true, 0.05), 0.5);
  ASSERT_TRUE(common::occupancy::isOccupied(where()));
  watching.draw(scanOf(false, 0.15), 6.0);
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  watching.draw(scanOf(true, 0.15), 0.25);
  watching.draw(scanOf(false, 0.15), 6.0);
  EXPECT_TRUE(common::occupancy::isOccupied(where())) << "it was met in between";
  watching.draw(scanOf(false, 0.15), 4.0);
  EXPECT_FALSE(common::occupancy::isOccupied(where()));
}

/// A single end, at any height that the hull may touch, is no more than a trace.
TEST(GridDrawing, ATraceAtTheLowestHeightOfTheHullFades) {
  const GridDrawingConfig config;
  SlicedMap map{config};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  Watching watching(map);
  watching.draw(over(config.max_height_below_m - 0.01, 1.0), 0.25);
  ASSERT_TRUE(common::occupancy::isOccupied(where()));
  DrawnScan level = around(3.0, 720);  // Of a laser on top of the hull: 34 cm above the trace.
  level.body_height_m = 1.0;
  level.laser_height_m = 0.10F;
  for (Eigen::Vector3f& p : level.hits_level_m) p.z() = 0.10F;
  watching.draw(level, 20.0);
  EXPECT_FALSE(common::occupancy::isOccupied(where()));
}

/// A pole of 2 cm stands in the middle of its cell. The beams of a coarse laser meet it now and then, and pass beside
/// it otherwise.
TEST(GridDrawing, AThinPoleStays) {
  SlicedMap map{GridDrawingConfig{}};
  common::RandomStream random(3, "pole");
  const Eigen::Vector2d pole(2.025, 0.025);
  double now_s = 0.0;
  for (int i = 0; i < 400; ++i) {
    DrawnScan scan;
    const double turned = random.uniform(0.0, 0.0175), tilt_m = random.uniform(-0.2, 0.2);
    for (double angle = turned - 0.5; angle < 0.5; angle += 0.0175) {  // A degree: 3.5 cm at the pole.
      const Eigen::Vector2d ahead(std::cos(angle), std::sin(angle));
      const double to_m = pole.dot(ahead), aside_m = std::abs(pole.x() * ahead.y() - pole.y() * ahead.x());
      const double range_m = (aside_m < 0.01 ? to_m : 4.0) + random.gaussian(0.005);
      scan.hits_level_m.emplace_back(range_m * ahead.x(), range_m * ahead.y(), tilt_m * range_m / 4.0);
    }
    scan.stamp = scan.stamp + common::Duration::fromSeconds(now_s += 0.25);
    scan.body_height_m = 1.0;
    map.draw(scan, {});
    const common::OccupancyGrid grid = map.atFlightHeight();
    if (i > 20) {
      ASSERT_TRUE(common::occupancy::isOccupied(grid.at(grid.cellAt(pole)))) << i;
    }
  }
}

TEST(GridDrawing, WhatTiltedBeamsMeetAgainAndAgainStays) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  Watching watching(map);
  for (int tilt = 0; tilt < 3; ++tilt) {
    watching.draw(over(0.0, 1.0), 15.0);
    watching.draw(over(0.15, 1.0), 0.5);
    watching.draw(over(0.30, 1.0), 0.5);
    watching.draw(over(0.45, 1.0), 0.5);
  }
  watching.draw(over(0.0, 1.0), 45.0);
  EXPECT_TRUE(common::occupancy::isOccupied(where())) << "beams that pass above it do not erase it";
  EXPECT_TRUE(map.setFlightHeight(1.5));
  EXPECT_FALSE(common::occupancy::isOccupied(where()));
  EXPECT_TRUE(map.setFlightHeight(1.0));
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  watching.draw(through(), 10.0);
  EXPECT_FALSE(common::occupancy::isOccupied(where())) << "it has been taken away";
}

TEST(GridDrawing, BeamsUnderATableDoNotEraseIt) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  Watching watching(map);
  for (int tilt = 0; tilt < 3; ++tilt) {
    watching.draw(over(0.0, 1.0), 5.0);
    watching.draw(over(0.10, 1.0), 0.5);
  }
  watching.draw(through(), 45.0);
  EXPECT_TRUE(common::occupancy::isOccupied(where()));
  watching.draw(through(), 60.0);
  EXPECT_FALSE(common::occupancy::isOccupied(where())) << "it was not met for a minute";
}

TEST(GridDrawing, WhatMovesIsNoLowObstacle) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  DrawnScan walker = over(0.15, 1.0);
  walker.moves.assign(walker.hits_level_m.size(), true);
  Watching watching(map);
  for (int pass = 0; pass < 4; ++pass) {
    watching.draw(over(0.0, 1.0), 5.0);
    watching.draw(walker, 0.5);
  }
  watching.draw(over(0.0, 1.0), 90.0);
  EXPECT_TRUE(common::occupancy::isFree(where()));
}

TEST(GridDrawing, SomebodyWhoComesTwiceDoesNotStay) {
  SlicedMap map{GridDrawingConfig{}};
  const auto where = [&] { return map.atFlightHeight().at(map.atFlightHeight().cellAt(1.5, 0.0)); };
  DrawnScan upright = over(0.15, 1.0);  // Level beams meet the person, too.
  for (Eigen::Vector3f& p : upright.hits_level_m) p.z() = 0.0F;
  Watching watching(map);
  watching.draw(over(0.0, 1.0), 5.0);
  for (int visit = 0; visit < 3; ++visit) {
    watching.draw(over(0.15, 1.0), 0.5);
    watching.draw(upright, 1.0);
    watching.draw(over(0.15, 1.0), 0.5);
    watching.draw(over(0.0, 1.0), 90.0);
    EXPECT_TRUE(common::occupancy::isFree(where())) << visit;
  }
}

TEST(GridDrawing, ThinsAndBoundsItsPoints) {
  const GridDrawingConfig config;
  ProjectedScan scan;
  for (int i = 0; i < 1000; ++i) scan.points_level_m.emplace_back(1.0F, 0.001F * static_cast<float>(i));
  scan.points_level_m.emplace_back(100.0F, 0.0F);
  scan.points_level_m.emplace_back(3.0F, 0.0F);
  scan.heights_level_m.assign(1001, 0.0F);
  scan.heights_level_m.push_back(1.5F);  // Far above the body.
  scan.misses_level_m = {{0.0F, 30.0F, 0.0F}, {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}};
  scan.no_returns_level_m = scan.misses_level_m;
  const DrawnScan drawn = thinForDrawing(scan, config);
  EXPECT_LT(drawn.hits_level_m.size(), 60U);
  ASSERT_EQ(drawn.free_level_m.size(), 3U);
  EXPECT_NEAR(drawn.free_level_m[0].norm(), config.max_hit_range_m, 1e-3);
  EXPECT_NEAR(drawn.free_level_m[1].z(), config.max_height_above_m, 1e-6);  // Free within the height of the hull.
  EXPECT_NEAR(drawn.free_level_m[1].x(), 3.0 * config.max_height_above_m / 1.5, 1e-6);
  EXPECT_NEAR(drawn.free_level_m[2].norm(), config.max_free_range_m, 1e-3);
  ASSERT_EQ(drawn.no_returns_level_m.size(), 1U);
  EXPECT_NEAR(drawn.no_returns_level_m[0].norm(), config.max_free_range_m, 1e-3);
}

}  // namespace
}  // namespace swiftlet::perception
