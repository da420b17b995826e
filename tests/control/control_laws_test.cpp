// Each law against its equation, and what the controllers share.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config_check.hpp"
#include "common/gravity.hpp"
#include "control/control_errors.hpp"
#include "tests/control/controller_fixtures.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::control {
namespace {

using test_support::ProblemIs;
using testing::ElementsAre;
using testing::IsEmpty;

/// A vehicle that rests at the origin, 1 m up, on a full battery.
struct Bench {
  common::VehicleConfig vehicle;
  ThrustModel thrust{{}, vehicle};
  ControlInput input;

  Bench() {
    input.state.T_odom_body.position_m = {0, 0, 1};
    input.reference.position_odom_m = {0, 0, 1};
    thrust.setLearning(false);
    thrust.observeVoltage(vehicle.battery_full_v, 0.01);
  }
  double hover() const { return vehicle.mass_kg * common::kGravity_m_s2 / vehicle.max_thrust_n; }
};

TEST(VoltagePid, IsEquations3To5) {
  Bench bench;
  bench.input.reference.position_odom_m = {0.1, -0.2, 1.05};
  bench.input.reference.yaw_odom_rad = 0.1;
  bench.input.state.velocity_odom_m_s = {0.05, 0.0, -0.1};
  VoltagePid pid({.horizontal_p_deg_m = 10,
                  .horizontal_i_deg_m_s = 0,
                  .horizontal_d_deg_s_m = 20,
                  .vertical_p_1_m = 0.5,
                  .vertical_i_1_m_s = 0,
                  .vertical_d_s_m = 0.3,
                  .yaw_p_1_s = 2.0},
                 bench.vehicle, nullptr);
  const common::Setpoint setpoint = pid.tick(bench.input, bench.thrust);
  EXPECT_NEAR(setpoint.pitch_rad / common::kRadPerDeg, 10 * 0.1 - 20 * 0.05, 1e-9);
  EXPECT_NEAR(setpoint.roll_rad / common::kRadPerDeg, -(10 * -0.2), 1e-9);
  EXPECT_NEAR(setpoint.yaw_rate_rad_s, 2.0 * 0.1, 1e-9);
  EXPECT_NEAR(setpoint.thrust, bench.hover() + 0.5 * 0.05 + 0.3 * 0.1, 1e-9);
}

TEST(VoltagePid, ItsOffsetFollowsTheVoltage) {
  Bench bench;
  VoltagePid pid({}, bench.vehicle, nullptr);
  const double full = pid.tick(bench.input, bench.thrust).thrust;
  for (int i = 0; i < 1000; ++i) bench.thrust.observeVoltage(11.0, 0.01);
  const double tired = pid.tick(bench.input, bench.thrust).thrust;
  EXPECT_NEAR(tired / full, std::pow(12.6 / 11.0, 2), 0.01);
}

TEST(VoltagePid, CommandsWhatTheBenchSaysForTheAngle) {
  Bench bench;
  bench.input.reference.position_odom_m.x() = 0.2;
  VehicleModel model = sheetModel();
  model.bench_pitch = {{-20, -10}, {0, 1}, {20, 11}};
  VoltagePid pid({.horizontal_p_deg_m = 10, .horizontal_i_deg_m_s = 0}, bench.vehicle, &model);
  EXPECT_NEAR(pid.tick(bench.input, bench.thrust).pitch_rad / common::kRadPerDeg, (2.0 - 1.0) * 2.0, 1e-9);
}

TEST(CascadedPid, IsAPidOfThePositionThatTiltsTheThrust) {
  Bench bench;
  bench.input.reference.position_odom_m = {0.1, 0.0, 1.0};
  bench.input.reference.velocity_odom_m_s = {0.2, 0.0, 0.0};
  CascadedPid pid({.horizontal_p_1_s2 = 3, .horizontal_i_1_s3 = 0, .horizontal_d_1_s = 2}, bench.vehicle);
  const common::Setpoint setpoint = pid.tick(bench.input, bench.thrust);
  EXPECT_NEAR(std::tan(setpoint.pitch_rad), (3 * 0.1 + 2 * 0.2) / common::kGravity_m_s2, 1e-9);
  EXPECT_NEAR(setpoint.thrust, bench.hover() / std::cos(setpoint.pitch_rad), 1e-9);
}

// For x'' = u and the weights q, q_v and r the continuous Riccati equation leaves K = (sqrt(q / r), sqrt(q_v / r + 2
// sqrt(q / r))); at 100 Hz the discrete one is within a few percent.
TEST(Lqr, HasTheGainsOfTheRiccatiEquation) {
  Lqr::Config config;
  config.horizontal_integral_m_s = 0.0;
  config.horizontal_position_m = 0.5;
  config.horizontal_speed_m_s = 1.0;
  config.acceleration_m_s2 = 1.0;
  VehicleModel model = sheetModel();
  model.forward.lag_s = model.left.lag_s = 0.0;
  const Lqr lqr(config, {}, model);
  EXPECT_NEAR(lqr.gains()[0][0], 0.0, 1e-12);
  EXPECT_NEAR(lqr.gains()[0][1], 2.0, 0.05);
  EXPECT_NEAR(lqr.gains()[0][2], std::sqrt(1.0 + 2.0 * 2.0), 0.05);
  EXPECT_NEAR(lqr.gains()[0][3], 0.0, 1e-12);
  model.forward.damping_1_s = model.left.damping_1_s = -1.0;
  EXPECT_NEAR(Lqr(config, {}, model).gains()[0][2], -1.0 + std::sqrt(1.0 + 1.0 + 4.0), 0.05);
}

// A dense oracle: the cost of a simulated flight with these gains is lower than with any gain a little off.
TEST(Lqr, ItsGainsAreThoseOfTheLeastCost) {
  AxisMatrix A = AxisMatrix::Identity();
  A(0, 1) = A(1, 2) = A(2, 3) = 0.01;
  A(3, 3) = std::exp(-0.05);
  const AxisVector B(0, 0, 0, 1.0 - std::exp(-0.05));
  const AxisMatrix Q = AxisVector(2.0, 8.0, 2.0, 0.0).asDiagonal();
  const auto cost = [&](const Eigen::RowVector4d& K) {
    double sum = 0.0;
    AxisVector x(0.1, 0.5, -0.2, 0.3);
    for (int i = 0; i < 4000; ++i) {
      const double u = -(K * x)(0);
      sum += x.dot(Q * x) + u * u;
      x = A * x + B * u;
    }
    return sum;
  };
  const LqrGains gains = lqrGains(A, B, Q, 1.0);
  ASSERT_TRUE(gains.converged);
  const double least = cost(gains.K);
  for (int axis = 0; axis < 4; ++axis)
    for (const double share : {0.97, 1.03}) {
      Eigen::RowVector4d off = gains.K;
      off[axis] *= share;
      EXPECT_GT(cost(off), least) << axis << " times " << share;
    }
}

TEST(Lqr, WithoutGainsThereIsNoController) {
  const VehicleModel model = sheetModel();
  EXPECT_THAT(Lqr::problemsOf({}, model), IsEmpty());
  ControllerChoiceConfig choice;
  choice.lqr.vertical_integral_m_s = 0.0;
  choice.lqr.vertical_position_m = 1e5;  // A mode of minutes.
  choice.lqr.vertical_speed_m_s = 0.0;
  EXPECT_THAT(Lqr::problemsOf(choice.lqr, model), ElementsAre(ProblemIs("lqr.no-gains", "up")));
  EXPECT_EQ(makeController(ControllerKind::kLqr, choice, {}, {}, &model), nullptr);
}

TEST(Lqr, SolvesTheModelForItsCommands) {
  Bench bench;
  VehicleModel model = sheetModel();
  model.forward.gain = 8.0;
  model.forward.offset = 0.4;
  model.up.gain = 20.0;
  Lqr::Config config;
  config.vertical_integral_m_s = 0.0;
  Lqr lqr(config, bench.vehicle, model);
  const common::Setpoint setpoint = lqr.tick(bench.input, bench.thrust);
  EXPECT_NEAR(setpoint.pitch_rad, -0.4 / 8.0, 1e-9);
  EXPECT_NEAR(setpoint.thrust, bench.hover() * common::kGravity_m_s2 / 20.0, 1e-9);
}

TEST(SlidingMode, ReachesTheSurfaceAndStaysThere) {
  // A double integrator with a constant disturbance that the accelerometer does not see.
  Bench bench;
  SlidingMode controller({}, bench.vehicle);
  double position_m = 0.3, velocity_m_s = 0.0;
  for (int i = 0; i < 3000; ++i) {
    bench.input.state.T_odom_body.position_m.x() = position_m;
    bench.input.state.velocity_odom_m_s.x() = velocity_m_s;
    const double pitch_rad = controller.tick(bench.input, bench.thrust).pitch_rad;
    velocity_m_s += 0.01 * (common::kGravity_m_s2 * std::tan(pitch_rad) - 0.5);
    position_m += 0.01 * velocity_m_s;
  }
  EXPECT_NEAR(position_m, 0.0, 1e-3);
  EXPECT_NEAR(controller.trim_odom_m_s2(bench.thrust).x(), 0.5, 0.01);
}

// u0 = Kp e + Kd de/dt, sigma = de/dt - de/dt(0) + int(u0), u = u0 + rho sat(sigma / boundary) - d (Utkin and Shi 1996;
// Tomic 2012, "Action"), for a vehicle held by hand, whose errors stay.
TEST(SlidingMode, IsItsLawStepByStep) {
  Bench bench;
  SlidingMode controller({.horizontal_p_1_s2 = 2.0,
                          .horizontal_d_1_s = 1.5,
                          .vertical_p_1_s2 = 0.0,
                          .vertical_d_1_s = 0.0,
                          .switching_m_s2 = 0.8,
                          .boundary_m_s = 0.5},
                         bench.vehicle);
  bench.input.state.T_odom_body.position_m.x() = -0.1;
  bench.input.state.velocity_odom_m_s.x() = 0.05;
  const double nominal_m_s2 = 2.0 * 0.1 + 1.5 * -0.05;
  double integral_m_s = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double wanted_m_s2 = nominal_m_s2 + 0.8 * std::clamp(integral_m_s / 0.5, -1.0, 1.0);
    ASSERT_NEAR(std::tan(controller.tick(bench.input, bench.thrust).pitch_rad), wanted_m_s2 / common::kGravity_m_s2,
                1e-9)
        << "step " << i;
    integral_m_s = std::min(integral_m_s + 0.01 * nominal_m_s2, 0.5);
  }
  EXPECT_NEAR(integral_m_s, 0.5, 1e-12) << "the boundary was reached, and the saturation with it";
}

