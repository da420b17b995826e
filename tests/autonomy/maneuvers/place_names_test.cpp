// What maneuvers and the planner say of places while the vehicle is localized in a given map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/requests/keep_out_zones.hpp"
#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kFreeCell;
using planning::test::kWallCell;
using testing::HasSubstr;

/// `map` lies in the given map, moved by 100 m.
class PlacesInTheGivenMap : public ManeuverInFlight {
 protected:
  PlacesInTheGivenMap() { names_.T_given_map = common::Pose2{100.0, 0.0, 0.0}; }
};

TEST_F(PlacesInTheGivenMap, OfAGoalThatIsReached) {
  want(to(3.0, 2.0));
  run(0.5);
  EXPECT_EQ(executor_.status().reason, "flying to (103.00, 2.00) in the given map");
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  EXPECT_EQ(executor_.status().reason, "reached (103.00, 2.00) in the given map");
  EXPECT_EQ(timesSaid("go to (103.00, 2.00) in the given map: done"), 1);
}

TEST_F(PlacesInTheGivenMap, OfAGoalToWhichThereIsNoPath) {
  fill(grid_, {{80, 0}, {84, 80}}, kWallCell);
  want(to(6.0, 2.0));
  ASSERT_EQ(runToTheEnd(60.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "goal (106.00, 2.00) in the given map is unreachable at clearance 0.10 m");
}

TEST_F(PlacesInTheGivenMap, OfAGoalThatIsNotFree) {
  fill(grid_, {{110, 30}, {130, 50}}, kWallCell);
  want(to(6.0, 2.0));
  run(1.0);
  EXPECT_THAT(executor_.status().reason,
              HasSubstr("goal (106.00, 2.00) in the given map is in an obstacle at clearance 0.10 m, the nearest free "
                        "place is (106."));
}

TEST_F(PlacesInTheGivenMap, OfABlockage) {
  want(to(6.0, 2.0));
  runUntil([this] { return position_m().x() > 2.0; }, 10.0);
  fill(grid_, {{80, 0}, {84, 80}}, kWallCell);
  runUntil([this] { return timesSaid("plan discarded") > 0; }, 5.0);
  EXPECT_EQ(reasonOf("plan discarded"), "blocked before (106.00, 2.00) in the given map") << "the end of the leg";
}

TEST_F(PlacesInTheGivenMap, OfViewpointsAndFrontiers) {
  fill(grid_, {{20, 80}, {44, 81}}, kFreeCell);  // An opening of 1.2 m, with nothing known behind it.
  fill(grid_, {{60, 80}, {63, 81}}, kFreeCell);  // A crack.
  want(common::ExploreIntent{});
  runUntil([this] { return executor_.status().reason.find("next viewpoint") != std::string::npos; }, 10.0);
  EXPECT_THAT(executor_.status().reason, HasSubstr("next viewpoint (10"));
  EXPECT_THAT(executor_.status().reason, HasSubstr(" in the given map for "));
  runToTheEnd(120.0);
  EXPECT_THAT(events_, testing::Contains(testing::Field(&common::Event::text,
                                                        testing::MatchesRegex("frontier of .* m at \\(10.*\\) in the "
                                                                              "given map left: .*"))));
}

TEST_F(PlacesInTheGivenMap, OfALanding) {
  want(to(2.05, 2.0));
  ASSERT_EQ(runToTheEnd(10.0), IntentState::kSucceeded);
  auto levels = std::make_shared<common::LevelMap>();
  levels->levels = {{0, 0.0, 1e-4, {}}, {1, 0.2, 1e-4, {}}};
  for (int x = 2; x < 26; ++x)
    for (int y = 18; y < 22; ++y) levels->levels[x < 20 ? 0 : 1].cells.push_back({x, y});
  surfaces_ = levels;
  want(common::LandIntent{});
  runUntil([this] { return timesSaid("landing at") > 0; }, 10.0);
  EXPECT_THAT(events_.back().text, testing::MatchesRegex("landing at \\(101\\..*\\) in the given map"));
}

TEST_F(PlacesInTheGivenMap, OfAZoneAroundTheTakeOffPlace) {
  KeepOutZones zones(0.275);
  EXPECT_THAT(zones.add({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}, KeepOutZones::Owner::kOperator, {0, 0}, names_),
              HasSubstr("the take-off place (100.00, 0.00) in the given map would be in it"));
}

}  // namespace
}  // namespace swiftlet::autonomy
