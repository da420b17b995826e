// The attitude loop of the simulated autopilot keeps 6 dB for every vehicle that a nature draws: its gain margin,
// computed from the model, and the model checked against the simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "common/gravity.hpp"
#include "quadrotor_fixtures.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::simulation {
namespace {

constexpr double kLoop_s = 0.002;  ///< The autopilot's period.

struct AttitudeLoop {
  AutopilotConfig autopilot;
  double motor_lag_s;
  double thrust_gain;  ///< Change of the thrust per change of throttle over what the autopilot believes.

  /// The loop, broken at the torque: (g + k / s) (1 + a / s) / s behind a motor of first order and the dead time of a
  /// sampled loop, which is half a period of the hold and one of the computation.
  std::complex<double> at(double rad_s) const {
    const std::complex<double> s(0.0, rad_s);
    const double dead_s = 1.5 * kLoop_s;
    return thrust_gain * (autopilot.rate_gain_1_s + autopilot.rate_integral_1_s2 / s) *
           (1.0 + autopilot.attitude_gain_1_s / s) / s / (1.0 + motor_lag_s * s) * std::exp(-dead_s * s);
  }

  struct Margins {
    double up_db = std::numeric_limits<double>::infinity();    ///< So much more gain, and it is unstable.
    double down_db = std::numeric_limits<double>::infinity();  ///< So much less; the integrals make it so.
  };
  Margins margins() const {
    Margins margins;
    for (double rad_s = 0.2; rad_s < 1000.0; rad_s *= 1.002) {
      const std::complex<double> here = at(rad_s), next = at(1.002 * rad_s);
      if (here.real() >= 0.0 || std::signbit(here.imag()) == std::signbit(next.imag())) continue;
      const double db = -20.0 * std::log10(std::abs(here));
      (db > 0.0 ? margins.up_db : margins.down_db) = std::min(std::abs(db), db > 0.0 ? margins.up_db : margins.down_db);
    }
    return margins;
  }
};

/// At the hover of a drawn vehicle.
AttitudeLoop loopOf(const Scenario& drawn) {
  const QuadrotorConfig& airframe = drawn.quadrotor;
  const double weight = 1.0 / thrustOverWeight(drawn.vehicle, airframe, drawn.battery_remaining, 1.0);
  const double exponent = airframe.throttle_exponent, throttle = std::pow(weight, 1.0 / exponent);
  const double hover_n = airframe.mass_share * drawn.vehicle.mass_kg * common::kGravity_m_s2;
  return {drawn.autopilot, airframe.motor_lag_s, exponent * hover_n / throttle / drawn.vehicle.max_thrust_n};
}

TEST(AttitudeMargin, EveryDrawnVehicleKeepsSixDecibels) {
  for (const std::string name : {"calm", "real", "harsh"}) {
    const Nature nature = Nature::load(SWIFTLET_SOURCE_DIR "/config/nature/" + name + ".yaml");
    AttitudeLoop::Margins least;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      const AttitudeLoop::Margins margins = loopOf(nature.drawn({}, seed)).margins();
      least.up_db = std::min(least.up_db, margins.up_db);
      least.down_db = std::min(least.down_db, margins.down_db);
    }
    std::printf("%s: least margin of the attitude loop %.1f dB up, %.1f dB down\n", name.c_str(), least.up_db,
                least.down_db);
    EXPECT_GE(least.up_db, 6.0) << name;
    EXPECT_GE(least.down_db, 6.0) << name;
    EXPECT_LT(least.up_db, 60.0) << "a margin was found";
  }
}

/// Roll, 4 s after a tilt of 3 deg, of a vehicle in free air whose gains are `factor` times those of the loop.
double rollLeft_rad(const AttitudeLoop& loop, double factor) {
  QuadrotorConfig airframe = withoutDrag();
  airframe.motor_lag_s = loop.motor_lag_s;
  AutopilotConfig config = loop.autopilot;
  config.rate_gain_1_s *= factor;
  config.rate_integral_1_s2 *= factor;
  Autopilot autopilot(kVehicle, airframe, config);
  Quadrotor quadrotor(kVehicle, airframe,
                      {Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX())), {0, 0, 10}}, 1.0);
  std::array<double, 4> throttles{}, computed{};
  double greatest_rad = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    const common::Time now = common::Time::fromSeconds(1e-3 * tick);
    if (tick % 2 == 0) {
      autopilot.receive({.stamp = now, .motors_on = true, .thrust = 0.56}, now);
      throttles = computed;  // It acts a period after its measurement.
      const QuadrotorState& state = quadrotor.state();
      computed = autopilot.tick(now, {state.T_world_body.rotation, state.angular_velocity_body_rad_s, 12.6}, kLoop_s);
    }
    quadrotor.step(throttles, Eigen::Vector3d::Zero(), kNoFloor, 1e-3);
    if (tick > 3500)
      greatest_rad =
          std::max(greatest_rad, std::abs(common::rollPitchYaw(quadrotor.state().T_world_body.rotation).roll_rad));
  }
  return greatest_rad;
}

TEST(AttitudeMargin, TheModelPredictsWhereTheSimulatorBeginsToOscillate) {
  const AttitudeLoop loop{AutopilotConfig{}, 0.06, 1.0};
  const double factor = std::pow(10.0, loop.margins().up_db / 20.0);
  const double sound_rad = rollLeft_rad(loop, 0.7 * factor), swaying_rad = rollLeft_rad(loop, 1.4 * factor);
  EXPECT_LT(sound_rad, 1e-3);
  EXPECT_GT(swaying_rad, 3e-3) << "as far as the motors' limits let it";
}

}  // namespace
}  // namespace swiftlet::simulation
