// Identification of a vehicle whose plant has what the model lacks: wind, a wandering horizon, noise and a second lag.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/gravity.hpp"
#include "control/identification/identify.hpp"
#include "tests/control/controller_fixtures.hpp"
#include "tests/control/flight_story.hpp"

namespace swiftlet::control {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// A flight round corners, up and down and with turns, as the estimate saw it.
FlightSamples flown(Flight& flight, double seconds) {
  FlightSamples samples;
  const std::vector<Eigen::Vector3d> square{{0, 0, 1}, {1.2, 0, 1.3}, {1.2, 1.2, 0.8}, {0, 1.2, 1.2}, {0, 0, 1}};
  int next = 0;
  flight.until(
      [&] {
        if (!flight.controller.follower().followsPath() || flight.controller.follower().finished()) {
          next = (next + 1) % static_cast<int>(square.size());
          (void)flight.controller.follow(
              {{flight.controller.follower().reference().position_odom_m, square[static_cast<std::size_t>(next)]},
               FlightMode::kFast,
               0.8 * next});
        }
        const common::VehicleState state = flight.model.estimate();
        const common::Setpoint& sent =
            flight.model.under_way.empty() ? flight.model.in_force : flight.model.under_way.back();
        samples.push_back({flight.model.now, sent.roll_rad, sent.pitch_rad, sent.yaw_rate_rad_s, sent.thrust,
                           state.velocity_odom_m_s, common::yawOf(state.T_odom_body.rotation),
                           std::cos(flight.model.roll_rad) * std::cos(flight.model.pitch_rad), flight.model.voltage_v,
                           flight.controller.state() == FlightState::kFlying});
        return false;
      },
      seconds);
  return samples;
}

FlightSamples flightOf(std::uint64_t seed, double seconds, double thrust_factor = 1.0, double voltage_v = 12.4) {
  Flight flight;
  flight.model.random = common::RandomStream(seed, "identify");
  flight.model.wind_m_s = {0.3 * static_cast<double>(seed % 3), 0.2, 0.0};
  flight.model.voltage_v = voltage_v;
  flight.model.voltage_drop_v_s = 0.01;
  flight.model.thrust_factor = thrust_factor;
  flight.hover();
  return flown(flight, seconds);
}

TEST(Identify, FindsTheModelOfMit) {
  const Identification found = identify({flightOf(1, 60), flightOf(2, 60)}, {});
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_NEAR(found.model.forward.gain, common::kGravity_m_s2, 1.5);
  EXPECT_NEAR(found.model.left.gain, -common::kGravity_m_s2, 1.5);
  EXPECT_NEAR(found.model.yaw.gain, 1.0, 0.05);
  EXPECT_NEAR(found.model.up.gain, common::kGravity_m_s2, 1.5);
  EXPECT_NEAR(found.model.up.offset, -common::kGravity_m_s2, 1.5);
  EXPECT_GT(found.model.forward.lag_s, 0.08);
  EXPECT_LT(found.model.forward.lag_s, 0.3);
  // A drag of 0.18 1/s is within what the noise and the wind leave of k2, as in the paper.
  EXPECT_NEAR(found.damped_forward.damping_1_s, 0.0, 0.4);
  std::printf("k %.2f +- %.2f, b %.2f +- %.2f, k2 %.3f +- %.3f 1/s, lag %.2f s\n", found.model.forward.gain,
              found.model.forward.gain_interval, found.model.forward.offset, found.model.forward.offset_interval,
              found.damped_forward.damping_1_s, found.damped_forward.damping_interval_1_s, found.model.forward.lag_s);
}

TEST(Identify, AShortFirstStepSpoilsNoFlight) {
  FlightSamples flight = flightOf(1, 60);
  const double gain = identify({flight}, {}).model.forward.gain;
  flight[0].stamp = flight[1].stamp - common::Duration::fromMilliseconds(1);
  EXPECT_NEAR(identify({flight}, {}).model.forward.gain, gain, 0.1);
}

// Stamps in another unit, or a log with exchanged columns, give numbers that no vehicle has.
TEST(Identify, LeavesOutAnAxisThatNoVehicleHas) {
  FlightSamples flight = flightOf(1, 60);
  for (FlightSample& sample : flight) {
    sample.pitch_rad = -sample.pitch_rad;
    sample.battery_v *= 2.0;
  }
  const Identification found = identify({flight}, {});
  EXPECT_EQ(found.model.forward.gain, 0.0);
  EXPECT_THAT(found.problems, Contains(testing::ContainsRegex("forward.gain: -[0-9.]+ is not within 3 and 30")));
  EXPECT_THAT(found.problems, Contains(HasSubstr("V is of another battery")));
  EXPECT_THAT(found.model.thrust, IsEmpty());
}

TEST(Identify, ItsIntervalsHoldTheTruth) {
  int held = 0, all = 0;
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    const Identification found = identify({flightOf(seed, 60)}, {});
    held +=
        std::abs(found.model.forward.gain - common::kGravity_m_s2) < found.model.forward.gain_interval + 0.5 ? 1 : 0;
    held += std::abs(found.model.yaw.gain - 1.0) < found.model.yaw.gain_interval + 0.03 ? 1 : 0;
    all += 2;
  }
  EXPECT_GE(held, all - 3);
}

