// The controller in closed loop with the small model: stories of whole flights.
#include <algorithm>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

TEST(Flight, HoldsAgainstWind) {
  Flight flight;
  flight.model.wind_m_s = {2.0, -1.0, 0.0};
  flight.hover();
  flight.run(8.0);
  EXPECT_LT(hoverFor(flight, 20.0, flight.controller.follower().reference().position_odom_m).horizontal_m, 0.04);
}

double distanceTo(const std::vector<Eigen::Vector3d>& path, const Eigen::Vector3d& point) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Eigen::Vector3d line = path[i + 1] - path[i];
    const double share = std::clamp((point - path[i]).dot(line) / line.squaredNorm(), 0.0, 1.0);
    least_m = std::min(least_m, (path[i] + share * line - point).norm());
  }
  return least_m;
}

TEST(Flight, FollowsAPathWithCornersToItsGoal) {
  Flight flight;
  flight.hover();
  const Eigen::Vector3d goal(1.0, 3.0, 1.2);
  const std::vector<Eigen::Vector3d> path{{0, 0, 1}, {3, 0, 1}, {3, 3, 1}, goal};
  ASSERT_TRUE(flight.controller.follow({path, FlightMode::kFast, 1.0}));
  double worst_m = 0;
  EXPECT_TRUE(flight.until(
      [&] {
        worst_m = std::max(worst_m, distanceTo(path, flight.model.position_m));
        return flight.controller.follower().finished();
      },
      25.0));
  flight.run(1.5);
  EXPECT_LT((flight.model.position_m - goal).norm(), 0.07);
  EXPECT_NEAR(flight.model.yaw_rad, 1.0, 0.05);
  EXPECT_LT(worst_m, 0.15);
  EXPECT_TRUE(flight.controller.stopped());
  std::printf("path: worst distance from it %.3f m, greatest tilt %.1f deg, %.1f s\n", worst_m,
              flight.greatest_tilt_rad * 57.3, flight.model.now.seconds());
}

/// The map is turned against the odometry. A path turns away at a right angle beside something that stands in the cut.
TEST(Flight, AsksInTheMapWhetherTheCutOfACornerIsFree) {
  const auto nearest_m = [](bool asks) {
    Flight flight;
    flight.T_map_odom = {2.0, -1.0, 2.0};
    flight.hover();
    const auto inMap = [&](double x_m, double y_m) {
      const Eigen::Vector2d place_m = flight.T_map_odom * Eigen::Vector2d(x_m, y_m);
      return Eigen::Vector3d(place_m.x(), place_m.y(), 1.0);
    };
    EXPECT_TRUE(flight.controller.follow({{inMap(0, 0), inMap(8, 0)}, FlightMode::kFast, {}}));
    EXPECT_TRUE(flight.until([&] { return flight.model.position_m.x() > 3.0; }, 10.0));
    const double x_m = flight.controller.follower().reference().position_odom_m.x();
    const Eigen::Vector3d thing_odom_m(x_m + 0.33, 0.45, 1.0), thing_map_m = inMap(x_m + 0.33, 0.45);
    FlightPath path;
    path.points_map_m = {inMap(x_m, 0), inMap(x_m, 3)};
    path.mode = FlightMode::kFast;
    if (asks)
      path.clearance_m = [&](const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m) {
        return std::min(0.325, distanceTo({from_m, to_m}, thing_map_m));
      };
    EXPECT_TRUE(flight.controller.follow(path));
    double least_m = 10.0;
    EXPECT_TRUE(flight.until(
        [&] {
          least_m = std::min(least_m, (flight.model.position_m - thing_odom_m).head<2>().norm());
          return flight.controller.follower().finished();
        },
        25.0));
    return least_m;
  };
  EXPECT_LT(nearest_m(false), 0.27);
  EXPECT_GT(nearest_m(true), 0.29);
}

/// The limit of the position controller bounds corrections; a faster mode is flown at its own speed.
TEST(Flight, EachModeIsFlownAtItsSpeedAboveTheLimitOfCorrections) {
  FlightController::Config config;
  config.position.max_speed_m_s = 0.75;
  config.path.fast = {0.73, 0.8, 0.08};
  for (const auto& [mode, speed_m_s] : {std::pair(FlightMode::kFast, 0.73), std::pair(FlightMode::kBrisk, 1.2)}) {
    Flight flight(config);
    flight.hover();
    ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {8, 0, 1}}, mode, {}}));
    double top_m_s = 0.0;
    flight.until(
        [&] {
          top_m_s = std::max(top_m_s, flight.model.velocity_m_s.x());
          return flight.controller.follower().finished();
        },
        20.0);
    flight.run(1.0);
    EXPECT_NEAR(top_m_s, speed_m_s, 0.1) << toString(mode);
    EXPECT_NEAR(flight.model.position_m.x(), 8.0, 0.08) << toString(mode);
  }
}

