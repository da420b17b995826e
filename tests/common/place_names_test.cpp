// How texts name places.
#include "common/place_names.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "common/command.hpp"
#include "common/goal.hpp"
#include "common/intent.hpp"

namespace swiftlet::common {
namespace {

/// The given map's origin lies at (10, 0) of `map`, its x axis along y.
const PlaceNames kGiven = PlaceNames::in(Pose2{10.0, 0.0, 0.5 * std::numbers::pi});

TEST(PlaceNames, AreThoseOfMapWithoutAGivenOne) {
  const PlaceNames names = PlaceNames::in(std::nullopt);
  EXPECT_EQ(names.of(Eigen::Vector2d(1.0, -2.0)), "(1.00, -2.00)");
  EXPECT_EQ(names.of(Eigen::Vector3d(1.0, -2.0, 0.5)), "(1.00, -2.00, 0.50)");
}

TEST(PlaceNames, AreConvertedAndSaySo) {
  EXPECT_EQ(kGiven.of(Eigen::Vector2d(9.0, 2.0)), "(2.00, 1.00) in the given map");
  EXPECT_EQ(kGiven.of(Eigen::Vector3d(9.0, 2.0, 0.5)), "(2.00, 1.00, 0.50) in the given map");
  EXPECT_EQ(kGiven.coordinatesOf({9.0, 2.0}), "(2.00, 1.00)");
  EXPECT_EQ(nameOfGivenPlace({9.0, 2.0}), "(9.00, 2.00) in the given map");
}

TEST(PlaceNames, OfIntents) {
  GoToIntent goal;
  goal.goal_map_m = {9.0, 2.0};
  EXPECT_EQ(toString(Intent{1, goal}, kGiven), "go to (2.00, 1.00) in the given map");
  EXPECT_EQ(toString(Intent{1, goal}), "go to (9.00, 2.00)");
  goal.goal_given_m = Eigen::Vector2d(2.01, 1.0);
  EXPECT_EQ(toString(Intent{1, goal}, kGiven), "go to (2.01, 1.00) in the given map") << "exactly as it was named";
  InspectIntent inspect;
  inspect.point_map_m = {9.0, 2.0};
  EXPECT_EQ(toString(Intent{1, inspect}, kGiven), "inspect (2.00, 1.00) in the given map");
  SurveyIntent survey;
  survey.area = {{{9.0, 2.0}, {9.0, 3.0}, {8.0, 3.0}, {8.0, 2.0}}};
  EXPECT_EQ(toString(Intent{1, survey}, kGiven), "survey an area with 4 corners about (2.50, 1.50) in the given map");
}

TEST(PlaceNames, OfCommands) {
  EXPECT_EQ(toString(OperatorCommand{1, GoalCommand{{9.0, 2.0}, std::nullopt}}, kGiven),
            "goal (2.00, 1.00) in the given map");
  EXPECT_EQ(toString(OperatorCommand{1, GoalCommand{{9.0, 2.0}, Eigen::Vector2d(2.01, 1.0)}}),
            "goal (2.01, 1.00) in the given map");
  const std::vector<Eigen::Vector2d> corners{{9.0, 2.0}, {9.0, 3.0}, {8.0, 3.0}, {8.0, 2.0}};
  EXPECT_EQ(toString(OperatorCommand{1, KeepOutCommand{{corners}, {}}}, kGiven),
            "keep-out zone with 4 corners about (2.50, 1.50) in the given map");
  EXPECT_EQ(toString(OperatorCommand{1, KeepOutCommand{{}, corners}}, kGiven),
            "keep-out zone with 4 corners about (8.50, 2.50) in the given map");
}

}  // namespace
}  // namespace swiftlet::common
