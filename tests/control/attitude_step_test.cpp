#include "control/attitude_step.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace swiftlet::control {
namespace {

common::Setpoint setpointWith(double roll_rad, double pitch_rad, double thrust) {
  common::Setpoint setpoint;
  setpoint.roll_rad = roll_rad;
  setpoint.pitch_rad = pitch_rad;
  setpoint.thrust = thrust;
  return setpoint;
}

TEST(AttitudeStep, IsFreeWhereMuchThrustIsLeft) {
  const auto leaning = common::quaternionFrom({0.3, -0.3, 1.0});
  const common::Setpoint given = withinThrustLeft(setpointWith(-0.35, 0.35, 0.5), leaning);
  EXPECT_EQ(given.roll_rad, -0.35);
  EXPECT_EQ(given.pitch_rad, 0.35);
  EXPECT_EQ(given.thrust, 0.5);
}

TEST(AttitudeStep, IsSmallNearFullThrottleInBothDirections) {
  const auto leaning = common::quaternionFrom({0.1, -0.1, 1.0});
  const common::Setpoint given = withinThrustLeft(setpointWith(-0.35, 0.35, 0.95), leaning);
  EXPECT_NEAR(given.roll_rad, 0.1 - 0.075, 1e-9);
  EXPECT_NEAR(given.pitch_rad, -0.1 + 0.075, 1e-9);
}

TEST(AttitudeStep, CanAlwaysReturnUpright) {
  const common::Setpoint given =
      withinThrustLeft(setpointWith(0.0, 0.0, 1.0), common::quaternionFrom({0.2, 0.03, -2.0}));
  EXPECT_LT(given.roll_rad, 0.17);
  EXPECT_EQ(given.pitch_rad, 0.0);
}

}  // namespace
}  // namespace swiftlet::control