// Time-delay estimation: d follows, behind its filter, what is measured less what the commands explain.
TEST(SlidingMode, ItsDisturbanceIsWhatTheCommandsDoNotExplain) {
  Bench bench;
  bench.input.acceleration_odom_m_s2 = Eigen::Vector3d(-0.3, 0.0, 0.0);
  SlidingMode controller(
      {.horizontal_p_1_s2 = 0.0, .horizontal_d_1_s = 0.0, .disturbance_filter_s = 0.5, .attitude_lag_s = 0.2},
      bench.vehicle);
  double disturbance_m_s2 = 0.0, taken_up_m_s2 = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double given_m_s2 = -disturbance_m_s2;
    ASSERT_NEAR(std::tan(controller.tick(bench.input, bench.thrust).pitch_rad), given_m_s2 / common::kGravity_m_s2,
                1e-9)
        << "step " << i;
    taken_up_m_s2 += (1.0 - std::exp(-0.01 / 0.2)) * (given_m_s2 - taken_up_m_s2);
    disturbance_m_s2 += (1.0 - std::exp(-0.01 / 0.5)) * (-0.3 - taken_up_m_s2 - disturbance_m_s2);
  }
  EXPECT_LT(disturbance_m_s2, -0.3);
}

// In a steady wind the accelerometer measures nothing, and the trim that was taken over is what holds the vehicle.
TEST(SlidingMode, ATrimThatWasTakenOverStaysInASteadyWind) {
  Bench bench;
  bench.input.acceleration_odom_m_s2 = Eigen::Vector3d::Zero();
  SlidingMode controller({}, bench.vehicle);
  const Eigen::Vector3d trim_m_s2(0.8, -0.5, 0.0);
  controller.setTrim(trim_m_s2, bench.thrust);
  for (int i = 0; i < 100; ++i) {
    (void)controller.tick(bench.input, bench.thrust);
    ASSERT_LT((controller.trim_odom_m_s2(bench.thrust) - trim_m_s2).norm(), 0.01 * trim_m_s2.norm())
        << "after " << 0.01 * (i + 1) << " s";
  }
}

