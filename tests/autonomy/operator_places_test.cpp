// The operator's goals and zones in the given map, and missions that bring the map which they load.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/world/map_layer.hpp"
#include "tests/autonomy/autonomy_story.hpp"

namespace swiftlet::autonomy {
namespace {

using ::testing::HasSubstr;

/// A place of the map that the room was mapped in, in the frame of the file: turned and shifted against it.
const common::Pose2 kGiven{4.0, -3.0, 0.8};

GivenMap roomMap() {
  AutonomyStory before(R"(<TakeOff height_m="1.0"/><MoveToGoal goal="1.5;-1.5"/><Land/>)");
  EXPECT_TRUE(before.until([&] { return before.autonomy().finished(); }, 60.0));
  return {before.world().map->grid, kGiven, 3};
}

bool localized(const AutonomyStory& story) { return story.world().map->T_map_given.has_value(); }

TEST(OperatorPlaces, GoalsAndZonesLieInTheGivenMap) {
  const GivenMap given = roomMap();
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><Localize/><OperatorCommand/>)", &given);
  ASSERT_TRUE(story.isFlying());
  const Eigen::Vector2d place_m(1.0, -2.0);  // In the frame in which the room was mapped, which is also this flight's.
  const Eigen::Vector2d place_given_m = kGiven * place_m;
  ASSERT_FALSE(localized(story));
  const common::CommandResult early = story.order(common::GoalCommand{{}, place_given_m});
  EXPECT_FALSE(early.accepted);
  EXPECT_EQ(early.reason, "its place in the given map is not known");
  ASSERT_TRUE(story.until([&] { return localized(story); }, 60.0));
  ASSERT_TRUE(story.until(
      [&] {
        return story.event("mission", "Localize") != story.events.end() ||
               story.world().mission->status.phase == "hold";
      },
      20.0));

  const std::vector<Eigen::Vector2d> zone_given_m{
      kGiven * Eigen::Vector2d(-2.0, 1.0), kGiven * Eigen::Vector2d(-1.0, 1.0), kGiven * Eigen::Vector2d(-1.0, 2.0)};
  ASSERT_TRUE(story.order(common::KeepOutCommand{{}, zone_given_m}).accepted);
  ASSERT_TRUE(story.until([&] { return !story.world().map->keep_out->empty(); }, 1.0));
  EXPECT_LT((story.world().map->keep_out->front().corners_map_m[2] - Eigen::Vector2d(-1.0, 2.0)).norm(), 0.15);

  ASSERT_TRUE(story.order(common::GoalCommand{{}, place_given_m}).accepted);
  EXPECT_NE(story.event("operator", "goal (6.13, -3.68) in the given map accepted"), story.events.end());
  const auto error_m = [&] { return (story.world().vehicle->state.T_map_body_planar().position_m() - place_m).norm(); };
  ASSERT_TRUE(story.until([&] { return error_m() < 0.15; }, 40.0)) << error_m();
}

TEST(OperatorPlaces, WithoutAGivenMapThereIsNoPlaceInIt) {
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><OperatorCommand/>)");
  ASSERT_TRUE(story.isFlying());
  EXPECT_EQ(story.order(common::GoalCommand{{}, Eigen::Vector2d(1.0, 0.0)}).reason, "the flight was given no map");
}

std::string missionThatLoads(const std::string& file) {
  return R"(<root BTCPP_format="4" main_tree_to_execute="Loads"><BehaviorTree ID="Loads"><Sequence><LoadMap file=")" +
         file + R"("/><TakeOff/><Localize/><OperatorCommand/></Sequence></BehaviorTree></root>)";
}

TEST(OperatorPlaces, AMissionBringsTheMapThatItLoads) {
  const GivenMap given = roomMap();
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><OperatorCommand/>)");
  ASSERT_TRUE(story.isFlying());
  const common::CommandResult without =
      story.order(common::StartMissionCommand{"m.xml", missionThatLoads("room.yaml")});
  EXPECT_FALSE(without.accepted);
  EXPECT_THAT(without.reason, HasSubstr("the map `room.yaml` was not read before the mission"));
  const std::string wrong = missionThatLoads("room.yaml") + "<";
  EXPECT_FALSE(story.order(common::StartMissionCommand{"m.xml", wrong, {{"room.yaml", given}}}).accepted);
  EXPECT_FALSE(story.order(common::StartMissionCommand{"m.xml", missionThatLoads("room.yaml")}).accepted)
      << "a mission that is refused leaves no map behind";

  ASSERT_TRUE(story.order(common::StartMissionCommand{"m.xml", missionThatLoads("room.yaml"), {{"room.yaml", given}}})
                  .accepted);
  ASSERT_TRUE(story.until([&] { return localized(story); }, 60.0));
  EXPECT_NEAR(story.world().map->T_map_given->inverse().x_m, kGiven.x_m, 0.15);
  EXPECT_EQ(story.world().map->given->grid, given.grid);
}

}  // namespace
}  // namespace swiftlet::autonomy
