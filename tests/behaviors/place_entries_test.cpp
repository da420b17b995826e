// Missions that name the places of a topological map.
#include "behaviors/place_entries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/topological_map.hpp"
#include "tests/behaviors/check_text.hpp"
#include "tests/behaviors/flight.hpp"

namespace swiftlet::behaviors::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

MissionLimits withPlaces() {
  common::TopologicalMap map;
  map.places.push_back({.name = "kitchen", .x_m = 3.0, .y_m = -1.5, .z_m = 0.4});
  map.passages.push_back({.name = "window_2", .what = "window", .x_m = 2.0, .y_m = 0.5, .z_m = 1.2});
  map.danger_zones.push_back({"stairs", {5.0, 5.0, 6.0, 5.0, 6.0, 6.0}});
  MissionLimits limits;
  limits.places = std::make_shared<const common::TopologicalMap>(map);
  return limits;
}

const std::string kOpen = "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\">";
const std::string kClose = "</BehaviorTree></root>";

Mission missionOf(const std::string& inside) {
  return Mission::fromText(kOpen + "<Sequence><TakeOff/>" + inside + "<Land/></Sequence>" + kClose, "m.xml",
                           withPlaces());
}

TEST(PlaceEntries, AMissionFliesToAPlaceByItsName) {
  Flight flight(missionOf(R"(<MoveToGoal goal="{kitchen}"/><MoveToGoal goal="{window_2}"/>)"));
  flight.tick();
  flight.succeeds();
  EXPECT_THAT(flight.tick(), HasSubstr("go to (3.00, -1.50)"));
  flight.succeeds();
  EXPECT_THAT(flight.tick(), HasSubstr("go to (2.00, 0.50"));
  EXPECT_EQ(std::get<common::GoToIntent>(flight.context.intent->kind).height_m, 1.2) << "of the window's middle";
}

TEST(PlaceEntries, AMissionKeepsOutOfADangerZoneByItsName) {
  Flight flight(missionOf(R"(<KeepOut polygon="{stairs}"/><GoHome/>)"));
  flight.tick();
  flight.succeeds();
  flight.tick();
  ASSERT_EQ(flight.context.requests.size(), 1U);
  const auto& area = std::get<common::KeepOutRequest>(flight.context.requests[0].kind).area;
  EXPECT_EQ(area.corners_map_m[2], Eigen::Vector2d(6.0, 6.0));
}

TEST(PlaceEntries, APlaceThatDoesNotExistIsRefusedWithTheOneThatIsMeant) {
  const auto problems = problemsInside(R"(<TakeOff/><MoveToGoal goal="{kitchn}"/><Land/>)", withPlaces());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].message.name(), "tree.entry-unset");
  EXPECT_THAT(problems[0].hint, HasSubstr("kitchen"));
  EXPECT_THAT(problemsInside(R"(<TakeOff/><MoveToGoal goal="{kitchen}"/><Land/>)", withPlaces()), IsEmpty());
  EXPECT_EQ(problemsInside(R"(<TakeOff/><MoveToGoal goal="{kitchen}"/><Land/>)").size(), 1U) << "without places";
}

}  // namespace
}  // namespace swiftlet::behaviors::testing
