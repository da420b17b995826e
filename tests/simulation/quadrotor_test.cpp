#include "simulation/quadrotor.hpp"
#include "common/gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "quadrotor_fixtures.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/sensors/inertial_unit.hpp"
#include "simulation/wind.hpp"

namespace swiftlet::simulation {
namespace {

using Eigen::Vector3d;
constexpr double kStep_s = 0.001;

const QuadrotorConfig kAirframe;

/// An autopilot on a perfect AHRS.
AttitudeMeasurement perfect(const Quadrotor& quadrotor) {
  return {quadrotor.state().T_world_body.rotation, quadrotor.state().angular_velocity_body_rad_s,
          quadrotor.battery().voltage_v()};
}

void fly(Quadrotor& quadrotor, Autopilot& autopilot, const common::Setpoint& setpoint, double seconds,
         const Vector3d& wind = Vector3d::Zero()) {
  std::array<double, 4> throttles{};
  for (int step = 0; step < static_cast<int>(seconds / kStep_s); ++step) {
    const common::Time now = common::Time::fromSeconds(step * kStep_s);
    autopilot.receive(setpoint, now);
    if (step % 2 == 0) throttles = autopilot.tick(now, perfect(quadrotor), 2 * kStep_s);
    quadrotor.step(throttles, wind, kNoFloor, kStep_s);
  }
}

TEST(Quadrotor, FallsFreelyWithMotorsOffAndNoDrag) {
  Quadrotor quadrotor(kVehicle, withoutDrag(), inTheAir(), 1.0);
  for (int i = 0; i < 1000; ++i) quadrotor.step({}, Vector3d::Zero(), kNoFloor, kStep_s);
  EXPECT_NEAR(quadrotor.state().velocity_world_m_s.z(), -common::kGravity_m_s2, 1e-9);
  EXPECT_NEAR(quadrotor.state().T_world_body.position_m.z(), 10 - 0.5 * common::kGravity_m_s2, 0.01);
  EXPECT_NEAR(quadrotor.state().specific_force_body_m_s2.norm(), 0.0, 1e-9) << "weightless";
}

TEST(Quadrotor, DragSlowsAFallAndWindMovesIt) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 1.0);
  double energy = common::kGravity_m_s2 * 10;
  for (int i = 0; i < 20'000; ++i) {
    quadrotor.step({}, Vector3d::Zero(), kNoFloor, kStep_s);
    const auto& state = quadrotor.state();
    const double now =
        common::kGravity_m_s2 * state.T_world_body.position_m.z() + 0.5 * state.velocity_world_m_s.squaredNorm();
    ASSERT_LE(now, energy + 1e-9);
    energy = now;
  }
  // Terminal speed: m g = (k1 + k2 v) v.
  const double k1 = kAirframe.linear_drag_n_s_m, k2 = kAirframe.quadratic_drag_n_s2_m2;
  const double terminal = (-k1 + std::sqrt(k1 * k1 + 4 * k2 * kVehicle.mass_kg * common::kGravity_m_s2)) / (2 * k2);
  EXPECT_NEAR(-quadrotor.state().velocity_world_m_s.z(), terminal, 0.01);
  for (int i = 0; i < 30'000; ++i) quadrotor.step({}, Vector3d(2, -1, 0), kNoFloor, kStep_s);
  EXPECT_NEAR(quadrotor.state().velocity_world_m_s.x(), 2.0, 0.02);
  EXPECT_NEAR(quadrotor.state().velocity_world_m_s.y(), -1.0, 0.02);
}

TEST(Quadrotor, HoverThrottleBalancesTheWeightAtThePresentVoltage) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 0.6);
  Autopilot autopilot(kVehicle, kAirframe, {});
  common::Setpoint setpoint{.stamp = {}, .motors_on = true};
  for (int i = 0; i < 300; ++i) {
    setpoint.thrust =
        kVehicle.mass_kg * common::kGravity_m_s2 / (kVehicle.max_thrust_n * quadrotor.battery().thrustShare());
    fly(quadrotor, autopilot, setpoint, 0.01);
  }
  const double speed_after_start = quadrotor.state().velocity_world_m_s.z();
  for (int i = 0; i < 300; ++i) {
    setpoint.thrust =
        kVehicle.mass_kg * common::kGravity_m_s2 / (kVehicle.max_thrust_n * quadrotor.battery().thrustShare());
    fly(quadrotor, autopilot, setpoint, 0.01);
  }
  EXPECT_LT(std::abs(quadrotor.state().velocity_world_m_s.z()), std::abs(speed_after_start) + 1e-3);
  EXPECT_NEAR(quadrotor.state().specific_force_body_m_s2.z(), common::kGravity_m_s2, 0.1);
}

