// The given map under the map of the flight.
#include "autonomy/given_map/given_map_overlay.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "perception/slam2d/sliced_map.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose2;
using common::occupancy::isFree;
using common::occupancy::isOccupied;
using common::occupancy::isUnknown;

constexpr double kCell_m = 0.05;

/// A given room of 6 m by 4 m with a wall at x = 5 m, in a frame that is turned and shifted against `map`.
class GivenMapOverlayStory : public testing::Test {
 protected:
  GivenMapOverlayStory() {
    auto room = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(kCell_m));
    for (double y_m = 0.02; y_m < 4.0; y_m += kCell_m)
      for (double x_m = 0.02; x_m < 6.0; x_m += kCell_m)
        room->set(room->cellAt(x_m, y_m), std::abs(x_m - 5.0) < 0.06 ? 100 : -100);
    given_.grid = room;
    given_.T_given_grid = {0.3, -0.2, 0.1};
    overlay_.emplace(&given_, log_);
  }

  void step(const std::optional<Pose2>& T_map_given, double seconds = 0.1) {
    now_ += common::Duration::fromSeconds(seconds);
    common::Localization localization;
    if (T_map_given) {
      localization.state = common::LocalizationState::kLocalized;
      localization.T_given_odom = T_map_given->inverse() * T_map_odom_;
    }
    overlay_->update(now_, {1.0, 1.0, 0.0}, T_map_odom_, localization,
                     std::make_shared<const common::OccupancyGrid>(flown_.snapshot()));
  }
  common::occupancy::Cell at(const Pose2& T_map_given, double x_m, double y_m) const {
    return overlay_->grid()->at(flown_.cellAt(T_map_given * (given_.T_given_grid * Eigen::Vector2d(x_m, y_m))));
  }

  /// In the wall at x = 5 m, from y = 1.5 m to 2.5 m; the given map's cells are those of the flight.
  void cutDoor() {
    auto walls = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(kCell_m));
    given_.grid->forEachCell([&](common::CellIndex cell, common::occupancy::Cell value) { walls->set(cell, value); });
    for (double y_m = 1.52; y_m < 2.5; y_m += kCell_m)
      for (double x_m = 4.8; x_m < 5.2; x_m += kCell_m) walls->set(walls->cellAt(x_m, y_m), -100);
    given_.grid = walls;
    given_.T_given_grid = {};
    overlay_.emplace(&given_, log_);
  }

  GivenMap given_;
  Pose2 T_map_odom_{0.1, 0.2, 0.05};
  common::OccupancyGrid flown_ = common::makeOccupancyGrid(kCell_m);
  common::EventLog log_;
  std::optional<GivenMapOverlay> overlay_;
  common::Time now_;
};

TEST_F(GivenMapOverlayStory, LiesInTheMapOnceThePlaceIsKnown) {
  const Pose2 T_map_given{2.0, -1.0, 0.7};
  step(std::nullopt);
  EXPECT_FALSE(overlay_->T_map_given());
  EXPECT_TRUE(isUnknown(at(T_map_given, 2.0, 2.0)));
  step(T_map_given);
  EXPECT_TRUE(isFree(at(T_map_given, 2.0, 2.0)));
  EXPECT_TRUE(isOccupied(at(T_map_given, 5.0, 2.0)));
  EXPECT_TRUE(isUnknown(at(T_map_given, 6.5, 2.0)));
  step(std::nullopt);
  EXPECT_FALSE(overlay_->T_map_given());
  EXPECT_TRUE(isUnknown(at(T_map_given, 2.0, 2.0))) << "a place that is lost explains nothing";
}

TEST_F(GivenMapOverlayStory, WhatTheFlightHasSeenCounts) {
  const Pose2 T_map_given{0.0, 0.0, 0.0};
  const auto place = [&](double x_m, double y_m) {
    return flown_.cellAt(T_map_given * (given_.T_given_grid * Eigen::Vector2d(x_m, y_m)));
  };
  flown_.set(place(2.0, 2.0), 100);   // A new piece of furniture.
  flown_.set(place(5.0, 3.0), -100);  // A wall that is gone.
  flown_.set(place(4.85, 1.0), 100);  // The same wall, seen 15 cm off.
  step(T_map_given);
  EXPECT_TRUE(isOccupied(at(T_map_given, 2.0, 2.0)));
  EXPECT_TRUE(isFree(at(T_map_given, 5.0, 3.0)));
  EXPECT_TRUE(isOccupied(at(T_map_given, 4.85, 1.0)));
  EXPECT_FALSE(isOccupied(at(T_map_given, 5.0, 1.0))) << "not a wall behind the wall";
  EXPECT_TRUE(isOccupied(at(T_map_given, 5.0, 2.0))) << "where nothing was seen";
}

