// What the controller learns of its vehicle's thrust, and how it flies with little of it: stories of whole flights.
#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

TEST(ThrustMargin, LearnsTheHoverThrustOfAWeakAndSaggingVehicle) {
  Flight flight;
  flight.model.thrust_factor = 0.88;
  flight.model.voltage_drop_v_s = 0.02;  // 1.2 V in a minute.
  flight.hover();
  flight.run(20.0);
  const Rms rms = hoverFor(flight, 40.0, flight.controller.follower().reference().position_odom_m);
  EXPECT_LT(rms.worst_vertical_m, 0.05);
  EXPECT_NEAR(flight.controller.thrust().correction(), 1.0 / 0.88, 0.05);
}

/// Right after the take-off the hover command has not been learned yet: an integral carries what it lacks.
TEST(ThrustMargin, AnEmergencyRightAfterTheTakeOffOfAWeakVehicleIsSoft) {
  for (const double thrust_factor : {0.80, 0.88, 1.0, 1.15}) {
    Flight flight;
    flight.model.thrust_factor = thrust_factor;
    flight.height_period = common::Duration::fromMilliseconds(30);
    flight.height_delay = common::Duration::fromMilliseconds(60);
    flight.hover();
    const double carries = flight.controller.carryingCommand();
    const double sag = std::pow(flight.model.voltage_v / flight.model.vehicle.battery_full_v, 2);
    const double needed =
        9.81 * flight.model.vehicle.mass_kg / (flight.model.vehicle.max_thrust_n * sag * thrust_factor);
    EXPECT_NEAR(carries, needed, 0.05 * needed) << thrust_factor;
    flight.diverged = true;
    ASSERT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kPoweredOff; }, 10.0));
    std::printf("emergency with %.0f %% of the thrust: carries %.3f of %.3f, touches at %.2f m/s\n",
                100 * thrust_factor, carries, needed, flight.model.hardest_touch_m_s);
    EXPECT_LT(flight.model.hardest_touch_m_s, 0.85) << thrust_factor;
  }
}

/// A flight there and back on a line of 8 m with a battery of that voltage.
struct LineFlight {
  double seconds = 0, fastest_m_s = 0, greatest_command = 0, lowest_m = 10, margin = 0;
};
LineFlight flyLine(double voltage_v) {
  LineFlight result;
  Flight flight;
  flight.model.voltage_v = voltage_v;
  flight.model.voltage_drop_v_s = 0.0;
  flight.hover();
  flight.run(5.0);
  const double begin_s = flight.model.now.seconds();
  for (const double goal_m : {8.0, 0.0}) {
    EXPECT_TRUE(
        flight.controller.follow({{{flight.model.position_m.x(), 0, 1}, {goal_m, 0, 1}}, FlightMode::kFast, {}}));
    EXPECT_TRUE(flight.until(
        [&] {
          result.fastest_m_s = std::max(result.fastest_m_s, flight.model.velocity_m_s.head<2>().norm());
          result.greatest_command = std::max(result.greatest_command, flight.model.in_force.thrust);
          result.lowest_m = std::min(result.lowest_m, flight.model.position_m.z());
          return flight.controller.follower().finished();
        },
        60.0));
  }
  result.seconds = flight.model.now.seconds() - begin_s;
  result.margin = flight.controller.thrust().margin();
  return result;
}

TEST(ThrustMargin, ATiredBatteryFliesSlowerAndNeverSaturates) {
  const LineFlight fresh = flyLine(12.4), tired = flyLine(10.05);
  EXPECT_GT(fresh.margin, 1.5);
  EXPECT_GT(fresh.fastest_m_s, 0.95);
  EXPECT_LT(tired.margin, 1.12);
  EXPECT_GT(tired.margin, 1.05);
  EXPECT_LT(tired.fastest_m_s, 0.85 * fresh.fastest_m_s);
  EXPECT_GT(tired.seconds, 1.2 * fresh.seconds);
  EXPECT_LT(tired.greatest_command, 0.95) << "there is always some thrust left";
  EXPECT_GT(tired.lowest_m, 0.9);
  std::printf("fresh: %.2f m/s, margin %.2f; tired: %.2f m/s, margin %.2f, greatest command %.2f\n", fresh.fastest_m_s,
              fresh.margin, tired.fastest_m_s, tired.margin, tired.greatest_command);
}

