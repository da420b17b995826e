// PathFlight: a plan is requested, offered, kept, flown, lost and given up.
#include <gtest/gtest.h>

#include "tests/autonomy/maneuvers/workbench.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kWallCell;

class PathFlightTest : public ManeuverWorkbench {
 protected:
  PathFlight flight_{setup_, common::FlightMode::kAccurate};
};

TEST_F(PathFlightTest, RequestsCarryTheIdOfTheIntent) {
  answers_.clear();
  ASSERT_TRUE(flight_.mayAsk());
  flight_.ask(input(), GoalRequest{{6.0, 2.0}, 0.05});
  EXPECT_FALSE(flight_.mayAsk()) << "one question at a time";
  deliver();
  ASSERT_EQ(answers_.size(), 1U);
  EXPECT_EQ(answers_[0].intent_id, 7U);
  ASSERT_TRUE(answers_[0].path && *answers_[0].path);
  EXPECT_DOUBLE_EQ(desk_.costMap()->footprint().clearance_m, 0.10);
}

TEST_F(PathFlightTest, FliesAnOfferedPlanInItsModeAtTheFlightHeight) {
  memory_.cruise_height_m = 1.2;
  EXPECT_TRUE(flight_.keep(input())) << "without a plan one is wanted";
  flight_.offer(straight({1.5, 2.0}, {5.0, 2.0}), now_, state_);
  EXPECT_FALSE(flight_.keep(input()));
  EXPECT_NEAR(flight_.aim().velocity_map_m_s.x(), controller_.follower().speed_m_s(common::FlightMode::kAccurate),
              1e-9);
  runUntil([this] { return position_m().x() > 2.5; }, 20.0);
  EXPECT_NEAR(state_.velocity_odom_m_s.head<2>().norm(),
              controller_.follower().speed_m_s(common::FlightMode::kAccurate), 0.02);
  (void)flight_.keep(input());
  ASSERT_EQ(flight_.remaining_map_m().size(), 2U);
  EXPECT_NEAR(flight_.remaining_map_m().front().x(), position_m().x(), 0.01) << "from where the vehicle is";
  runUntil([this] { return controller_.follower().finished(); }, 30.0);
  EXPECT_NEAR(state_.T_odom_body.position_m.z(), 1.2, 0.02);
}

TEST_F(PathFlightTest, FliesTheYawThatIsPlannedAlongThePath) {
  const auto yaw_rad = [this] { return state_.T_map_body_planar().yaw_rad; };
  flight_.offer(straight({1.5, 2.0}, {1.4, 2.0}), now_, state_);
  runUntil([this] { return controller_.follower().finished(); }, 20.0);
  EXPECT_NEAR(yaw_rad(), 0.0, 0.02) << "0.1 m backwards";
  flight_.setGoalYaw(2.5);
  flight_.offer(straight({1.4, 2.0}, {1.4, 5.0}), now_, state_);
  runUntil([this] { return position_m().y() > 3.5; }, 20.0);
  EXPECT_NEAR(yaw_rad(), 1.57, 0.45) << "the nose leads";
  runUntil([this] { return controller_.follower().remaining_m() < 0.01; }, 20.0);
  EXPECT_NEAR(yaw_rad(), 2.5, 0.1) << "and is where the goal wants it";
}

TEST_F(PathFlightTest, SaysWhenACheaperPlanReplacesAValidOne) {
  flight_.offer(straight({1.5, 2.0}, {5.0, 2.0}), now_, state_);
  (void)memory_log_.take();
  planning::Path cheaper = straight({1.5, 2.0}, {5.0, 2.0});
  cheaper.cost_m *= 0.5;
  flight_.offer(cheaper, now_, state_);
  EXPECT_EQ(lastEvent().text, "plan replaced");
  flight_.offer(straight({1.5, 2.0}, {4.0, 2.0}), now_, state_);
  EXPECT_EQ(lastEvent().text, "nothing") << "another goal";
}

TEST_F(PathFlightTest, KeepsAPlanUnlessAnotherIsClearlyBetterOrItIsReleased) {
  planning::Path path = straight({1.5, 2.0}, {5.0, 2.0});
  flight_.offer(path, now_, state_);
  const planning::Path* kept = flight_.plan();
  ASSERT_TRUE(kept);
  path.points_map_m.insert(path.points_map_m.begin() + 1, {3.0, 2.1});
  flight_.offer(path, now_, state_);
  EXPECT_EQ(flight_.plan()->points_map_m.size(), 2U) << "as good";
  flight_.release();
  EXPECT_TRUE(controller_.follower().followsPath()) << "the vehicle goes on";
  flight_.offer(path, now_, state_);
  EXPECT_EQ(flight_.plan()->points_map_m.size(), 3U);
}

TEST_F(PathFlightTest, StopsBeforeAnObstacleOnThePlanAndReportsIt) {
  flight_.offer(straight({1.5, 2.0}, {6.0, 2.0}), now_, state_);
  run(1.0);
  fill(grid_, {{80, 0}, {81, 80}}, kWallCell);
  look();
  EXPECT_TRUE(flight_.keep(input()));
  EXPECT_EQ(lastEvent().text, "plan discarded");
  EXPECT_FALSE(flight_.plan());
  run(1.5);
  EXPECT_TRUE(controller_.stopped());
}

TEST_F(PathFlightTest, DropsThePlanWhenTheControllerDropsThePath) {
  flight_.offer(straight({1.5, 2.0}, {6.0, 2.0}), now_, state_);
  controller_.hold();  // As a retreat or a lost estimate does.
  EXPECT_FALSE(flight_.plan());
  EXPECT_TRUE(flight_.remaining_map_m().empty());
  EXPECT_EQ(flight_.aim().velocity_map_m_s, Eigen::Vector2d::Zero());
  EXPECT_EQ(lastEvent().text, "nothing") << "the code that ended it reports it";
  flight_.offer(straight({1.5, 2.0}, {6.0, 2.0}), now_, state_);
  EXPECT_TRUE(flight_.plan()) << "the same path is flown again";
}

TEST_F(PathFlightTest, ArrivesOnceNearAtTheHeightAndSlowForAWhile) {
  const auto arrived = [this](double seconds) {
    now_ += common::Duration::fromSeconds(seconds);
    return flight_.arrived(input(), {1.5, 2.0}, 0.05);
  };
  EXPECT_FALSE(arrived(0.0));
  EXPECT_FALSE(arrived(0.2));
  EXPECT_TRUE(arrived(0.1));
  memory_.cruise_height_m = kHeight_m + 0.15;
  EXPECT_FALSE(arrived(0.1)) << "too low";
  memory_.cruise_height_m = kHeight_m;
  EXPECT_FALSE(arrived(0.1)) << "the time counts from when it came back";
  EXPECT_TRUE(arrived(0.3));
  state_.velocity_odom_m_s.x() = 0.2;
  EXPECT_FALSE(arrived(0.3)) << "too fast";
}

}  // namespace
}  // namespace swiftlet::autonomy
