// The reference as a smooth trajectory, and how far behind it the sliding mode flies.
#include "control/smoothed_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/gravity.hpp"
#include "control/controllers/sliding_mode.hpp"
#include "control/path_follower.hpp"

namespace swiftlet::control {
namespace {

constexpr double kTick_s = 0.01, kLag_s = 0.2;

/// Accelerates along x with 0.5 m/s^2 for two seconds, then keeps its speed.
Reference movingAt(double time_s) {
  constexpr double kAcceleration_m_s2 = 0.5, kUntil_s = 2.0;
  const double sped_up_s = std::min(time_s, kUntil_s);
  Reference reference;
  reference.velocity_odom_m_s.x() = kAcceleration_m_s2 * sped_up_s;
  reference.position_odom_m.x() =
      0.5 * kAcceleration_m_s2 * sped_up_s * sped_up_s + reference.velocity_odom_m_s.x() * (time_s - sped_up_s);
  reference.acceleration_odom_m_s2.x() = time_s < kUntil_s ? kAcceleration_m_s2 : 0.0;
  return reference;
}

TEST(SmoothedReference, IsBehindByTheSquareOfTheLagTimesTheAccelerationAndNotAtConstantSpeed) {
  SmoothedReference smoothed;
  double accelerating_m = 0.0, steady_m = 0.0, last_m_s = 0.0, greatest_m_s2 = 0.0;
  for (int i = 0; i <= 500; ++i) {
    // The acceleration is that of the tick which ends then.
    Reference reference = movingAt(kTick_s * i);
    reference.acceleration_odom_m_s2 = movingAt(kTick_s * (i - 1)).acceleration_odom_m_s2;
    if (i == 0) reference.acceleration_odom_m_s2.setZero();
    const Reference smooth = smoothed.advance(reference, kLag_s, kTick_s);
    const double behind_m = reference.position_odom_m.x() - smooth.position_odom_m.x();
    if (i == 195) accelerating_m = behind_m;
    if (i == 500) steady_m = behind_m;
    greatest_m_s2 = std::max(greatest_m_s2, (smooth.velocity_odom_m_s.x() - last_m_s) / kTick_s);
    last_m_s = smooth.velocity_odom_m_s.x();
    EXPECT_DOUBLE_EQ(smooth.acceleration_odom_m_s2.x(), reference.acceleration_odom_m_s2.x());
  }
  EXPECT_NEAR(accelerating_m, kLag_s * kLag_s * 0.5, 2e-4);
  EXPECT_NEAR(steady_m, 0.0, 1e-5);
  // Of (2 tau s + 1) / (tau s + 1)^2 on a step: 1 + exp(-2) at the most, after twice the lag.
  EXPECT_NEAR(greatest_m_s2, 0.5 * (1.0 + std::exp(-2.0)), 0.01);
}

TEST(SmoothedReference, WithoutALagAndAfterAJumpItIsTheReference) {
  SmoothedReference smoothed;
  Reference reference = movingAt(1.0);
  EXPECT_EQ(smoothed.advance(reference, 0.0, kTick_s).position_odom_m, reference.position_odom_m);
  reference.acceleration_odom_m_s2.setZero();
  reference.position_odom_m.y() = 7.0;
  EXPECT_EQ(smoothed.advance(reference, kLag_s, kTick_s).position_odom_m, reference.position_odom_m);
}

/// The greatest distance of a vehicle from the reference of a path of 4 m, with an attitude that lags as an autopilot's
/// does, and with the drag of a quadrotor.
double greatestError_m(const PathFollower::Limits& limits) {
  common::VehicleConfig vehicle;
  ThrustModel thrust{{}, vehicle};
  thrust.setLearning(false);
  thrust.observeVoltage(vehicle.battery_full_v, kTick_s);
  SlidingMode controller({.horizontal_d_1_s = 3.3, .switching_m_s2 = 1.8, .boundary_m_s = 0.8}, vehicle);
  PathFollower::Config config;
  config.fast = limits;
  PathFollower follower(config);
  follower.reset({0, 0, 1}, 0.0);
  follower.setPath({{0, 0, 1}, {4, 0, 1}}, common::FlightMode::kFast, std::nullopt);
  ControlInput input;
  double x_m = 0.0, velocity_m_s = 0.0, greatest_m = 0.0;
  double lagging_m_s2[3] = {0.0, 0.0, 0.0};
  const double lags_s[3] = {1.0 / 7.0, 1.0 / 18.0, 0.035};
  for (int i = 0; i < 3000; ++i) {
    input.reference = follower.advance(kTick_s);
    input.state.T_odom_body.position_m = {x_m, 0, 1};
    input.state.velocity_odom_m_s = {velocity_m_s, 0, 0};
    input.acceleration_odom_m_s2 = Eigen::Vector3d(lagging_m_s2[2] - 0.3 * velocity_m_s, 0, 0);
    double given_m_s2 = common::kGravity_m_s2 * std::tan(controller.tick(input, thrust).pitch_rad);
    for (int k = 0; k < 3; ++k)
      given_m_s2 = lagging_m_s2[k] += (1.0 - std::exp(-kTick_s / lags_s[k])) * (given_m_s2 - lagging_m_s2[k]);
    velocity_m_s += kTick_s * (given_m_s2 - 0.3 * velocity_m_s);
    x_m += kTick_s * velocity_m_s;
    greatest_m = std::max(greatest_m, std::abs(input.reference.position_odom_m.x() - x_m));
  }
  EXPECT_NEAR(x_m, 4.0, 0.01);
  return greatest_m;
}

// A reference behind a lag of first order would leave 8 cm at 0.4 m/s, whatever the gains are.
TEST(SmoothedReference, TheSlidingModeFliesHardlyBehindAReferenceOfConstantSpeed) {
  EXPECT_LT(greatestError_m({.speed_m_s = 0.4, .acceleration_m_s2 = 0.3}), 0.04);
  EXPECT_LT(greatestError_m({.speed_m_s = 0.2, .acceleration_m_s2 = 0.3}), 0.04);
}

}  // namespace
}  // namespace swiftlet::control