TEST(Flight, BrakesFromFullSpeedWithoutOvershootWhenHalted) {
  Flight flight;
  flight.hover();
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {8, 0, 1}}, FlightMode::kFast, {}}));
  ASSERT_TRUE(flight.until([&] { return flight.model.position_m.x() > 3.0; }, 10.0));
  flight.controller.setSpeedLimit(0.0);
  const double from_m = flight.model.position_m.x();
  double farthest_m = 0;
  flight.until(
      [&] {
        farthest_m = std::max(farthest_m, flight.model.position_m.x() - from_m);
        return false;
      },
      3.0);
  EXPECT_TRUE(flight.controller.stopped());
  EXPECT_LT(farthest_m, 1.0 / (2 * 1.2) + 0.3);  // Within attitude_lag_s it flies on.
  flight.controller.setSpeedLimit(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(flight.until([&] { return flight.controller.follower().finished(); }, 12.0));
}

TEST(Flight, ACorrectionOfTheMapMovesTheHoldPointSmoothly) {
  Flight flight;
  flight.hover();
  flight.run(2.0);
  flight.T_map_odom = {0.20, 0.0, 0.0};  // The same map point is now 0.2 m behind in odom.
  flight.greatest_tilt_rad = 0;
  flight.run(4.0);
  EXPECT_NEAR(flight.model.position_m.x(), -0.20, 0.06);
  EXPECT_LT(flight.greatest_tilt_rad * 57.3, 20.0);
}

TEST(Flight, LandsSoftlyAndDetectsIt) {
  Flight flight;
  flight.hover();
  ASSERT_TRUE(flight.controller.command(Land{}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 10.0));
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.35);
  flight.run(0.5);
  EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6);
  EXPECT_LT(flight.model.thrust_n, 0.1);
  EXPECT_TRUE(flight.controller.stopped());
}

TEST(Flight, LandsOnATable) {
  Flight flight;
  flight.hover(1.5);
  flight.model.floor_m = 0.75;
  ASSERT_TRUE(flight.controller.command(Land{}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 10.0));
  EXPECT_NEAR(flight.model.position_m.z(), 0.75 + QuadrotorModel::kStanding_m, 1e-6);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.35);
}

TEST(Flight, LandCancelsATakeOff) {
  Flight flight;
  flight.tick();
  ASSERT_TRUE(flight.controller.command(Prepared{}));
  ASSERT_TRUE(flight.controller.command(TakeOff{1.5}));
  ASSERT_TRUE(flight.until([&] { return flight.model.position_m.z() > 0.7; }, 10.0));
  EXPECT_EQ(flight.controller.state(), FlightState::kTakingOff);
  EXPECT_FALSE(flight.controller.follow({{{1, 0, 1}}, FlightMode::kFast, {}}));
  ASSERT_TRUE(flight.controller.command(Land{}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 10.0));
  EXPECT_LT(flight.model.position_m.z(), 0.2);
}

TEST(Flight, LandsInAnEmergencyWithoutTheEstimateAfterDivergence) {
  Flight flight;
  flight.hover(1.5);
  flight.diverged = true;
  flight.tick();
  EXPECT_EQ(flight.controller.state(), FlightState::kEmergencyLanding);
  EXPECT_EQ(flight.log.take().back().severity, common::Severity::kWarning);
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 15.0));
  EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.6);
  flight.run(0.1);
  EXPECT_FALSE(flight.model.in_force.motors_on);
}

TEST(Flight, EmergencyLandingOverATableEdgeStaysSoft) {
  Flight flight;
  flight.hover(1.8);
  flight.diverged = true;
  flight.run(0.5);
  flight.model.floor_m = 0.75;
  flight.run(0.5);
  flight.model.floor_m = 0.0;
  double fastest_m_s = 0;
  EXPECT_TRUE(flight.until(
      [&] {
        fastest_m_s = std::max(fastest_m_s, flight.model.velocity_m_s.norm());
        return flight.controller.state() == FlightState::kPoweredOff;
      },
      15.0));
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.6);
}

