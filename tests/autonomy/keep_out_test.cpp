// Keep-out zones in flight: who may make and take back which, and what maneuvers do about them.
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/requests/flight_requests.hpp"
#include "tests/autonomy/autonomy_story.hpp"
#include "tests/autonomy/maneuver_story.hpp"
#include "tests/support/layers.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

common::Polygon square(double x_m, double y_m, double side_m) {
  return {{{x_m, y_m}, {x_m + side_m, y_m}, {x_m + side_m, y_m + side_m}, {x_m, y_m + side_m}}};
}

TEST(KeepOutZones, TheOperatorTakesBackHisOwnOnly) {
  common::EventLog log;
  FlightRequests requests(0.275, nullptr, log);
  const common::World world = test::Layers().world();
  requests.take({7, common::KeepOutRequest{square(2, 2, 1)}}, world);
  const auto answers = requests.takeAnswers({});
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].id, 7u);
  EXPECT_TRUE(answers[0].done);
  EXPECT_TRUE(requests.take({1, common::KeepOutCommand{square(-3, 2, 1)}}, world)->accepted);
  EXPECT_EQ(requests.keepOut().zones()->size(), 2u);
  const auto cleared = requests.take({2, common::ClearKeepOutCommand{}}, world);
  EXPECT_TRUE(cleared->accepted);
  EXPECT_EQ(cleared->reason, "1 of the mission stay");
  ASSERT_EQ(requests.keepOut().zones()->size(), 1u);
  EXPECT_EQ(requests.keepOut().zones()->front(), square(2, 2, 1));
  EXPECT_FALSE(requests.take({3, common::HoldCommand{}}, world)) << "for somebody else";
}

TEST(KeepOutZones, TheTakeOffPlaceStaysFree) {
  common::EventLog log;
  FlightRequests requests(0.275, nullptr, log);
  const common::World world = test::Layers().world();
  for (const auto& zone : {square(-0.5, -0.5, 1), square(0.2, -0.5, 1)}) {
    const auto refused = requests.take({1, common::KeepOutCommand{zone}}, world);
    EXPECT_FALSE(refused->accepted);
    EXPECT_THAT(refused->reason, StartsWith("the take-off place (0.00, 0.00) would be in it"));
  }
  EXPECT_TRUE(requests.take({1, common::KeepOutCommand{square(0.3, -0.5, 1)}}, world)->accepted);
}

TEST(KeepOutZones, AZoneThatIsSaidAgainIsOne) {
  KeepOutZones zones(0.275);
  for (int i = 0; i < 100; ++i)  // The given map is found a little to the side each time.
    ASSERT_EQ(zones.add(square(2.0 + 0.001 * i, 2, 1), KeepOutZones::Owner::kMission, {0, 0}), "");
  ASSERT_EQ(zones.zones()->size(), 1u);
  EXPECT_EQ(zones.zones()->front(), square(2.0 + 0.001 * 99, 2, 1)) << "the last one counts";
  ASSERT_EQ(zones.add(square(2.3, 2, 1), KeepOutZones::Owner::kMission, {0, 0}), "");
  EXPECT_EQ(zones.zones()->size(), 2u);
}

TEST(KeepOutZones, TheirEdgesNearAreThoseOfZonesThatTheVehicleIsOutside) {
  KeepOutZones zones(0.275);
  ASSERT_EQ(zones.add(square(1, -50, 100), KeepOutZones::Owner::kMission, {0, 0}), "");
  const auto near = zones.edgesNear_level_m({0.0, 0.0, 0.5 * std::numbers::pi}, 2.0);
  ASSERT_GT(near.size(), 60u) << "the long edge, within 2 m";
  for (const auto& point : near) {
    EXPECT_NEAR(point.y(), -1.0, 1e-9) << "the zone lies to the right of a vehicle that looks along y";
    EXPECT_LE(point.norm(), 2.0);
  }
  EXPECT_TRUE(zones.edgesNear_level_m({1.2, 0.0, 0.0}, 2.0).empty()) << "inside: it may leave";
}

TEST_F(ManeuverInFlight, AGoalInAZoneFailsSoonWithThatReason) {
  keep_out_ = std::make_shared<const std::vector<common::Polygon>>(1, square(5, 1.5, 1));
  want(to(5.5, 2.0));
  EXPECT_EQ(runToTheEnd(4.0), IntentState::kFailed) << "no detour shows more";
  EXPECT_THAT(executor_.status().reason, StartsWith("goal (5.50, 2.00) is in a keep-out zone"));
  EXPECT_EQ(timesSaid("goes nearer"), 0);
}

TEST_F(ManeuverInFlight, AFlightBackStopsBeforeAZoneThatIsNewerThanTheTrail) {
  std::vector<Eigen::Vector2d> trail;
  for (double x_m = 1.5; x_m <= 6.0; x_m += 0.1) trail.emplace_back(x_m, 2.0);
  want(common::RetraceIntent{trail, {}});
  run(0.5);
  keep_out_ = std::make_shared<const std::vector<common::Polygon>>(1, square(4, 1.5, 1));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kFailed) << "it is not back";
  EXPECT_EQ(executor_.status().reason, "stopped before a keep-out zone");
  EXPECT_LT(position_m().x(), 4.0 - 0.27);
  EXPECT_GT(position_m().x(), 3.3);
}

TEST(KeepOutFlight, AZoneOfTheOperatorTurnsTheVehicleAside) {
  AutonomyStory story(R"(<TakeOff height_m="1.0"/><MoveToGoal goal="2.5;-2.0"/><Land/>)");
  ASSERT_TRUE(story.isFlying());
  const common::Polygon zone = square(0.9, -1.6, 0.9);  // Across the straight line.
  EXPECT_TRUE(story.order(common::KeepOutCommand{zone}).accepted);
  double nearest_m = 1e9;
  ASSERT_TRUE(story.until(
      [&] {
        const auto here = story.world().vehicle->state.T_map_body_planar().position_m();
        nearest_m = std::min(nearest_m, zone.signedDistance_m(here));
        return story.autonomy().finished();
      },
      60.0));
  EXPECT_EQ(story.autonomy().missionStatus().state, MissionState::kDone);
  EXPECT_GT(nearest_m, 0.275);
  EXPECT_LT(nearest_m, 0.9) << "it passed it";
}

}  // namespace
}  // namespace swiftlet::autonomy