TEST(Identify, WhatItFoundFliesAnotherFlightWithAnLqr) {
  VehicleModel model = identify({flightOf(3, 60, 0.92)}, {}).model;
  ASSERT_TRUE(model.hasAxes());
  Flight flight(flightConfig(ControllerKind::kLqr), &model);
  flight.model.thrust_factor = 0.92;
  flight.model.random = common::RandomStream(77, "held back");
  flight.hover();
  flight.run(5.0);
  const Rms rms = hoverFor(flight, 30.0, flight.controller.follower().reference().position_odom_m);
  EXPECT_LT(rms.horizontal_m, 0.07);
  EXPECT_LT(rms.worst_vertical_m, 0.06);
}

/// An angle whose rate is `gain` times its command behind a lag, and `offset`.
AxisSeries turnsWith(double gain, double lag_s, double offset) {
  common::RandomStream random(5, "turns");
  AxisSeries series;
  double taken = 0.0, angle_rad = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double command = 0.4 * std::sin(0.013 * i) + (i / 400 % 2 == 0 ? 0.3 : -0.3);
    taken += (1.0 - std::exp(-series.period_s / std::max(lag_s, 1e-6))) * (command - taken);
    angle_rad += series.period_s * (gain * taken + offset);
    series.command.push_back(command);
    series.velocity.push_back(angle_rad + random.gaussian(0.002));
  }
  return series;
}

TEST(FitRate, LeavesOutAnOffsetThatDoesNotDifferFromZero) {
  const auto without = fitRate({turnsWith(0.9, 0.1, 0.0)});
  ASSERT_TRUE(without) << without.error();
  EXPECT_EQ(without->offset, 0.0);
  EXPECT_GT(without->offset_interval, 0.0);
  EXPECT_NEAR(without->gain, 0.9, 0.01);
  EXPECT_FALSE(lagIsAtBound(*without, AxisFitOptions{}.longest_rate_lag_s));
  const auto with = fitRate({turnsWith(0.9, 0.1, 0.05)});
  ASSERT_TRUE(with);
  EXPECT_NEAR(with->offset, 0.05, 0.01);
}

TEST(FitRate, ASlowYawIsToldWithItsGain) {
  const auto slow = fitRate({turnsWith(1.0, 0.65, 0.0)});
  ASSERT_TRUE(slow);
  EXPECT_NEAR(slow->lag_s, 0.65, 0.05);
  EXPECT_NEAR(slow->gain, 1.0, 0.02);
}