// a = Kp e + Ki int(e) + Kd de/dt, with an integral that stops at its limit.
TEST(CascadedPid, ItsIntegralGrowsWithTheErrorUpToItsLimit) {
  Bench bench;
  bench.input.reference.position_odom_m = {0.1, 0.0, 1.0};
  CascadedPid pid({.horizontal_p_1_s2 = 0.0, .horizontal_i_1_s3 = 10.0, .horizontal_d_1_s = 0.0}, bench.vehicle);
  for (int i = 0; i < 300; ++i) {
    const double integral_m_s2 = std::min(10.0 * 0.1 * 0.01 * i, kMaxIntegral_m_s2);
    ASSERT_NEAR(std::tan(pid.tick(bench.input, bench.thrust).pitch_rad), integral_m_s2 / common::kGravity_m_s2, 1e-9)
        << "step " << i;
  }
}

TEST(CascadedPid, ItsHeadingTurnsRollAndPitch) {
  Bench bench;
  bench.input.state.T_odom_body.rotation = common::quaternionFrom({0.0, 0.0, 0.5 * std::numbers::pi});
  bench.input.reference.yaw_odom_rad = 0.5 * std::numbers::pi + 0.1;
  bench.input.reference.position_odom_m = {0.1, 0.0, 1.0};
  CascadedPid pid({.horizontal_p_1_s2 = 3, .horizontal_i_1_s3 = 0, .horizontal_d_1_s = 0, .yaw_p_1_s = 1.5},
                  bench.vehicle);
  const common::Setpoint setpoint = pid.tick(bench.input, bench.thrust);
  // What lies along x of odom is to the right of a vehicle that looks along y.
  EXPECT_NEAR(setpoint.pitch_rad, 0.0, 1e-9);
  EXPECT_NEAR(std::tan(setpoint.roll_rad), 3 * 0.1 / common::kGravity_m_s2, 1e-3);
  EXPECT_NEAR(setpoint.yaw_rate_rad_s, 1.5 * 0.1, 1e-9);
}

