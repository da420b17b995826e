// What the supervisor answers to an operator is what the vehicle then does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/supervisor_story.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::HasSubstr;

TEST_F(SupervisorStory, AFlightHomeThatEndsOnTheGroundTakesNoGoals) {
  energy_.battery_remaining = 0.19;
  energy_.home_m = 20.0;
  energy_.home_share = 0.05;
  ASSERT_EQ(at(2.0).home, 1u);
  EXPECT_THAT(supervisor_.refusal({1, common::GoalCommand{{1.0, 0.0}}}),
              HasSubstr("the vehicle flies home and lands there: turned back with 19 %"));
  EXPECT_NE(supervisor_.refusal({2, common::StartMissionCommand{}}), "");
  EXPECT_NE(supervisor_.refusal({3, common::HomeCommand{}}), "") << "its Resume would never come";
  EXPECT_EQ(supervisor_.refusal({4, common::HoldCommand{}}), "");
  EXPECT_EQ(supervisor_.refusal({5, common::ResumeCommand{}}), "");
  EXPECT_EQ(supervisor_.refusal({6, common::KeepOutCommand{}}), "") << "it holds for the flight home, too";
}

TEST_F(SupervisorStory, AHoldDuringAFlightBackIsSaidToBeOne) {
  at(1.0);
  vertical_age_s_ = 0.6;
  ASSERT_EQ(at(1.2).back, 1u);
  ASSERT_TRUE(supervisor_.take({1, common::HoldCommand{}}, Time::fromSeconds(1.3))->accepted);
  EXPECT_EQ(at(1.3).back, 0u);
  EXPECT_EQ(at(1.3).hold_reason, "the operator holds, and it would fly back along its trail");
  ASSERT_TRUE(supervisor_.take({2, common::ResumeCommand{}}, Time::fromSeconds(1.4))->accepted);
  EXPECT_EQ(at(1.4).back, 1u);
  EXPECT_EQ(at(1.4).hold_reason, "it flies back along its trail");
}

TEST_F(SupervisorStory, EachFlightIsToldOfItsCharge) {
  const auto told = [this](double t_s, double remaining, bool airborne) {
    energy_.battery_remaining = remaining;
    at(t_s, airborne);
    return log_.take().size();
  };
  EXPECT_EQ(told(1.0, 0.29, true), 1u);
  EXPECT_EQ(told(2.0, 0.28, true), 0u);
  EXPECT_EQ(told(3.0, 0.95, false), 0u) << "it is charged";
  EXPECT_EQ(told(4.0, 0.95, true), 0u);
  EXPECT_EQ(told(5.0, 0.29, true), 1u);
}

}  // namespace
}  // namespace swiftlet::autonomy