TEST(Quadrotor, TheSameThrottleLiftsLessOnAnEmptierBattery) {
  double force[2];
  for (const double remaining : {1.0, 0.2}) {
    Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), remaining);
    for (int i = 0; i < 500; ++i) quadrotor.step({0.5, 0.5, 0.5, 0.5}, Vector3d::Zero(), kNoFloor, kStep_s);
    double sum = 0.0;
    for (const double thrust : quadrotor.state().thrusts_n) sum += thrust;
    force[remaining < 0.5] = sum;
  }
  EXPECT_LT(force[1], 0.95 * force[0]);
}

TEST(Quadrotor, MotorsFollowWithTheirLag) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 1.0);
  const auto steps = static_cast<int>(kAirframe.motor_lag_s / kStep_s);
  for (int i = 0; i < steps; ++i) quadrotor.step({1, 1, 1, 1}, Vector3d::Zero(), kNoFloor, kStep_s);
  EXPECT_NEAR(quadrotor.state().thrusts_n[0] / (0.25 * kVehicle.max_thrust_n), 1 - std::exp(-1.0), 0.05);
}

TEST(Quadrotor, KeepsItsAngularMomentumInTheAir) {
  common::Pose3 pose = inTheAir();
  Quadrotor quadrotor(kVehicle, withoutDrag(), pose, 1.0);
  // Spun up unevenly, then left to tumble: the angular momentum in the world is constant.
  for (int i = 0; i < 100; ++i) quadrotor.step({0.6, 0.3, 0.2, 0.4}, Vector3d::Zero(), kNoFloor, kStep_s);
  const Vector3d inertia(kAirframe.inertia_xx_kg_m2, kAirframe.inertia_yy_kg_m2, kAirframe.inertia_zz_kg_m2);
  const auto momentum = [&]() -> Vector3d {
    const auto& state = quadrotor.state();
    return state.T_world_body.rotation * inertia.cwiseProduct(state.angular_velocity_body_rad_s);
  };
  for (int i = 0; i < 300; ++i) quadrotor.step({}, Vector3d::Zero(), kNoFloor, kStep_s);  // Motors run down.
  const Vector3d before = momentum();
  ASSERT_GT(before.norm(), 0.01);
  for (int i = 0; i < 1000; ++i) quadrotor.step({}, Vector3d::Zero(), kNoFloor, kStep_s);
  EXPECT_LT((momentum() - before).norm(), 0.02 * before.norm());
}

TEST(Quadrotor, StandsOnItsGear) {
  common::Pose3 pose{Eigen::Quaterniond::Identity(), {0, 0, kAirframe.gear_height_m - Quadrotor::kGearSag_m}};
  Quadrotor quadrotor(kVehicle, kAirframe, pose, 1.0);
  for (int i = 0; i < 2000; ++i) quadrotor.step({}, Vector3d(1, 1, 0), 0.0, kStep_s);
  EXPECT_TRUE(quadrotor.state().standing);
  EXPECT_LT((quadrotor.state().T_world_body.position_m - pose.position_m).norm(), 0.01);
  EXPECT_NEAR(quadrotor.state().specific_force_body_m_s2.z(), common::kGravity_m_s2, 1e-3);
}

TEST(Quadrotor, APushChangesTheSpeedByImpulseOverMass) {
  Quadrotor quadrotor(kVehicle, withoutDrag(), inTheAir(), 1.0);
  quadrotor.push({1.6, -0.8, 0});
  for (int i = 0; i < 200; ++i) quadrotor.step({}, Vector3d::Zero(), kNoFloor, kStep_s);
  EXPECT_NEAR(quadrotor.state().velocity_world_m_s.x(), 1.0, 1e-9);
  EXPECT_NEAR(quadrotor.state().velocity_world_m_s.y(), -0.5, 1e-9);
}

TEST(Battery, SagsUnderLoadAndRunsEmpty) {
  Battery battery(kVehicle, {}, 1.0);
  EXPECT_NEAR(battery.openCircuit_v(), kVehicle.battery_full_v, 0.01);
  battery.draw(200.0, 1.0);
  EXPECT_LT(battery.voltage_v(), battery.openCircuit_v() - 0.2);
  double last = 1.0;
  for (int i = 0; i < 3600; ++i) {
    battery.draw(200.0, 1.0);
    ASSERT_LE(battery.remaining(), last);
    last = battery.remaining();
  }
  EXPECT_EQ(battery.remaining(), 0.0);
  EXPECT_NEAR(battery.openCircuit_v(), kVehicle.battery_empty_v, 0.01);
}