// For the single integrator of the yaw the Riccati equation leaves K = sqrt(q / r), the yaw rate over the yaw of
// Bryson's rule; equation 1 is solved for the command.
TEST(Lqr, TurnsByItsYawGainThroughTheModelOfTheYaw) {
  Bench bench;
  bench.input.reference.yaw_odom_rad = 0.1;
  VehicleModel model = sheetModel();
  model.yaw.gain = 0.8;
  model.yaw.offset = 0.02;
  Lqr::Config config;
  config.yaw_rad = 0.25;
  config.yaw_rate_rad_s = 0.5;
  Lqr lqr(config, bench.vehicle, model);
  EXPECT_NEAR(lqr.tick(bench.input, bench.thrust).yaw_rate_rad_s, (0.5 / 0.25 * 0.1 - 0.02) / 0.8, 1e-9);
  bench.input.on_ground = true;
  EXPECT_EQ(lqr.tick(bench.input, bench.thrust).yaw_rate_rad_s, 0.0);
}

TEST(Controllers, ATrimIsTakenOverWhole) {
  const VehicleModel model = sheetModel();
  Bench bench;
  const Eigen::Vector3d trim_m_s2(0.4, -0.3, 0.2);
  for (int kind = 0; kind < kControllerKinds; ++kind) {
    const auto controller = makeController(static_cast<ControllerKind>(kind), {}, {}, bench.vehicle, &model);
    controller->setTrim(trim_m_s2, bench.thrust);
    EXPECT_LT((controller->trim_odom_m_s2(bench.thrust) - trim_m_s2).norm(), 1e-9)
        << toString(static_cast<ControllerKind>(kind));
    const common::Setpoint setpoint = controller->tick(bench.input, bench.thrust);
    EXPECT_NEAR(setpoint.pitch_rad, 0.4 / common::kGravity_m_s2, 0.005) << toString(static_cast<ControllerKind>(kind));
    EXPECT_NEAR(setpoint.thrust, bench.hover() * (1.0 + 0.2 / common::kGravity_m_s2), 0.003)
        << toString(static_cast<ControllerKind>(kind));
  }
}