/// The rule of the flight's map holds over the given one: for a door that was shut when that was made, and for somebody
/// who stands behind it for a while.
TEST_F(GivenMapOverlayStory, WhatBeamsHavePassedForTwoSecondsIsGone) {
  given_.T_given_grid = {};
  overlay_.emplace(&given_, log_);
  perception::SlicedMap map{perception::GridDrawingConfig{}};
  double now_s = 0.0;
  const auto look = [&](float range_m, double duration_s, float tilt_m = 0.0F) {
    for (double at_s = 0.0; at_s < duration_s; at_s += 0.25) {
      perception::DrawnScan scan;
      scan.stamp = common::Time::fromSeconds(now_s += 0.25);
      scan.body_height_m = 1.0;
      for (float angle = -0.1F; angle < 0.1F; angle += 0.005F)
        scan.hits_level_m.emplace_back(range_m * std::cos(angle), range_m * std::sin(angle), tilt_m);
      map.draw(scan, {3.0, 2.0, 0.0});
    }
    flown_ = map.atFlightHeight();
    step(Pose2{});
  };
  step(Pose2{});
  EXPECT_TRUE(isOccupied(at(Pose2{}, 5.0, 2.0)));
  for (const float tilt_m : {0.0F, 0.2F, -0.2F, 0.1F, -0.1F, 0.0F}) look(2.5F, 2.0, tilt_m);
  EXPECT_TRUE(isFree(at(Pose2{}, 5.0, 2.0)));
  EXPECT_TRUE(isOccupied(at(Pose2{}, 5.49, 2.02)));
  look(3.4F, 1.5);
  EXPECT_TRUE(isOccupied(at(Pose2{}, 5.49, 2.02)));
  look(3.4F, 1.0);
  EXPECT_TRUE(isFree(at(Pose2{}, 5.49, 2.02)));
  EXPECT_TRUE(isOccupied(at(Pose2{}, 5.0, 3.0))) << "where nothing passed";
}

TEST_F(GivenMapOverlayStory, NoiseOfTheLocalizationDoesNotMoveIt) {
  step(Pose2{2.0, -1.0, 0.7});
  const Pose2 before = *overlay_->T_map_given();
  const auto grid = overlay_->grid();
  for (int i = 0; i < 100; ++i) step(Pose2{2.0 + (i % 2 == 0 ? 0.03 : -0.03), -1.0, 0.7});
  EXPECT_EQ(overlay_->T_map_given()->x_m, before.x_m);
  for (int i = 0; i < 100; ++i) step(Pose2{2.1, -1.0, 0.7});
  EXPECT_NEAR(overlay_->T_map_given()->x_m, 2.1, 0.02);
  step(Pose2{4.0, -1.0, 0.7});
  EXPECT_NEAR(overlay_->T_map_given()->x_m, 4.0, 1e-6) << "found elsewhere: at once";
}

TEST_F(GivenMapOverlayStory, AnotherMapTakesItsPlace) {
  const Pose2 T_map_given{2.0, -1.0, 0.7};
  step(T_map_given);
  GivenMap other = given_;
  auto empty = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(kCell_m));
  empty->set({0, 0}, 100);
  other.grid = empty;
  overlay_->load(other);
  EXPECT_FALSE(overlay_->T_map_given());
  EXPECT_TRUE(isUnknown(at(T_map_given, 2.0, 2.0))) << "nothing is known of the place in it";
  step(T_map_given);
  EXPECT_TRUE(isUnknown(at(T_map_given, 2.0, 2.0)));
  EXPECT_TRUE(isOccupied(at(T_map_given, 0.02, 0.02)));
}

TEST_F(GivenMapOverlayStory, ADoorThatOnlyTheGivenMapHasIsNotNarrowedByRounding) {
  cutDoor();
  step(Pose2{});
  const auto forPaths = [&](double x_m, double y_m) {
    return overlay_->gridForPaths()->at(flown_.cellAt(Eigen::Vector2d(x_m, y_m)));
  };
  const auto column = [&](double x_m) {
    int occupied = 0;
    for (double y_m = 0.02; y_m < 4.0; y_m += kCell_m) occupied += isOccupied(forPaths(x_m, y_m)) ? 1 : 0;
    return occupied;
  };
  EXPECT_TRUE(isFree(forPaths(5.02, 1.48))) << "the end of the wall at the door";
  EXPECT_TRUE(isFree(forPaths(5.02, 2.52)));
  EXPECT_EQ(column(4.97), 58);
  EXPECT_EQ(column(5.02), 58) << "the wall of two cells stands, but for its ends";
  // Seen, the same end counts.
  flown_.set(flown_.cellAt(5.02, 1.48), 100);
  step(Pose2{});
  EXPECT_TRUE(isOccupied(forPaths(5.02, 1.48)));
}

/// A flight's map may be given to the next one, which may not see every wall again.
TEST_F(GivenMapOverlayStory, AMapIsNotWornByFlightsThatDoNotSeeItsWalls) {
  cutDoor();
  const auto walls = [](const common::OccupancyGrid& grid) {
    int cells = 0;
    grid.forEachCell([&](common::CellIndex, common::occupancy::Cell value) { cells += isOccupied(value) ? 1 : 0; });
    return cells;
  };
  const int before = walls(*given_.grid);
  for (int flight = 0; flight < 5; ++flight) {
    overlay_.emplace(&given_, log_);
    step(Pose2{});
    given_.grid = overlay_->grid();
  }
  EXPECT_EQ(walls(*given_.grid), before);
}