/// A laser of 10 Hz behind a slow link, which is noticed as lost while the vehicle climbs.
TEST(Flight, EmergencyLandingIsSoftWithFewAndLateHeights) {
  Flight flight;
  flight.height_period = common::Duration::fromMilliseconds(100);
  flight.height_delay = common::Duration::fromMilliseconds(100);
  flight.tick();
  ASSERT_TRUE(flight.controller.command(Prepared{}));
  ASSERT_TRUE(flight.controller.command(TakeOff{2.0}));
  ASSERT_TRUE(flight.until([&] { return flight.model.position_m.z() > 1.2; }, 12.0));
  flight.diverged = true;
  double fastest_m_s = 0.0;
  EXPECT_TRUE(flight.until(
      [&] {
        fastest_m_s = std::max(fastest_m_s, -flight.model.velocity_m_s.z());
        return flight.controller.state() == FlightState::kPoweredOff;
      },
      15.0));
  EXPECT_LT(fastest_m_s, 1.1);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.7);
}

TEST(Flight, WithoutAHeightItComesDownOverThePlaceThatItStillKnows) {
  Flight flight;
  flight.hover(1.5);
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1.5}, {5, 0, 1.5}}, FlightMode::kFast, {}}));
  flight.run(3.0);
  flight.vertical_valid = false;
  flight.run(0.5);
  ASSERT_EQ(flight.controller.state(), FlightState::kEmergencyLanding);
  flight.run(1.5);
  const Eigen::Vector2d stopped_m = flight.model.position_m.head<2>();
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 20.0));
  EXPECT_LT((flight.model.position_m.head<2>() - stopped_m).norm(), 0.15);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.6);
}

TEST(Flight, WithoutAPositionItEscapesTheWallsAndLands) {
  Flight flight;
  flight.T_map_odom = {2.0, -1.0, M_PI / 2.0};
  flight.hover(1.0);
  flight.controller.setEscape({0.0, 0.5});
  const Eigen::Vector3d before_m = flight.model.position_m;
  flight.horizontal_valid = false;
  flight.run(0.3);
  EXPECT_FALSE(flight.controller.follow({{{0, 0, 1.0}, {5, 0, 1.0}}, FlightMode::kFast, {}}));
  EXPECT_FALSE(flight.controller.followVelocity({1, 0}, 1.0, 0.0));
  flight.controller.hold();
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 20.0));
  EXPECT_NEAR(flight.model.position_m.x() - before_m.x(), 0.5, 0.15) << "along y of the map, which is x of odom";
  EXPECT_NEAR(flight.model.position_m.y() - before_m.y(), 0.0, 0.15);
  EXPECT_LT(flight.model.hardest_touch_m_s, 0.7);
}

TEST(Flight, APathIsNotFlownWithoutAPosition) {
  Flight flight;
  flight.hover(1.0);
  const Eigen::Vector3d before_m = flight.model.position_m;
  flight.horizontal_valid = false;
  flight.run(0.1);
  (void)flight.controller.follow({{before_m, before_m + Eigen::Vector3d(5, 0, 0)}, FlightMode::kFast, {}});
  flight.run(3.0);
  EXPECT_LT((flight.model.position_m - before_m).head<2>().norm(), 0.2);
}

TEST(Flight, WithoutInertialSamplesItBrakesAndComesDown) {
  Flight flight;
  flight.hover(1.5);
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1.5}, {5, 0, 1.5}}, FlightMode::kFast, {}}));
  flight.run(3.0);
  const double begin_x_m = flight.model.position_m.x(), speed_m_s = flight.model.velocity_m_s.x();
  ASSERT_GT(speed_m_s, 0.5);
  flight.inertial_fault = "no inertial samples";
  flight.run(0.3);
  ASSERT_EQ(flight.controller.state(), FlightState::kEmergencyLanding);
  EXPECT_EQ(flight.controller.groundedReason(), "no inertial samples for 0.2 s");
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 20.0));
  EXPECT_LT(flight.model.position_m.x() - begin_x_m, 1.2 * speed_m_s);
  EXPECT_FALSE(flight.controller.command(Prepared{}) && flight.controller.command(TakeOff{1.0}));
}

TEST(Flight, InertialSamplesCarryTheDescentWithoutAHeight) {
  for (const double bias_m_s2 : {-0.03, 0.0, 0.03}) {
    Flight flight;
    flight.carried_bias_m_s2 = bias_m_s2;
    flight.hover(1.8);
    flight.vertical_valid = flight.mirror = false;
    EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 25.0));
    EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6) << "no motor stops in the air";
    EXPECT_LT(flight.model.hardest_touch_m_s, 0.75) << bias_m_s2;
  }
}