TEST(ControlErrors, UseOnlyWhatMayBeUsed) {
  ControlInput input;
  input.state.velocity_odom_m_s = {1, 2, 3};
  input.reference.position_odom_m = {5, 0, 5};
  input.reference.velocity_odom_m_s = {4, 4, 4};
  input.reference.acceleration_odom_m_s2 = {1, 1, 0};
  EXPECT_NEAR(errorsOf(input).position_odom_m.x(), kMaxPositionError_m, 1e-12);
  EXPECT_NEAR(errorsOf(input).velocity_odom_m_s.x(), 3.0, 1e-12);
  input.horizontal = Horizontal::kVelocity;
  EXPECT_EQ(errorsOf(input).position_odom_m.x(), 0.0);
  EXPECT_EQ(errorsOf(input).velocity_odom_m_s.x(), 3.0);
  EXPECT_EQ(errorsOf(input).acceleration_odom_m_s2.x(), 0.0);
  input.horizontal = Horizontal::kLevel;
  EXPECT_EQ(errorsOf(input).velocity_odom_m_s.x(), 0.0);
  EXPECT_EQ(errorsOf(input).velocity_odom_m_s.z(), 1.0);
}

std::vector<common::Problem> unfit(const VehicleModel& model) { return model.problemsFor({}); }

TEST(VehicleModel, SaysWhyItDoesNotFit) {
  VehicleModel model = sheetModel();
  EXPECT_THAT(unfit(model), IsEmpty());
  model.vehicle = "pelican";
  EXPECT_THAT(unfit(model), ElementsAre(ProblemIs("vehicle-model.other-vehicle", "vehicle", "`pelican`")));
  model = sheetModel();
  model.thrust = {{11.0, 0.7, 10.0}, {12.0, 0.6, 10.0}};
  EXPECT_THAT(unfit(model), IsEmpty());
  model.battery_full_v = 16.8;
  EXPECT_THAT(unfit(model), ElementsAre(ProblemIs("vehicle-model.other-battery", "battery_full_v", "16.8 V")));
  model.thrust = {{12.0, 0.6, 10.0}, {11.0, 0.5, 10.0}};
  EXPECT_THAT(common::config::problemsOf(model), ElementsAre(ProblemIs("thrust.voltage-falls", "thrust")));
}

TEST(VehicleModel, TheRowsOfItsThrustAreOfTheVehicle) {
  VehicleModel model = sheetModel();
  model.thrust = {{12.0, 0.6, 10.0}, {21.0, 0.5, 10.0}};
  EXPECT_THAT(unfit(model), ElementsAre(ProblemIs("thrust.other-battery", "thrust[1].voltage_v", "9.18 to 12.60 V")));
  model.thrust = {{11.0, 5.0, 10.0}, {12.0, 5.0, 10.0}};
  EXPECT_THAT(unfit(model),
              ElementsAre(ProblemIs("thrust.too-far-from-sheet", "thrust[0].hover_command", "0.294 to 1.177")));
}