/// Whether a chain of free cells that cuts no corner leads from one cell to the other.
bool connected(const common::OccupancyGrid& grid, common::CellIndex from, common::CellIndex to) {
  const common::CellRect within = common::knownExtent(grid);
  std::vector<common::CellIndex> open{from};
  std::set<common::CellIndex> reached{from};
  while (!open.empty()) {
    const common::CellIndex cell = open.back();
    open.pop_back();
    if (cell == to) return true;
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const common::CellIndex next{cell.x + dx, cell.y + dy};
      if (within.contains(next) && isFree(grid.at(next)) && reached.insert(next).second) open.push_back(next);
    }
  }
  return false;
}

/// A room of 3 m by 2 m in two halves by a wall, one cell thick, that is slanted in the given map's cells, which are
/// turned against the flight's; in cells of 2, 5 and 10 cm.
TEST_F(GivenMapOverlayStory, AThinSlantedWallHasNoHoles) {
  for (const double wall_deg : {0.0, 10.0, 30.0, 45.0})
    for (const double turned_deg : {0.0, 10.0, 45.0, -20.0})
      for (const double cell_m : {0.02, 0.05, 0.10}) {
        auto room = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(cell_m));
        for (double y_m = -1.0; y_m < 1.0; y_m += 0.5 * cell_m)
          for (double x_m = -1.5; x_m < 1.5; x_m += 0.5 * cell_m) room->set(room->cellAt(x_m, y_m), -100);
        const Eigen::Rotation2Dd turn(common::kRadPerDeg * wall_deg);
        for (double t_m = -2.0; t_m < 2.0; t_m += 0.1 * cell_m) {
          const auto cell = room->cellAt(turn * Eigen::Vector2d(t_m, 0.0));
          if (isFree(room->at(cell))) room->set(cell, 100);
        }
        given_.grid = room;
        overlay_.emplace(&given_, log_);
        const Pose2 T_map_given{0.013, 0.027, common::kRadPerDeg * turned_deg};
        step(T_map_given);
        const Eigen::Vector2d side_m = turn * Eigen::Vector2d(0.0, 0.5);
        const auto place = [&](const Eigen::Vector2d& at_m) {
          return flown_.cellAt(T_map_given * (given_.T_given_grid * at_m));
        };
        EXPECT_TRUE(isFree(overlay_->grid()->at(place(side_m))));
        EXPECT_TRUE(isFree(overlay_->grid()->at(place(-side_m))));
        EXPECT_FALSE(connected(*overlay_->gridForPaths(), place(side_m), place(-side_m)))
            << wall_deg << " deg, turned by " << turned_deg << " deg, cells of " << cell_m << " m";
      }
}

/// A plan from a scan or a drawing may have millimetres for cells. The vehicle is in the air meanwhile.
TEST_F(GivenMapOverlayStory, AFineMapIsLaidQuickly) {
  constexpr double kFine_m = 0.005;
  auto room = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(kFine_m));
  for (double y_m = 0.5 * kFine_m; y_m < 8.0; y_m += kFine_m)
    for (double x_m = 0.5 * kFine_m; x_m < 8.0; x_m += kFine_m)
      room->set(room->cellAt(x_m, y_m), std::min({x_m, y_m, 8.0 - x_m, 8.0 - y_m}) < 0.05 ? 100 : -100);
  given_.grid = room;
  given_.T_given_grid = {};
  overlay_.emplace(&given_, log_);
  const auto begin = std::chrono::steady_clock::now();
  step(Pose2{0.013, 0.027, 0.3});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  for (double t_m = 0.01; t_m < 8.0; t_m += 0.02) EXPECT_TRUE(isOccupied(at(Pose2{0.013, 0.027, 0.3}, t_m, 0.025)));
}

TEST_F(GivenMapOverlayStory, SaysWhatHasChanged) {
  const Pose2 T_map_given{0.0, 0.0, 0.0};
  for (double x_m = 2.0; x_m < 2.5; x_m += 0.5 * kCell_m)
    flown_.set(flown_.cellAt(given_.T_given_grid * Eigen::Vector2d(x_m, 2.0)), 100);
  for (int i = 0; i < 4; ++i) step(T_map_given, 2.1);
  const auto events = log_.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "obstacle that is not in the given map");
}

TEST(GivenMapOverlay, WithoutAMapTheGridStaysTheSame) {
  common::EventLog log;
  GivenMapOverlay overlay(nullptr, log);
  const auto flown = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(kCell_m));
  overlay.update({}, {}, {}, std::nullopt, flown);
  EXPECT_EQ(overlay.grid(), flown);
  EXPECT_EQ(overlay.gridForPaths(), flown);
}

}  // namespace
}  // namespace swiftlet::autonomy
