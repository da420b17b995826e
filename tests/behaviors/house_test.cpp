// FindHouse and PlaceAtObject, tick by tick; the test plays the autonomy and what it recognizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/behaviors/objects_flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

common::RecognizedObject houseAt(int id, double x_m, double y_m, double ridge_deg, bool confirmed) {
  common::RecognizedObject house;
  house.id = id;
  house.what = "house";
  house.T_map_object = {common::quaternionFrom({0.0, 0.0, ridge_deg * common::kRadPerDeg}), {x_m, y_m, 0.0}};
  house.covariance_m2 = 1e-4 * Eigen::Matrix3d::Identity();
  house.size_m = {4.4, 3.6};
  house.looks = confirmed ? 2 : 1;
  house.confirmed = confirmed;
  return house;
}

/// A search, in a world of which nothing but houses is known.
class Search : public ObjectsFlight {
 public:
  explicit Search(const std::string& inside) : ObjectsFlight(inside) { flight.at(0.0, 0.0); }
  std::vector<common::GoToIntent> flyViews() { return ObjectsFlight::flyViews(1200); }
};

TEST(FindHouse, NeedsARecognizer) {
  Flight flight(R"(<FindHouse expected="6;0"/>)");
  EXPECT_EQ(flight.tick(), "FAILED");
  EXPECT_THAT(flight.cause(), HasSubstr("the profile recognizes nothing"));
}

TEST(FindHouse, ClimbsLooksAtTheExpectedPlaceAndThenFromAllSidesOfIt) {
  Search search(R"(<FindHouse expected="1;0" height_m="1.5" distance_m="2"/>)");
  const auto views = search.flyViews();
  ASSERT_GE(views.size(), 8U);
  EXPECT_EQ(views[0].goal_map_m, Eigen::Vector2d(0.0, 0.0)) << "from where it is";
  for (const common::GoToIntent& view : views) {
    EXPECT_EQ(view.height_m, 1.5);
    const Eigen::Vector2d to = Eigen::Vector2d(1.0, 0.0) - view.goal_map_m;
    EXPECT_NEAR(common::wrapAngle(*view.yaw_map_rad - std::atan2(to.y(), to.x())), 0.0, 1e-9) << "it faces the house";
  }
  for (std::size_t i = 1; i < views.size(); ++i)
    EXPECT_GT((views[i].goal_map_m - Eigen::Vector2d(1.0, 0.0)).norm(), 1.5) << "not over the house";
  // At last it explores, and then nothing is left to look at.
  EXPECT_TRUE(std::holds_alternative<common::ExploreIntent>(search.flight.context.intent->kind));
  search.flight.succeeds();
  search.tick();
  EXPECT_EQ(search.tick(), "FAILED");
  EXPECT_EQ(search.flight.cause(), "FindHouse: no `house` was recognized");
}

TEST(FindHouse, WithoutAPlaceItLooksAllAround) {
  Search search("<FindHouse/>");
  const auto views = search.flyViews();
  ASSERT_EQ(views.size(), 8U);
  double turned_rad = 0.0;
  for (std::size_t i = 1; i < views.size(); ++i) {
    EXPECT_EQ(views[i].goal_map_m, views[0].goal_map_m);
    turned_rad += common::wrapAngle(*views[i].yaw_map_rad - *views[i - 1].yaw_map_rad);
  }
  EXPECT_NEAR(turned_rad, 7.0 / 4.0 * std::numbers::pi, 1e-9);
}

TEST(FindHouse, LooksAtACandidateFromBesideAndStopsWhenItIsConfirmed) {
  Search search(R"(<FindHouse expected="6;0" house="{h}" place="{p}"/>)");
  search.tick();
  search.flight.succeeds();
  search.sees({houseAt(3, 6.4, 0.5, 90.0, false)});
  for (int i = 0; i < 40 && (search.goTo() == nullptr || search.goTo()->goal_map_m.norm() < 0.1); ++i) {
    search.tick();
    search.goTo() != nullptr ? search.flight.succeeds() : search.flight.stops();
  }
  ASSERT_NE(search.goTo(), nullptr);
  const Eigen::Vector2d to = Eigen::Vector2d(6.4, 0.5) - search.goTo()->goal_map_m;
  EXPECT_NEAR(common::wrapAngle(*search.goTo()->yaw_map_rad - std::atan2(to.y(), to.x())), 0.0, 1e-9)
      << "where it was seen, not where it was expected";
  search.sees({houseAt(3, 6.4, 0.5, 90.0, true)});
  EXPECT_THAT(search.tick(), HasSubstr("hold"));
  search.flight.stops();
  EXPECT_EQ(search.tick(), "DONE");
  EXPECT_THAT(search.flight.events(),
              Contains(StartsWith("house 3 found (at (6.40, 0.50) +- 0.02 m, its ridge at 90")));
}

TEST(PlaceAtObject, IsInTheAxesOfTheObject) {
  Search search(R"(<Sequence><PlaceAtObject object="3" at="-2;0.5;1.1" place="{door}"/>
                   <MoveToGoal goal="{door}"/></Sequence>)");
  search.sees({houseAt(3, 6.0, 1.0, 90.0, true)});
  search.tick();
  ASSERT_NE(search.goTo(), nullptr);
  EXPECT_NEAR(search.goTo()->goal_map_m.x(), 5.5, 1e-9);
  EXPECT_NEAR(search.goTo()->goal_map_m.y(), -1.0, 1e-9);
  EXPECT_NEAR(search.goTo()->height_m.value_or(0.0), 1.1, 1e-9);
}

TEST(PlaceAtObject, FailsWithoutTheObject) {
  Search search(R"(<PlaceAtObject object="7" at="1;0" place="{p}"/>)");
  search.sees({houseAt(3, 6.0, 1.0, 90.0, true)});
  EXPECT_EQ(search.tick(), "FAILED");
  EXPECT_EQ(search.flight.cause(), "PlaceAtObject: no object 7 is known");
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