TEST(VehicleModel, AnAxisIsOneThatAMultirotorCanHave) {
  const auto problems = [](AxisModel VehicleModel::*axis, double AxisModel::*value, double wrong) {
    VehicleModel model = sheetModel();
    (model.*axis).*value = wrong;
    return common::config::problemsOf(model);
  };
  EXPECT_THAT(common::config::problemsOf(sheetModel()), IsEmpty());
  const auto gain = &AxisModel::gain, offset = &AxisModel::offset;
  EXPECT_THAT(problems(&VehicleModel::forward, gain, -8.41),
              ElementsAre(ProblemIs("config.not-within", "forward.gain", "-8.41 is not within 3 and 30")));
  EXPECT_THAT(problems(&VehicleModel::forward, offset, 1e6),
              ElementsAre(ProblemIs("config.not-within", "forward.offset")));
  EXPECT_THAT(problems(&VehicleModel::left, gain, 9.0),
              ElementsAre(ProblemIs("config.not-within", "left.gain", "-30 and -3")));
  EXPECT_THAT(problems(&VehicleModel::up, gain, -9.8), ElementsAre(ProblemIs("config.not-within", "up.gain", "-9.8")));
  EXPECT_THAT(problems(&VehicleModel::up, gain, 1e-300),
              ElementsAre(ProblemIs("config.not-within", "up.gain", "1e-300")));
  EXPECT_THAT(problems(&VehicleModel::up, gain, 1e300),
              ElementsAre(ProblemIs("config.not-within", "up.gain", "1e+300")));
  EXPECT_THAT(problems(&VehicleModel::up, offset, -20.0), ElementsAre(ProblemIs("axis.offset", "up.offset")));
  EXPECT_THAT(problems(&VehicleModel::yaw, gain, -1.0),
              ElementsAre(ProblemIs("config.not-within", "yaw.gain", "0.2 and 5")));
  EXPECT_THAT(problems(&VehicleModel::left, &AxisModel::gain_interval, 10.0),
              ElementsAre(ProblemIs("axis.interval", "left.gain_interval")));
  EXPECT_THAT(problems(&VehicleModel::left, gain, 0.0), IsEmpty()) << "one that was not identified";
}

TEST(VehicleModel, TheRowsOfABenchAreAMappingOfAngles) {
  const auto problems = [](const std::vector<CommandAngle>& rows) {
    VehicleModel model = sheetModel();
    model.bench_roll = rows;
    return common::config::problemsOf(model);
  };
  EXPECT_THAT(problems({{-20, -19}, {0, 0.5}, {20, 21}}), IsEmpty());
  EXPECT_THAT(problems({{0, 0}, {10, 9}, {20, 8}}), ElementsAre(ProblemIs("bench.falls", "bench_roll[2]")));
  EXPECT_THAT(problems({{0, 0}}), ElementsAre(ProblemIs("bench.one-row", "bench_roll")));
  EXPECT_THAT(problems({{-180, 59}, {180, 60}}),
              ElementsAre(ProblemIs("bench.slope", "bench_roll[1].angle_deg", "0.0028 deg")));
  EXPECT_THAT(problems({{5, 5}, {20, 20}}), ElementsAre(ProblemIs("bench.one-side", "bench_roll")));
  EXPECT_THAT(problems({{-20, 0}, {20, 40}}), ElementsAre(ProblemIs("bench.not-level", "bench_roll", "20.0 deg")));
  VehicleModel narrow = sheetModel();
  narrow.bench_pitch = {{-5, -5}, {20, 20}};
  EXPECT_THAT(unfit(narrow), ElementsAre(ProblemIs("bench.too-short", "bench_pitch", "-5 to 20 deg")));
}

}  // namespace
}  // namespace swiftlet::control