TEST(Autopilot, TracksRollPitchAndYawRateSteps) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 1.0);
  Autopilot autopilot(kVehicle, kAirframe, {});
  common::Setpoint setpoint{.stamp = {}, .motors_on = true, .thrust = 0.56};
  fly(quadrotor, autopilot, setpoint, 1.0);
  setpoint.roll_rad = 0.2;
  setpoint.pitch_rad = -0.15;
  fly(quadrotor, autopilot, setpoint, 0.8);
  common::RollPitchYaw angles = common::rollPitchYaw(quadrotor.state().T_world_body.rotation);
  EXPECT_NEAR(angles.roll_rad, 0.2, 0.01);
  EXPECT_NEAR(angles.pitch_rad, -0.15, 0.01);
  EXPECT_LT(quadrotor.state().velocity_world_m_s.y(), 0.0) << "rolling right goes right";
  EXPECT_LT(quadrotor.state().velocity_world_m_s.x(), 0.0) << "nose up goes back";
  setpoint.roll_rad = setpoint.pitch_rad = 0.0;
  setpoint.yaw_rate_rad_s = 1.0;
  fly(quadrotor, autopilot, setpoint, 1.5);
  angles = common::rollPitchYaw(quadrotor.state().T_world_body.rotation);
  EXPECT_NEAR(angles.roll_rad, 0.0, 0.01);
  EXPECT_NEAR(angles.pitch_rad, 0.0, 0.01);
  EXPECT_NEAR(quadrotor.state().angular_velocity_body_rad_s.z(), 1.0, 0.05);
}

TEST(Autopilot, AStepInRollOvershootsLittleAndSettles) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 1.0);
  Autopilot autopilot(kVehicle, kAirframe, {});
  common::Setpoint setpoint{.stamp = {}, .motors_on = true, .roll_rad = 0.2, .thrust = 0.56};
  double greatest = 0.0, reached_s = 0.0;
  for (int i = 1; i <= 100; ++i) {
    fly(quadrotor, autopilot, setpoint, 0.01);
    const double roll = common::rollPitchYaw(quadrotor.state().T_world_body.rotation).roll_rad;
    greatest = std::max(greatest, roll);
    if (reached_s == 0.0 && roll > 0.18) reached_s = 0.01 * i;
  }
  EXPECT_LT(greatest, 0.2 * 1.2);
  EXPECT_GT(reached_s, 0.05);
  EXPECT_LT(reached_s, 0.4);
}

TEST(Autopilot, LimitsCommandsAndIgnoresNan) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 1.0);
  Autopilot autopilot(kVehicle, kAirframe, {});
  fly(quadrotor, autopilot, {.stamp = {}, .motors_on = true, .roll_rad = 3.0, .pitch_rad = NAN, .thrust = 0.56}, 1.0);
  const auto angles = common::rollPitchYaw(quadrotor.state().T_world_body.rotation);
  EXPECT_NEAR(angles.roll_rad, kVehicle.max_tilt_deg * M_PI / 180, 0.02);
  EXPECT_NEAR(angles.pitch_rad, 0.0, 0.02);
}

TEST(Autopilot, LevelsAndDescendsWhenTheLinkIsLost) {
  Quadrotor quadrotor(kVehicle, kAirframe, inTheAir(), 0.7);
  Autopilot autopilot(kVehicle, kAirframe, {});
  autopilot.receive({.stamp = {}, .motors_on = true, .roll_rad = 0.2, .thrust = 0.62}, common::Time());
  std::array<double, 4> throttles{};
  for (int step = 0; step < 5000; ++step) {
    const common::Time now = common::Time::fromSeconds(step * kStep_s);
    if (step % 2 == 0) throttles = autopilot.tick(now, perfect(quadrotor), 2 * kStep_s);
    quadrotor.step(throttles, Vector3d::Zero(), kNoFloor, kStep_s);
    if (step == 490) {
      EXPECT_FALSE(autopilot.linkLost(now));
    }
  }
  EXPECT_NEAR(common::rollPitchYaw(quadrotor.state().T_world_body.rotation).roll_rad, 0.0, 0.02);
  EXPECT_LT(quadrotor.state().velocity_world_m_s.z(), -0.3);
  EXPECT_GT(quadrotor.state().velocity_world_m_s.z(), -4.0);
}

