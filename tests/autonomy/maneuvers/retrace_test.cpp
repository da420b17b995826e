// Retrace: back along a flown path, without a plan.
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using common::IntentState;

TEST_F(ManeuverInFlight, RetraceFliesThePathToItsEnd) {
  const Eigen::Vector2d here = state_.T_map_body_planar().position_m();
  const Eigen::Vector2d corner = here + Eigen::Vector2d(0.6, 0.0), end = corner + Eigen::Vector2d(0.0, 0.5);
  want(common::RetraceIntent{{here, corner, end}, {}});
  ASSERT_EQ(runToTheEnd(15.0), IntentState::kSucceeded);
  EXPECT_LT(distanceTo_m(end), 0.05);
}

TEST_F(ManeuverInFlight, ARetraceFailsWhereSomethingIsInTheWayForLong) {
  const Eigen::Vector2d here = state_.T_map_body_planar().position_m();
  want(common::RetraceIntent{{here, here + Eigen::Vector2d(2.0, 0.0)}, {}});
  run(1.5);
  decision_.speed_limit_m_s = 0.0;
  executor_.react(decision_, state_);
  run(60.0);
  EXPECT_FALSE(ended()) << "the charge allows to wait";
  spare_s_ = 0.0;
  EXPECT_EQ(runToTheEnd(1.0), IntentState::kFailed);
  EXPECT_TRUE(executor_.status().reason.starts_with("something is in the way for 6")) << executor_.status().reason;
}

TEST_F(ManeuverInFlight, ARetraceDoesNotWaitAtAPlaceThatIsNotKnown) {
  const Eigen::Vector2d here = state_.T_map_body_planar().position_m();
  want(common::RetraceIntent{{here, here + Eigen::Vector2d(2.0, 0.0)}, {}});
  run(1.5);
  decision_.speed_limit_m_s = 0.0;
  executor_.react(decision_, state_);
  drift_m_ = 1.2;
  EXPECT_EQ(runToTheEnd(12.0), IntentState::kFailed);
}

TEST_F(ManeuverInFlight, ARetraceWithoutAPathIsDoneAtOnce) {
  want(common::RetraceIntent{});
  EXPECT_EQ(runToTheEnd(0.5), IntentState::kSucceeded);
}

TEST_F(ManeuverStory, RetraceFailsOnTheGround) {
  want(common::RetraceIntent{{{1.0, 1.0}}, {}});
  EXPECT_EQ(runToTheEnd(0.1), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "cannot fly back while powered off");
}

}  // namespace
}  // namespace swiftlet::autonomy