TEST(Flight, ALandingWithoutAHeightIsCarriedToo) {
  for (const double bias_m_s2 : {-0.03, 0.0, 0.03}) {
    Flight flight;
    flight.hover(1.5);
    flight.carried_bias_m_s2 = bias_m_s2;
    flight.mirror = flight.vertical_measured = false;
    ASSERT_TRUE(flight.controller.command(Land{}));
    EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 20.0));
    EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6) << "no motor stops in the air";
    EXPECT_LT(flight.model.hardest_touch_m_s, 0.6) << bias_m_s2;
  }
}

TEST(Flight, ATakeOffAboveTheGreatestHeightIsRefusedAndPathsStayBelow) {
  Flight grounded, flight;
  grounded.tick();
  ASSERT_TRUE(grounded.controller.command(Prepared{}));
  const auto refused = grounded.controller.command(TakeOff{3.5});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "a take-off height of 3.50 m is above the greatest height, 2.00 m");
  EXPECT_EQ(grounded.controller.state(), FlightState::kPoweredOff);
  flight.hover(1.5);
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1.5}, {3, 0, 3.5}}, FlightMode::kFast, {}}));
  double highest_m = 0.0;
  flight.until(
      [&] {
        highest_m = std::max(highest_m, flight.model.position_m.z());
        return false;
      },
      8.0);
  EXPECT_LT(highest_m, 2.1);
  EXPECT_GT(highest_m, 1.9);
}

TEST(Flight, LandsWithoutAnyMeasurement) {
  Flight flight;
  flight.hover(1.0);
  flight.diverged = true;
  flight.mirror = false;
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 20.0));
  EXPECT_NEAR(flight.model.position_m.z(), QuadrotorModel::kStanding_m, 1e-6);
  // Only the trim carries it: another order of rounding, as of another compiler, moves this by 0.1 m/s.
  EXPECT_LT(flight.model.hardest_touch_m_s, 1.1);
}

TEST(Flight, ASilentLaserLeadsToHoldAndThenToLanding) {
  Flight flight;
  flight.hover();
  ASSERT_TRUE(flight.controller.follow({{{0, 0, 1}, {5, 0, 1}}, FlightMode::kFast, {}}));
  flight.run(3.0);
  flight.horizontal_valid = false;
  flight.run(0.8);
  EXPECT_LT(flight.model.velocity_m_s.head<2>().norm(), 0.35);
  flight.run(2.0);
  EXPECT_EQ(flight.controller.state(), FlightState::kFlying);
  flight.run(0.4);
  EXPECT_EQ(flight.controller.state(), FlightState::kLanding);
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 10.0));
}

/// 0.4 m over a table of 0.75 m would be 0.15 m above the path, but no more than 0.05 m is allowed.
TEST(Flight, TheLiftOverATableIsThatWhichIsFlown) {
  Flight flight;
  flight.hover();
  flight.controller.setMaxHeight(1.05);
  flight.model.floor_m = 0.75;
  flight.run(3.0);
  EXPECT_NEAR(flight.controller.lift_m(), 0.05, 1e-9);
  EXPECT_NEAR(flight.model.position_m.z(), 1.05, 0.03);
  flight.controller.setMaxHeight(2.0);
  flight.run(3.0);
  EXPECT_NEAR(flight.controller.lift_m(), 0.15, 0.03);
}

TEST(Flight, RefusesCommandsThatTheStateDoesNotAllow) {
  Flight flight;
  flight.tick();
  EXPECT_FALSE(flight.controller.command(TakeOff{1.0}));
  EXPECT_FALSE(flight.controller.command(Land{}));
  ASSERT_TRUE(flight.controller.command(Prepared{}));
  EXPECT_THAT(flight.controller.command(TakeOff{0.1}).error(), testing::HasSubstr("0.10"));
  EXPECT_THAT(flight.controller.command(TakeOff{std::nan("")}).error(), testing::HasSubstr("height"));
  EXPECT_FALSE(flight.controller.follow({{{1, 0, 1}}, FlightMode::kFast, {}}));
  flight.horizontal_valid = false;
  flight.tick();
  EXPECT_THAT(flight.controller.command(TakeOff{1.0}).error(), testing::HasSubstr("estimate"));
}

}  // namespace
}  // namespace swiftlet::control
