// Every controller in closed loop with the small model, and each law against its equation.
#include <array>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/control/controller_fixtures.hpp"
#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

class EachController : public testing::TestWithParam<ControllerKind> {
 protected:
  VehicleModel model_ = sheetModel();
  FlightController::Config config_ = flightConfig(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Kinds, EachController,
                         testing::Values(ControllerKind::kSwiftlet, ControllerKind::kCascadedPid,
                                         ControllerKind::kVoltagePid, ControllerKind::kLqr,
                                         ControllerKind::kSlidingMode),
                         [](const auto& kind) { return nameOf(kind.param); });

TEST_P(EachController, HoversOnAWanderingHorizon) {
  double worst_m = 0, worst_height_m = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Flight flight(config_, &model_);
    flight.model.random = common::RandomStream(seed, "hover");
    flight.hover();
    ASSERT_TRUE(flies(flight.controller, flight.log, GetParam()));
    flight.run(5.0);
    const Rms rms = hoverFor(flight, 30.0, flight.controller.follower().reference().position_odom_m);
    worst_m = std::max(worst_m, rms.horizontal_m);
    worst_height_m = std::max(worst_height_m, rms.worst_vertical_m);
  }
  std::printf("%s: worst of 3 seeds %.3f m RMS horizontally, %.3f m worst vertically\n", toString(GetParam()), worst_m,
              worst_height_m);
  EXPECT_LT(worst_m, 0.07);
  EXPECT_LT(worst_height_m, 0.06);
}

TEST_P(EachController, HoldsItsPlaceInAWindThatComesUp) {
  Flight flight(config_, &model_);
  flight.hover();
  flight.run(3.0);
  flight.model.wind_m_s = {2.0, -1.0, 0.0};
  flight.run(12.0);
  EXPECT_LT(hoverFor(flight, 20.0, flight.controller.follower().reference().position_odom_m).horizontal_m, 0.07);
}

TEST_P(EachController, FliesACornerAndLands) {
  Flight flight(config_, &model_);
  flight.hover();
  const Eigen::Vector3d goal(2.0, 2.0, 1.2);
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {2, 0, 1}, goal}, FlightMode::kCareful, 1.0}));
  ASSERT_TRUE(flight.until([&] { return flight.controller.follower().finished(); }, 25.0));
  flight.run(4.0);
  EXPECT_LT((flight.model.position_m - goal).norm(), 0.15);
  EXPECT_NEAR(flight.model.yaw_rad, 1.0, 0.1);
  ASSERT_TRUE(flight.controller.command(Land{}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 12.0));
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.4);
}

TEST_P(EachController, TakesOffWithAnEighthLessThrustAndComesHomeOnAnEmptierBattery) {
  Flight flight(config_, &model_);
  flight.model.thrust_factor = 0.88;
  flight.model.voltage_v = 11.6;
  flight.hover();
  flight.run(5.0);
  EXPECT_LT(hoverFor(flight, 5.0, flight.controller.follower().reference().position_odom_m).worst_vertical_m, 0.08);
  EXPECT_NEAR(flight.controller.thrust().correction(), 1.0 / 0.88, 0.06);
}

TEST_P(EachController, ReturnsFromAPushWithoutCirclingOrFalling) {
  Flight flight(config_, &model_);
  flight.hover();
  flight.run(3.0);
  const Eigen::Vector3d at = flight.controller.follower().reference().position_odom_m;
  flight.model.position_m.x() -= 1.0;
  double lowest_m = 10.0;
  flight.until(
      [&] {
        lowest_m = std::min(lowest_m, flight.model.position_m.z());
        return false;
      },
      8.0);
  EXPECT_LT((flight.model.position_m - at).norm(), 0.2);
  EXPECT_GT(lowest_m, at.z() - 0.25);
}

