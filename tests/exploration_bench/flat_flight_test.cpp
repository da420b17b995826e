// Explorations of flat buildings by an ideal vehicle, and the short tour that they are compared with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "evaluation/exploration/flat_building.hpp"
#include "evaluation/exploration/flat_flight.hpp"
#include "evaluation/exploration/known_tour.hpp"

namespace swiftlet::evaluation {
namespace {

using common::CellIndex;

/// Three rooms of 4 m by 4 m in a row, cells of 0.1 m, with doors of 1 m at alternating ends.
common::OccupancyGrid threeRooms() {
  common::OccupancyGrid plan = common::makeOccupancyGrid(0.1);
  for (int y = 0; y <= 41; ++y)
    for (int x = 0; x <= 121; ++x) {
      const bool border = y == 0 || y == 41 || x == 0 || x == 121;
      const bool wall = (x == 40 && y < 31) || (x == 80 && y > 11);
      plan.set({x, y}, border || wall ? 100 : -100);
    }
  return plan;
}

planning::CostMap mapOf(const FlatBuilding& building) {
  planning::CostMap::Config plain;
  plain.comfort_weight = 0.0;
  planning::CostMap map(plain, building.resolution_m());
  map.update(building.seen(), {});
  return map;
}

TEST(FlatBuilding, IsWallWhereThePlanIsNotFree) {
  common::OccupancyGrid plan = threeRooms();
  plan.set({10, 10}, common::occupancy::kUnknown);
  for (const double resolution_m : {0.05, 0.1, 0.2}) {
    const FlatBuilding building(plan, resolution_m);
    EXPECT_TRUE(building.isWall(building.cellAt({1.05, 1.05}))) << "not known to be free";
    EXPECT_TRUE(building.isWall(building.cellAt({4.05, 1.0}))) << resolution_m;
    EXPECT_TRUE(building.isWall(building.cellAt({-5.0, 1.0}))) << "outside";
    EXPECT_FALSE(building.isWall(building.cellAt({2.5, 2.5}))) << resolution_m;
  }
}

TEST(FlatBuilding, ABeamEndsAtTheFirstWallOrAtItsRange) {
  const FlatBuilding building(threeRooms(), 0.1);
  int met = 0, walls = 0;
  CellIndex last;
  const auto count = [&](CellIndex cell, bool is_wall) {
    ++met;
    walls += is_wall ? 1 : 0;
    last = cell;
  };
  building.cast({2.05, 2.05}, 0.0, 30.0, count);
  EXPECT_EQ(last, (CellIndex{40, 20}));
  EXPECT_EQ(met, 20);
  EXPECT_EQ(walls, 1);
  met = walls = 0;
  building.cast({2.05, 2.05}, 0.5 * M_PI, 1.0, count);
  EXPECT_EQ(last, (CellIndex{20, 30}));
  EXPECT_EQ(walls, 0);
}

TEST(FlatBuilding, TheStartIsInTheLargestRegionNearWhatIsAskedFor) {
  common::OccupancyGrid plan = threeRooms();
  for (int y = 0; y <= 41; ++y) plan.set({40, y}, 100);  // The first room is closed.
  const planning::CostMap map = mapOf(FlatBuilding(plan, 0.1));
  const auto start = startIn(map, {1.0, 2.0});
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->x(), 4.5, 0.15);
  EXPECT_NEAR(startIn(map, {100.0, 0.0})->x(), 6.1, 0.5) << "the middle";
  common::OccupancyGrid full = common::makeOccupancyGrid(0.1);
  for (int i = 0; i < 10; ++i) full.set({i, 0}, -100);
  EXPECT_FALSE(startIn(mapOf(FlatBuilding(full, 0.1)), {0.0, 0.0}));
}

TEST(KnownTour, LeadsIntoEachRoomAndHomeAndNoFartherThanAnyExploration) {
  const FlatBuilding building(threeRooms(), 0.1);
  const Eigen::Vector2d start_m(1.05, 1.05);
  const KnownTour tour = knownTour(building, mapOf(building), start_m, 30.0);
  EXPECT_EQ(tour.points_map_m.front(), start_m);
  EXPECT_EQ(tour.points_map_m.back(), start_m);
  // The third room is seen through its door at the lower end from about the middle of the second one.
  EXPECT_GT(tour.length_m, 10.0);
  EXPECT_LT(tour.length_m, 24.0);
  for (const auto kind :
       {planning::ExplorerKind::kNearestFrontier, planning::ExplorerKind::kUtility, planning::ExplorerKind::kTour}) {
    FlatFlightConfig config;
    config.explorer.kind = kind;
    const FlatFlight flight = exploreFlat(building, start_m, config);
    EXPECT_TRUE(flight.complete) << toString(kind) << ": " << flight.failure;
    EXPECT_EQ(flight.unseen_share, 0.0) << toString(kind);
    EXPECT_GT(flight.total_m, 0.9 * tour.length_m) << toString(kind);
    EXPECT_GT(flight.total_s, flight.explore_s) << toString(kind);
    EXPECT_GE(flight.explore_s, flight.explore_m / config.speed_m_s) << toString(kind) << ": faster than it may fly";
    const FlatFlight again = exploreFlat(building, start_m, config);
    EXPECT_EQ(again.total_s, flight.total_s) << toString(kind) << ": the same each time";
    EXPECT_EQ(again.total_m, flight.total_m) << toString(kind);
  }
}

TEST(FlatFlight, WhatHasNoTimeFails) {
  const FlatBuilding building(threeRooms(), 0.1);
  FlatFlightConfig config;
  config.limit_s = 2.0;
  const FlatFlight flight = exploreFlat(building, {1.05, 1.05}, config);
  EXPECT_FALSE(flight.complete);
  EXPECT_THAT(flight.failure, testing::HasSubstr("not done after 2 s"));
  EXPECT_GT(flight.unseen_share, 0.2);
}

}  // namespace
}  // namespace swiftlet::evaluation
