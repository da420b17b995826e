// Where the vehicle sets down, on surfaces that it saw only along its trail.
#include "planning/costs/landing_place.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "grid_builder.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

class LandingPlaceStory : public testing::Test {
 protected:
  /// A surface that was seen along a strip, from corner to corner.
  void see(double height_m, const Vector2d& from_m, const Vector2d& to_m) {
    common::Level level;
    level.id = static_cast<int>(levels_.levels.size());
    level.height_m = height_m;
    for (double y_m = from_m.y() + 0.05; y_m < to_m.y(); y_m += 0.1)
      for (double x_m = from_m.x() + 0.05; x_m < to_m.x(); x_m += 0.1)
        level.cells.push_back({static_cast<int>(std::floor(x_m / 0.1)), static_cast<int>(std::floor(y_m / 0.1))});
    std::sort(level.cells.begin(), level.cells.end());
    levels_.levels.push_back(level);
  }
  std::optional<Vector2d> from(double x_m, double y_m) {
    return landingPlace(test::mapOf(grid_), levels_, {x_m, y_m}, needs_);
  }

  common::OccupancyGrid grid_ = test::room(160, 80);  ///< 8 m by 4 m.
  common::LevelMap levels_;
  LandingNeeds needs_;
};

TEST_F(LandingPlaceStory, OnOneFloorTheVehicleLandsWhereItIs) {
  see(0.0, {1, 1.9}, {7, 2.1});
  const auto place = from(5.0, 2.0);
  ASSERT_TRUE(place);
  EXPECT_EQ(*place, Vector2d(5.0, 2.0));
}

TEST_F(LandingPlaceStory, TheEndOfTheTrailIsLeftForFloorThatWasSeenToBothSidesOfTheHull) {
  see(0.0, {1, 1.9}, {4, 2.1});
  const auto place = from(3.95, 2.0);
  ASSERT_TRUE(place);
  EXPECT_LT(place->x(), 4.0 - needs_.hull_radius_m) << "an edge may begin where nothing was seen";
  EXPECT_GT(place->x(), 3.4);
  needs_.reach_m = 0.05;
  EXPECT_EQ(*from(3.95, 2.0), Vector2d(3.95, 2.0)) << "better than none";
}

TEST_F(LandingPlaceStory, AtTheEndOfTheTrailTheVehicleLooksBeyondIt) {
  const auto look = [&](double x_m) { return placeToLookFrom(test::mapOf(grid_), levels_, {x_m, 2.0}, needs_); };
  see(0.0, {1, 1.9}, {4, 2.1});
  EXPECT_FALSE(look(2.5)) << "seen to both sides";
  ASSERT_TRUE(look(3.9));
  EXPECT_GT(look(3.9)->x(), 3.9 + needs_.aside_m());
  EXPECT_NEAR(look(3.9)->y(), 2.0, 0.1);
  test::fill(grid_, {{88, 30}, {90, 50}}, test::kWallCell);
  EXPECT_FALSE(look(3.9)) << "a wall is there";
  test::fill(grid_, {{88, 30}, {90, 44}}, test::kFreeCell);
  ASSERT_TRUE(look(3.9));
  EXPECT_LT(look(3.9)->y(), 1.9) << "past the wall";
  levels_.levels.clear();
  see(0.0, {1, 1.9}, {4, 2.1});
  see(0.3, {4, 1.9}, {4.2, 2.1});
  EXPECT_FALSE(look(3.9)) << "the edge is known";
}

TEST_F(LandingPlaceStory, AnEdgeIsLeftByTheHullAndItsMargin) {
  see(0.0, {1, 1.9}, {4, 2.1});
  see(0.3, {4, 1.9}, {4.5, 2.1});
  const auto place = from(4.0, 2.0);
  ASSERT_TRUE(place);
  EXPECT_LT(place->x(), 4.0 - needs_.asideAskew_m() + 0.01) << "the edge may run askew";
  EXPECT_GT(place->x(), 3.3) << "no farther than needed";
  needs_.reach_m = 0.45;
  ASSERT_TRUE(from(4.0, 2.0));
  EXPECT_LT(from(4.0, 2.0)->x(), 4.0 - needs_.aside_m() + 0.01) << "better than none";
}

TEST_F(LandingPlaceStory, ATableOfUnknownWidthIsNoPlaceButARaisedFloorIs) {
  see(0.0, {0.5, 1.9}, {2, 2.1});
  see(0.75, {2, 1.9}, {3.5, 2.1});
  EXPECT_LT(from(2.8, 2.0)->x(), 2.0) << "the floor is near";
  needs_.reach_m = 0.5;
  EXPECT_NEAR(from(2.8, 2.0)->x(), 2.8, 1e-9) << "the surface was seen across the hull";
  levels_.levels.clear();
  see(0.75, {2, 1.9}, {2.4, 2.1});
  EXPECT_FALSE(from(2.2, 2.0)) << "a surface smaller than the hull, as far as it was seen";
}

TEST_F(LandingPlaceStory, ThePathLeadsAroundWalls) {
  test::fill(grid_, {{80, 0}, {82, 80}}, test::kWallCell);
  see(0.0, {1, 1.9}, {3.9, 2.1});
  see(0.3, {4.4, 1.9}, {4.8, 2.1});
  EXPECT_FALSE(from(4.6, 2.0)) << "the floor is behind the wall";
  test::fill(grid_, {{80, 60}, {82, 80}}, test::kFreeCell);
  needs_.reach_m = 2.0;
  EXPECT_FALSE(from(4.6, 2.0)) << "the opening is too far";
  needs_.reach_m = 6.0;
  const auto place = from(4.6, 2.0);
  ASSERT_TRUE(place);
  EXPECT_LT(place->x(), 3.7);
}

TEST_F(LandingPlaceStory, WithoutSeenSurfacesThereIsNoPlace) {
  EXPECT_FALSE(from(4.0, 2.0));
  see(0.0, {1, 1.9}, {1.5, 2.1});
  EXPECT_FALSE(from(7.0, 2.0)) << "out of reach";
  EXPECT_FALSE(from(30.0, 2.0)) << "outside the map";
}

}  // namespace
}  // namespace swiftlet::planning