TEST_P(EachController, NeverPassesOnWhatIsNotANumber) {
  Flight flight(config_, &model_);
  flight.hover();
  FlightTick tick;
  tick.now = flight.model.now + common::kControlPeriod;
  tick.state = flight.model.estimate();
  tick.state.T_odom_body.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  tick.state.T_odom_body.rotation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  tick.acceleration_odom_m_s2 = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const common::Setpoint setpoint = flight.controller.tick(tick);
  EXPECT_TRUE(std::isfinite(setpoint.roll_rad) && std::isfinite(setpoint.pitch_rad) &&
              std::isfinite(setpoint.yaw_rate_rad_s) && std::isfinite(setpoint.thrust));
  flight.run(5.0);
  EXPECT_LT((flight.model.position_m - flight.controller.follower().reference().position_odom_m).norm(), 0.3);
}

// A gust moves the vehicle less when the accelerometer tells of it.
TEST(SlidingMode, TheEstimatedDisturbanceShortensAGust) {
  const auto drift_m = [](bool accelerometer) {
    Flight flight(flightConfig(ControllerKind::kSlidingMode));
    flight.accelerometer = accelerometer;
    flight.model.attitude_sigma_deg = 0.0;
    flight.hover();
    flight.run(5.0);
    flight.model.wind_m_s = {4.0, 0.0, 0.0};
    const double at_m = flight.controller.follower().reference().position_odom_m.x();
    double farthest_m = 0;
    flight.until(
        [&] {
          farthest_m = std::max(farthest_m, std::abs(flight.model.position_m.x() - at_m));
          return false;
        },
        6.0);
    return farthest_m;
  };
  const double with_m = drift_m(true), without_m = drift_m(false);
  std::printf("a gust of 4 m/s moves it by %.3f m, without the accelerometer by %.3f m\n", with_m, without_m);
  EXPECT_LT(with_m, 0.8 * without_m);
}

TEST(Switching, LeavesNoStepInAnyCommandBetweenAnyTwo) {
  const VehicleModel model = sheetModel();
  for (int from = 0; from < kControllerKinds; ++from) {
    for (int to = 0; to < kControllerKinds; ++to) {
      if (from == to) continue;
      Flight flight(flightConfig(static_cast<ControllerKind>(from)), &model);
      flight.model.position_sigma_m = flight.model.velocity_sigma_m_s = flight.model.attitude_sigma_deg = 0.0;
      flight.model.wind_m_s = {1.5, -1.0, 0.0};
      flight.hover();
      ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {9, 0, 1}}, FlightMode::kCareful, {}}));
      flight.run(4.0);
      const common::Setpoint before = flight.model.under_way.back();
      ASSERT_TRUE(flight.controller.command(SwitchController{static_cast<ControllerKind>(to)}));
      flight.tick();
      const common::Setpoint after = flight.model.under_way.back();
      const std::string pair =
          nameOf(static_cast<ControllerKind>(from)) + " to " + nameOf(static_cast<ControllerKind>(to));
      EXPECT_NEAR(after.roll_rad, before.roll_rad, 0.2 * common::kRadPerDeg) << pair;
      EXPECT_NEAR(after.pitch_rad, before.pitch_rad, 0.2 * common::kRadPerDeg) << pair;
      EXPECT_NEAR(after.yaw_rate_rad_s, before.yaw_rate_rad_s, 0.01) << pair;
      EXPECT_NEAR(after.thrust, before.thrust, 0.005) << pair;
      EXPECT_TRUE(flies(flight.controller, flight.log, static_cast<ControllerKind>(to))) << pair;
      double worst_m = 0;
      flight.until(
          [&] {
            worst_m =
                std::max(worst_m, std::abs(flight.model.position_m.z() - 1.0) + std::abs(flight.model.position_m.y()));
            return false;
          },
          5.0);
      EXPECT_LT(worst_m, 0.2) << pair;
    }
  }
}

TEST(Switching, IsRefusedForAControllerWithoutItsModel) {
  Flight flight;
  flight.hover();
  const auto refused = flight.controller.command(SwitchController{ControllerKind::kLqr});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error(), testing::HasSubstr("vehicle_model"));
  EXPECT_TRUE(flies(flight.controller, flight.log, ControllerKind::kSwiftlet));
  VehicleModel half = sheetModel();
  half.yaw.gain = 0.0;
  Flight other(FlightController::Config{}, &half);
  EXPECT_FALSE(other.controller.command(SwitchController{ControllerKind::kLqr}));
}

}  // namespace
}  // namespace swiftlet::control