TEST(InertialUnit, TheAttitudeIsAccurateToADegreeWhileYawDrifts) {
  InertialUnit unit({}, kVehicle, 5);
  QuadrotorState state;
  double sum = 0.0, least_yaw = 10, greatest_yaw = -10;
  constexpr int kTicks = 60'000;
  for (int tick = 0; tick < kTicks; ++tick) {
    const auto measured = unit.attitude(static_cast<std::uint64_t>(tick), state, 0.002);
    const auto angles = common::rollPitchYaw(measured.rotation_ahrs_body);
    sum += angles.roll_rad * angles.roll_rad + angles.pitch_rad * angles.pitch_rad;
    least_yaw = std::min(least_yaw, angles.yaw_rad);
    greatest_yaw = std::max(greatest_yaw, angles.yaw_rad);
  }
  const double rms_deg = std::sqrt(sum / (2 * kTicks)) * 180 / M_PI;
  EXPECT_GT(rms_deg, 0.2);
  EXPECT_LT(rms_deg, 1.5);
  EXPECT_GT(greatest_yaw - least_yaw, 0.005);
}

TEST(InertialUnit, ASampleIsTheMeanOverItsPeriodPlusNoiseAndBias) {
  ImuConfig quiet;
  quiet.gyro_noise_rad_s = quiet.gyro_bias_rad_s = quiet.accel_noise_m_s2 = quiet.accel_bias_m_s2 = 0.0;
  InertialUnit unit(quiet, kVehicle, 1);
  QuadrotorState state;
  for (int i = 0; i < 5; ++i) {
    state.specific_force_body_m_s2 = {static_cast<double>(i), 0, 9.81};
    unit.feel(state);
  }
  EXPECT_NEAR(unit.sample(1, state).specific_force_body_m_s2.x(), 2.0, 1e-12);

  InertialUnit noisy({}, kVehicle, 1);
  double sum = 0.0, squares = 0.0;
  state = {};
  for (std::uint64_t frame = 1; frame <= 4000; ++frame) {
    noisy.feel(state);
    const double x = noisy.sample(frame, state).specific_force_body_m_s2.x();
    sum += x;
    squares += x * x;
  }
  const double mean = sum / 4000;
  EXPECT_NEAR(std::sqrt(squares / 4000 - mean * mean), ImuConfig{}.accel_noise_m_s2, 0.005);
  EXPECT_GT(std::abs(mean), 1e-3) << "the bias stays";
}

TEST(Quadrotor, GyroscopesMeasureNoTurnWhileTheFloorPreventsIt) {
  Quadrotor quadrotor(kVehicle, kAirframe, {Eigen::Quaterniond::Identity(), {0, 0, kAirframe.gear_height_m}}, 1.0);
  Eigen::Quaterniond felt = Eigen::Quaterniond::Identity();
  for (int i = 0; i < 2000; ++i) {
    quadrotor.step({0.25, 0.22, 0.22, 0.25}, Eigen::Vector3d::Zero(), 0.0, 0.001);
    felt = felt * common::expSO3(0.001 * quadrotor.state().angular_velocity_body_rad_s);
  }
  EXPECT_TRUE(quadrotor.state().standing);
  EXPECT_LT(quadrotor.state().angular_velocity_body_rad_s.head<2>().norm(), 1e-3);
  EXPECT_LT(felt.angularDistance(quadrotor.state().T_world_body.rotation), 1e-3);
  const auto angles = common::rollPitchYaw(quadrotor.state().T_world_body.rotation);
  EXPECT_LT(std::abs(angles.roll_rad) + std::abs(angles.pitch_rad), 0.01) << "the gear holds it level";
}

TEST(Wind, GustsHaveTheirMeanAndSpread) {
  Wind wind({.mean_x_m_s = 1.0, .mean_y_m_s = -0.5, .gust_m_s = 0.4, .gust_time_s = 0.5}, 3);
  double sum = 0.0, squares = 0.0;
  constexpr int kTicks = 100'000;
  for (int tick = 0; tick < kTicks; ++tick) {
    wind.step(static_cast<std::uint64_t>(tick), 0.01);
    sum += wind.velocity_world_m_s().x();
    squares += wind.velocity_world_m_s().x() * wind.velocity_world_m_s().x();
  }
  const double mean = sum / kTicks;
  EXPECT_NEAR(mean, 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / kTicks - mean * mean), 0.4, 0.04);
}

}  // namespace
}  // namespace swiftlet::simulation