TEST(ThrustMargin, WithoutThrustLeftTheIntegralDoesNotWindUp) {
  Flight flight;
  flight.model.thrust_factor = 0.9;
  flight.hover();
  flight.run(10.0);
  flight.model.thrust_factor = 0.56;  // Cannot hover.
  flight.run(1.5);
  flight.model.thrust_factor = 0.9;
  flight.run(3.0);
  const Rms rms = hoverFor(flight, 5.0, flight.controller.follower().reference().position_odom_m);
  EXPECT_LT(rms.worst_vertical_m, 0.1);
}

TEST(ThrustMargin, StartsFromWhatAnEarlierFlightLearned) {
  const auto worstHeight = [](const ThrustPoints& recalled) {
    Flight flight({}, nullptr, recalled);
    flight.model.thrust_factor = 0.68;
    flight.hover();
    const Rms rms = hoverFor(flight, 5.0, {0, 0, 1});
    return std::pair{rms.vertical_m, flight.controller.thrust().table().points()};
  };
  const auto [first_m, learned] = worstHeight({});
  const auto [second_m, relearned] = worstHeight(learned);
  EXPECT_LT(second_m, 0.6 * first_m);
  std::printf("height error after take-off: %.3f m RMS, %.3f m with memory\n", first_m, second_m);
  for (std::size_t i = 0; i < learned.size(); ++i)
    EXPECT_NEAR(relearned[i].hover_command, learned[i].hover_command, 0.05 * learned[i].hover_command);
}

TEST(ThrustMargin, AVehicleThatItsThrustDoesNotLiftGivesUpTheTakeOff) {
  Flight flight;
  flight.model.thrust_factor = 0.6;
  flight.model.voltage_v = 10.6;
  flight.tick();
  ASSERT_TRUE(flight.controller.command(Prepared{}));
  ASSERT_TRUE(flight.controller.command(TakeOff{1.0}));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanding; }, 6.0));
  EXPECT_THAT(flight.controller.groundedReason(), testing::HasSubstr("95 % of the thrust for 2.0 s"));
  EXPECT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 6.0));
}

TEST(ThrustMargin, TheGroundTeachesNothing) {
  Flight flight;
  flight.hover();
  flight.run(10.0);
  const double hover = flight.controller.thrust().hoverCommand();
  ASSERT_TRUE(flight.controller.command(Land{}));
  ASSERT_TRUE(flight.until([&] { return flight.controller.state() == FlightState::kLanded; }, 10.0));
  EXPECT_NEAR(flight.controller.thrust().hoverCommand(), hover, 0.01 * hover);
}

/// The estimate then follows the thrust that was given, whatever it lifts.
TEST(ThrustMargin, NothingIsLearnedWhileInertialSamplesAreReplaced) {
  const auto greatestChange = [](bool contradicted) {
    Flight flight;
    flight.hover();
    flight.run(5.0);
    const ThrustPoints before = flight.controller.thrust().table().points();
    flight.model.vehicle.mass_kg *= 1.05;
    flight.inertial_contradicted = contradicted;
    flight.run(10.0);
    const ThrustPoints after = flight.controller.thrust().table().points();
    double greatest = 0.0;
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
      greatest = std::max(greatest, std::abs(after[i].hover_command - before[i].hover_command));
    return greatest;
  };
  EXPECT_GT(greatestChange(false), 0.005);
  EXPECT_LT(greatestChange(true), 1e-9);
}

}  // namespace
}  // namespace swiftlet::control