TEST(FitRate, ALagBeyondTheSearchIsSeenAtItsBound) {
  const double longest_s = AxisFitOptions{}.longest_rate_lag_s;
  const auto slow = fitRate({turnsWith(0.9, 2.0 * longest_s, 0.0)});
  ASSERT_TRUE(slow);
  EXPECT_TRUE(lagIsAtBound(*slow, longest_s));
}

TEST(Identify, SaysThatALagIsAtItsBound) {
  AxisFitOptions options;
  options.longest_lag_s = 0.05;
  EXPECT_THAT(identify({flightOf(1, 60)}, {}, options).doubts,
              Contains(HasSubstr("forward: lag at its bound of 0.05 s")));
  EXPECT_THAT(identify({flightOf(1, 60)}, {}).doubts, testing::Not(Contains(HasSubstr("forward"))));
}

TEST(Identify, SaysWhatIsTooShortOrMovesTooLittle) {
  const Identification short_one = identify({flightOf(4, 8)}, {});
  EXPECT_THAT(short_one.problems, Contains(HasSubstr("forward: ")));
  EXPECT_THAT(short_one.problems, Contains(HasSubstr("of flight are too few, at least 15 s are needed")));
  EXPECT_FALSE(short_one.model.hasAxes());
  Flight flight;
  flight.hover();
  FlightSamples hover;
  for (int i = 0; i < 3000; ++i) {
    flight.tick();
    hover.push_back({flight.model.now, 0.0, 0.0, 0.0, 0.57, flight.model.velocity_m_s, 0.0, 1.0, 12.0, true});
  }
  EXPECT_THAT(identify({hover}, {}).problems, Contains(HasSubstr("the command moved too little")));
  EXPECT_THAT(identify({}, {}).problems, Contains(HasSubstr("thrust: 0.0 s of flight")));
}

TEST(ThrustEm, FindsTheCommandOfEachVoltageOverFlights) {
  const common::VehicleConfig sheet;
  const auto em = thrustByVoltage({flightOf(5, 60, 0.9, 12.4), flightOf(6, 60, 0.9, 11.8)}, sheet);
  ASSERT_TRUE(em) << em.error();
  for (const ThrustPoint& point : em->points) {
    if (point.seen_s < 2.0) continue;
    const double truth = sheet.mass_kg * common::kGravity_m_s2 /
                         (sheet.max_thrust_n * 0.9 * std::pow(point.voltage_v / sheet.battery_full_v, 2));
    EXPECT_NEAR(point.hover_command / truth, 1.0, 0.02) << point.voltage_v << " V";
  }
  EXPECT_GE(em->rounds, 1);
  EXPECT_GT(em->keeping, 0.5);
  EXPECT_THAT(problemsOf(em->points), IsEmpty());
}

// Dives and climbs that the accelerometer missed would pull a plain mean away.
TEST(ThrustEm, LeavesOutWhatDoesNotKeepTheHeight) {
  FlightSamples flight;
  for (int i = 0; i < 6000; ++i) {
    FlightSample sample;
    sample.stamp = common::Time::fromSeconds(0.01 * i);
    sample.battery_v = 12.5 - 0.0002 * i;
    sample.thrust = 0.6 + 0.02 * (12.5 - sample.battery_v) + 0.004 * std::sin(0.37 * i);
    if (i % 1000 > 850) sample.thrust += 0.25;  // Held down by hand.
    sample.flying = true;
    flight.push_back(sample);
  }
  const auto em = thrustByVoltage({flight}, {});
  ASSERT_TRUE(em);
  for (const ThrustPoint& point : em->points)
    EXPECT_NEAR(point.hover_command, 0.6 + 0.02 * (12.5 - point.voltage_v), 0.006) << point.voltage_v;
  EXPECT_NEAR(em->keeping, 0.85, 0.05);
}

}  // namespace
}  // namespace swiftlet::control
