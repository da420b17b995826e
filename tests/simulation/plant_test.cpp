// The plant of a nature: each term of airframe, battery, air and inertial unit against its formula.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/gravity.hpp"
#include "fixtures.hpp"
#include "quadrotor_fixtures.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/sensors/fuel_gauge.hpp"
#include "simulation/sensors/inertial_unit.hpp"
#include "simulation/wind.hpp"

namespace swiftlet::simulation {
namespace {

using Eigen::Vector3d;

/// Without drag, and with a battery that does not sag.
QuadrotorConfig simple() {
  QuadrotorConfig config = withoutDrag();
  config.battery.resistance_ohm = 0.0;
  return config;
}

Quadrotor flown(const QuadrotorConfig& config, double throttle, int steps = 500, double floor_world_m = kNoFloor) {
  Quadrotor quadrotor(kVehicle, config, inTheAir(), 1.0);
  for (int i = 0; i < steps; ++i)
    quadrotor.step({throttle, throttle, throttle, throttle}, Vector3d::Zero(), floor_world_m, 0.001);
  return quadrotor;
}

double thrust_n(const Quadrotor& quadrotor) {
  const MotorThrusts& f = quadrotor.state().thrusts_n;
  return f[0] + f[1] + f[2] + f[3];
}

TEST(Plant, ThrustGoesWithThePowerOfTheThrottle) {
  QuadrotorConfig config = simple();
  EXPECT_NEAR(thrust_n(flown(config, 0.5)), 0.5 * kVehicle.max_thrust_n, 0.02);
  config.throttle_exponent = 1.3;
  EXPECT_NEAR(thrust_n(flown(config, 0.5)), std::pow(0.5, 1.3) * kVehicle.max_thrust_n, 0.02);
  EXPECT_NEAR(thrust_n(flown(config, 1.0)), kVehicle.max_thrust_n, 0.05) << "full throttle is full throttle";
}

TEST(Plant, MassAndThrustAreSharesOfTheDataSheet) {
  QuadrotorConfig config = simple();
  const double sheet_m_s2 = flown(config, 0.6).state().specific_force_body_m_s2.z();
  config.mass_share = 1.1;
  EXPECT_NEAR(flown(config, 0.6).state().specific_force_body_m_s2.z(), sheet_m_s2 / 1.1, 1e-3);
  config.thrust_share = 0.9;
  EXPECT_NEAR(flown(config, 0.6).state().specific_force_body_m_s2.z(), 0.9 * sheet_m_s2 / 1.1, 1e-2);
}

TEST(Plant, AWeakMotorTurnsTheVehicleTowardsItself) {
  // Signs of roll, pitch and yaw rate: front left, front right, rear right, rear left.
  constexpr std::array<std::array<double, 3>, 4> kSigns = {{{-1, 1, -1}, {1, 1, 1}, {1, -1, -1}, {-1, -1, 1}}};
  for (int motor = 1; motor <= 4; ++motor) {
    QuadrotorConfig config = simple();
    config.weak_motor = motor;
    config.weak_motor_share = 0.95;
    const Vector3d rate = flown(config, 0.5, 50).state().angular_velocity_body_rad_s;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_GT(rate[axis] * kSigns[static_cast<std::size_t>(motor - 1)][static_cast<std::size_t>(axis)], 1e-3)
          << "motor " << motor << ", axis " << axis;
  }
  QuadrotorConfig none = simple();
  none.weak_motor_share = 0.5;
  EXPECT_EQ(flown(none, 0.5, 50).state().angular_velocity_body_rad_s, Vector3d::Zero()) << "motor 0 is none";
}

TEST(Plant, NearTheFloorTheSameThrottleLiftsMore) {
  constexpr double kRotorRadius_m = 0.127;
  QuadrotorConfig config = simple();
  config.ground_effect_radius_m = kRotorRadius_m;
  const auto felt = [&](double height_m) {
    return flown(config, 0.6, 1, 10.0 - height_m).state().specific_force_body_m_s2.z();
  };
  const double high = flown(config, 0.6, 1).state().specific_force_body_m_s2.z();
  EXPECT_NEAR(felt(2.0 * kRotorRadius_m) / high, 1.0 / (1.0 - 1.0 / 64.0), 1e-9);
  EXPECT_GT(felt(0.2), felt(0.4));
  EXPECT_NEAR(felt(2.0) / high, 1.0, 1e-3) << "gone two metres up";
  config.ground_effect_radius_m = 0.0;
  EXPECT_DOUBLE_EQ(felt(0.2), high) << "off by default";
}

TEST(Plant, AWallPullsWithTheThrustAndLessFromFartherAway) {
  QuadrotorConfig config = simple();
  config.wall_effect_share = 0.05;
  const auto pull_m_s2 = [&](double gap_m) {
    Quadrotor quadrotor = flown(config, 0.6);
    quadrotor.feelWall({0.0, -3.0}, gap_m);
    const double before = quadrotor.state().velocity_world_m_s.y();
    quadrotor.step({0.6, 0.6, 0.6, 0.6}, Vector3d::Zero(), kNoFloor, 0.001);
    return (before - quadrotor.state().velocity_world_m_s.y()) / 0.001;
  };
  const double thrust_m_s2 = 0.6 * kVehicle.max_thrust_n / kVehicle.mass_kg;
  EXPECT_NEAR(pull_m_s2(0.0), 0.05 * thrust_m_s2, 1e-2);
  EXPECT_NEAR(pull_m_s2(config.wall_effect_range_m), 0.05 * thrust_m_s2 / std::exp(1.0), 1e-2);
  EXPECT_LT(pull_m_s2(1.0), 1e-3);
  config.wall_effect_share = 0.0;
  EXPECT_EQ(pull_m_s2(0.0), 0.0) << "off by default";
}

TEST(Plant, AVehicleThatHoversBesideAWallDriftsTowardsIt) {
  const auto hoverAt = [](double share) {
    Scenario scenario;
    scenario.quadrotor.wall_effect_share = share;
    SimulatedVehicle vehicle(boxRoom(), scenario);
    TruthPilot pilot(vehicle);
    pilot.flyTo(0, 0, 1);
    EXPECT_TRUE(pilot.fly(3)) << vehicle.stopReason();
    pilot.flyTo(4.5, 0, 1);
    EXPECT_TRUE(pilot.fly(9)) << vehicle.stopReason();
    return vehicle.truth().T_world_body.position_m.x();
  };
  EXPECT_GT(hoverAt(0.05) - hoverAt(0.0), 0.01);
}

TEST(Plant, ThrustFallsWithThePowerOfTheVoltage) {
  for (const double exponent : {1.6, 2.0, 2.2}) {
    Battery::Config config;
    config.voltage_exponent = exponent;
    const Battery battery(kVehicle, config, 0.3);
    EXPECT_NEAR(battery.thrustShare(), std::pow(battery.voltage_v() / kVehicle.battery_full_v, exponent), 1e-12);
  }
}

TEST(Plant, ThrustOverWeightIsWhatTheMotorsGive) {
  QuadrotorConfig config;
  config.mass_share = 1.05;
  config.throttle_exponent = 1.2;
  config.weak_motor = 2;
  config.weak_motor_share = 0.96;
  for (const double charge : {1.0, 0.4, 0.1}) {
    Quadrotor quadrotor(kVehicle, config, inTheAir(), charge);
    for (int i = 0; i < 500; ++i) quadrotor.step({0.95, 0.95, 0.95, 0.95}, Vector3d::Zero(), kNoFloor, 0.001);
    EXPECT_NEAR(thrustOverWeight(kVehicle, config, charge, 0.95),
                thrust_n(quadrotor) / (1.05 * kVehicle.mass_kg * common::kGravity_m_s2), 0.01)
        << charge;
  }
}

/// A tick of an autopilot that was at rest.
std::array<double, 4> firstTick(Mixing mixing, double thrust, double roll_rad, double yaw_rate_rad_s) {
  AutopilotConfig config;
  config.mixing = mixing;
  Autopilot autopilot(kVehicle, {}, config);
  autopilot.receive({.stamp = {},
                     .motors_on = true,
                     .roll_rad = roll_rad,
                     .pitch_rad = 0.0,
                     .yaw_rate_rad_s = yaw_rate_rad_s,
                     .thrust = thrust},
                    common::Time());
  return autopilot.tick(common::Time(), {.battery_voltage_v = kVehicle.battery_full_v}, 0.002);
}

double rollOf(const std::array<double, 4>& f) { return f[0] + f[3] - f[1] - f[2]; }
double yawOf(const std::array<double, 4>& f) { return f[0] + f[2] - f[1] - f[3]; }

TEST(Mixing, AttitudeFirstKeepsTheRollTorqueAtFullThrottle) {
  const double wanted = rollOf(firstTick(Mixing::kClampEach, 0.5, 0.1, 0.0));
  ASSERT_GT(wanted, 0.1);
  EXPECT_NEAR(rollOf(firstTick(Mixing::kAttitudeFirst, 0.5, 0.1, 0.0)), wanted, 1e-12) << "nothing is at its limit";
  EXPECT_NEAR(rollOf(firstTick(Mixing::kAttitudeFirst, 1.0, 0.1, 0.0)), wanted, 1e-12);
  EXPECT_NEAR(rollOf(firstTick(Mixing::kClampEach, 1.0, 0.1, 0.0)), 0.5 * wanted, 1e-12) << "the clamp halves it";
  for (const double throttle : firstTick(Mixing::kAttitudeFirst, 1.0, 0.1, 1.0)) EXPECT_LE(throttle, 1.0);
}

TEST(Mixing, YawGetsWhatRollAndPitchLeave) {
  const double wanted = yawOf(firstTick(Mixing::kAttitudeFirst, 0.5, 0.0, 0.5));
  ASSERT_GT(wanted, 0.1);
  EXPECT_LT(yawOf(firstTick(Mixing::kAttitudeFirst, 0.9, 0.1, 0.5)), 0.5 * wanted);
  EXPECT_NEAR(rollOf(firstTick(Mixing::kAttitudeFirst, 0.9, 0.1, 0.5)),
              rollOf(firstTick(Mixing::kAttitudeFirst, 0.5, 0.1, 0.0)), 1e-12)
      << "the roll torque suffers nothing";
}

/// Gusts in steps of 0.01 s.
std::vector<Vector3d> gusts(GustModel model, int ticks) {
  Wind wind({.mean_x_m_s = 1.0, .gust_m_s = 0.4, .gust_time_s = 0.5, .model = model}, 3);
  std::vector<Vector3d> velocities;
  for (int tick = 0; tick < ticks; ++tick) {
    wind.step(static_cast<std::uint64_t>(tick), 0.01);
    velocities.push_back(wind.velocity_world_m_s() - Vector3d(1.0, 0.0, 0.0));
  }
  return velocities;
}

TEST(DrydenGusts, HaveTheGivenStandardDeviationAlongEachAxis) {
  const auto velocities = gusts(GustModel::kDryden, 400'000);
  Vector3d squares = Vector3d::Zero();
  for (const Vector3d& velocity : velocities) squares += velocity.cwiseProduct(velocity);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::sqrt(squares[axis] / static_cast<double>(velocities.size())), 0.4, 0.02) << axis;
}

// With T the gust time, the spectrum of x is 2 / (1 + T^2 w^2) and that of y and z (1 + 3 T^2 w^2) / (1 + T^2 w^2)^2.
// So y over x is 1/2 at low frequencies and 3/2 at high ones.
TEST(DrydenGusts, AcrossAreOfSecondOrder) {
  const auto velocities = gusts(GustModel::kDryden, 1'000'000);
  constexpr std::size_t kBlock = 1000;  // 20 gust times.
  Vector3d slow = Vector3d::Zero(), fast = Vector3d::Zero(), sum = Vector3d::Zero();
  for (std::size_t i = 1; i < velocities.size(); ++i) {
    const Vector3d change = velocities[i] - velocities[i - 1];
    fast += change.cwiseProduct(change);
    sum += velocities[i];
    if (i % kBlock != 0) continue;
    slow += sum.cwiseProduct(sum);
    sum.setZero();
  }
  for (const int axis : {1, 2}) {
    EXPECT_NEAR(slow[axis] / slow.x(), 0.5, 0.1) << axis;
    EXPECT_NEAR(fast[axis] / fast.x(), 1.5, 0.1) << axis;
  }
}

TEST(DrydenGusts, TheSimpleModelHasNoVerticalGusts) {
  for (const Vector3d& velocity : gusts(GustModel::kGaussMarkov, 100)) EXPECT_EQ(velocity.z(), 0.0);
}

TEST(Vibration, GrowsWithTheThrust) {
  const auto spread = [](double vibration_m_s2, double share) {
    ImuConfig config;
    config.vibration_m_s2 = vibration_m_s2;
    config.accel_bias_m_s2 = 0.0;
    InertialUnit unit(config, kVehicle, 1);
    QuadrotorState state;
    state.thrusts_n.fill(0.25 * share * kVehicle.max_thrust_n);
    double squares = 0.0;
    for (std::uint64_t frame = 1; frame <= 4000; ++frame) {
      unit.feel(state);
      const double x = unit.sample(frame, state).specific_force_body_m_s2.x();
      squares += x * x;
    }
    return std::sqrt(squares / 4000);
  };
  const double noise = ImuConfig{}.accel_noise_m_s2;
  EXPECT_NEAR(spread(1.0, 0.0), noise, 0.01) << "with the motors off";
  EXPECT_NEAR(spread(1.0, 0.5), std::hypot(noise, 0.5), 0.03);
  EXPECT_NEAR(spread(1.0, 1.0), std::hypot(noise, 1.0), 0.05);
  EXPECT_EQ(spread(0.0, 1.0), spread(0.0, 0.0)) << "off by default";
}

/// Mean shift of the accelerometer with motors that give `share` of the thrust of hovering.
Vector3d meanShift(double rectification_m_s2, double share, std::uint64_t seed) {
  const auto mean = [&](double shift_m_s2) {
    ImuConfig config;
    config.rectification_m_s2 = shift_m_s2;
    InertialUnit unit(config, kVehicle, seed);
    QuadrotorState state;
    state.thrusts_n.fill(0.25 * share * kVehicle.mass_kg * common::kGravity_m_s2);
    unit.feel(state);
    return unit.sample(1, state).specific_force_body_m_s2;
  };
  return mean(rectification_m_s2) - mean(0.0);
}

TEST(Rectification, ShiftsTheAccelerometerWithTheSquareOfTheThrust) {
  EXPECT_EQ(meanShift(0.2, 0.0, 1).norm(), 0.0) << "with the motors off";
  EXPECT_NEAR(std::abs(meanShift(0.2, 1.0, 1).z()), 0.2, 1e-12);
  EXPECT_NEAR((meanShift(0.2, 1.5, 1) - 2.25 * meanShift(0.2, 1.0, 1)).norm(), 0.0, 1e-12);
}

TEST(Rectification, HasItsDirectionBySeed) {
  int up = 0;
  double least = 1.0, greatest = -1.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Vector3d by = meanShift(0.2, 1.0, seed);
    EXPECT_NEAR(std::abs(by.z()), 0.2, 1e-12);
    up += by.z() > 0.0 ? 1 : 0;
    least = std::min({least, by.x(), by.y()});
    greatest = std::max({greatest, by.x(), by.y()});
  }
  EXPECT_NEAR(up, 100, 30);
  EXPECT_NEAR(least, -0.1, 0.005);
  EXPECT_NEAR(greatest, 0.1, 0.005);
}

TEST(FuelGauge, WithoutErrorsReadsTheTruth) {
  Battery battery(kVehicle, {}, 0.83);
  for (int i = 0; i < 1000; ++i) {
    battery.draw(180.0, 0.37);
    ASSERT_EQ(gaugedCharge({}, 0.83, battery), battery.remaining()) << "to the last bit";
    ASSERT_EQ(gaugedCurrent_a({}, battery), battery.current_a());
  }
}

TEST(FuelGauge, GuessesTheChargeAtTheStartAndCountsAWrongCurrent) {
  Battery battery(kVehicle, {}, 0.8);
  const FuelGaugeConfig gauge{.initial_error = 0.03, .gain_error = -0.05};
  EXPECT_NEAR(gaugedCharge(gauge, 0.8, battery), 0.83, 1e-12);
  for (int i = 0; i < 600; ++i) battery.draw(150.0, 1.0);
  EXPECT_NEAR(gaugedCharge(gauge, 0.8, battery), 0.83 - 0.95 * (0.8 - battery.remaining()), 1e-12);
  EXPECT_NEAR(gaugedCurrent_a(gauge, battery), 0.95 * battery.current_a(), 1e-12);
  EXPECT_EQ(gaugedCharge({.initial_error = 0.1}, 1.0, Battery(kVehicle, {}, 1.0)), 1.0) << "never above full";
}

TEST(FuelGauge, ItsErrorsAreInTheSamplesThatTheVehicleSends) {
  Scenario scenario;
  scenario.battery_remaining = 0.5;
  scenario.sensors.fuel_gauge.initial_error = -0.1;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  TruthPilot pilot(vehicle);
  pilot.flyTo(0, 0, 1);
  ASSERT_TRUE(pilot.fly(3)) << vehicle.stopReason();
  const auto samples = eventsOf<common::BatterySample>(pilot.events);
  ASSERT_GT(samples.size(), 10U);
  EXPECT_NEAR(samples.front().remaining, 0.4, 0.01);
  EXPECT_GT(samples.back().current_a, 5.0) << "it flies";
  EXPECT_NEAR(samples.back().voltage_v * samples.back().current_a, 180.0, 80.0) << "W";
}

}  // namespace
}  // namespace swiftlet::simulation
