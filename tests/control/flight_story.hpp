// Stories of whole flights: the flight controller in closed loop with the small model.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "control/flight_controller.hpp"
#include "tests/control/quadrotor_model.hpp"

namespace swiftlet::control {

using common::FlightMode;
using common::FlightState;

struct Flight {
  QuadrotorModel model;
  common::EventLog log;
  FlightController controller{FlightController::Config{}, common::VehicleConfig{}, log};
  common::Pose2 T_map_odom;
  bool horizontal_valid = true, vertical_valid = true, diverged = false, mirror = true;
  std::string inertial_fault;
  bool inertial_contradicted = false;
  double greatest_tilt_rad = 0;
  /// Without measurements of the height, inertial samples carry it and gather the error of this bias.
  bool vertical_measured = true;
  double carried_bias_m_s2 = 0.0;
  double carried_s = 0.0;
  bool accelerometer = true;
  double unseen_table_m = 0.0;  ///< The floor is a table of glass, so much higher than what the beams see.
  bool knows_horizon = false;   ///< By how much the autopilot's horizon is wrong.
  /// The raw heights arrive with this period, and this late.
  common::Duration height_period = common::Duration::fromSeconds(0.03), height_delay;
  std::deque<RawHeight> heights_under_way;
  std::optional<double> pilot_climbs_m_s;  ///< While it is set a pilot flies, level and with this climb.
  common::RandomStream accelerometer_noise{1, "accelerometer"};

  Flight() = default;
  explicit Flight(const FlightController::Config& config, const VehicleModel* identified = nullptr,
                  const ThrustPoints& learned = {})
      : controller(config, common::VehicleConfig{}, log, identified, learned) {}

  void tick() {
    FlightTick tick;
    tick.now = model.now;
    tick.state = model.estimate();
    tick.state.T_map_odom = T_map_odom;
    tick.state.height_above_ground_m += unseen_table_m;
    tick.state.horizontal_valid = horizontal_valid && !diverged;
    tick.state.vertical_valid = vertical_valid && !diverged;
    if (!vertical_measured || !vertical_valid) {
      carried_s += 0.01;
      tick.state.vertical_supported = model.now - common::Duration::fromSeconds(carried_s);
      tick.state.velocity_odom_m_s.z() += carried_bias_m_s2 * carried_s;
      const double error_m = 0.5 * carried_bias_m_s2 * carried_s * carried_s;
      tick.state.T_odom_body.position_m.z() += error_m;
      tick.state.height_above_ground_m += error_m;
      tick.state.position_covariance_m2(2, 2) = error_m * error_m;
    }
    tick.fusion_diverged = diverged;
    tick.inertial_fault = inertial_fault;
    tick.inertial_contradicted = inertial_contradicted;
    if (diverged) tick.state.velocity_odom_m_s.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (model.now.nanoseconds() % height_period.nanoseconds() == 0 && mirror)
      heights_under_way.push_back(
          {model.now, model.position_m.z() - model.floor_m + unseen_table_m + model.random.gaussian(0.01)});
    if (!heights_under_way.empty() && model.now - heights_under_way.front().stamp >= height_delay) {
      tick.raw_height = heights_under_way.front();
      heights_under_way.pop_front();
    }
    tick.battery_v = model.voltage_v;
    if (accelerometer) {
      tick.acceleration_odom_m_s2 = model.acceleration_m_s2;
      for (int axis = 0; axis < 3; ++axis) (*tick.acceleration_odom_m_s2)[axis] += accelerometer_noise.gaussian(0.3);
    }
    if (knows_horizon) tick.horizon_offset_rad = {model.horizon_roll_rad, model.horizon_pitch_rad};
    tick.pilot_flies = pilot_climbs_m_s.has_value();
    common::Setpoint setpoint = controller.tick(tick);
    if (pilot_climbs_m_s) setpoint = byPilot();
    model.apply(setpoint);
    model.advance(0.01);
    greatest_tilt_rad = std::max({greatest_tilt_rad, std::abs(model.roll_rad), std::abs(model.pitch_rad)});
  }
  common::Setpoint byPilot() const {
    common::Setpoint setpoint;
    setpoint.stamp = model.now;
    setpoint.motors_on = true;
    const double sag = std::pow(model.voltage_v / model.vehicle.battery_full_v, 2);
    const double wanted_m_s2 = 9.81 + 3.0 * (*pilot_climbs_m_s - model.velocity_m_s.z());
    setpoint.thrust = model.vehicle.mass_kg * wanted_m_s2 / (model.vehicle.max_thrust_n * sag);
    return setpoint;
  }
  template <typename Condition>
  bool until(Condition&& condition, double at_most_s) {
    for (int i = 0; i < static_cast<int>(at_most_s * 100); ++i) {
      if (condition()) return true;
      tick();
    }
    return condition();
  }
  void run(double seconds) {
    until([] { return false; }, seconds);
  }
  void hover(double height_m = 1.0) {
    tick();
    ASSERT_TRUE(controller.command(Prepared{}));
    ASSERT_TRUE(controller.command(TakeOff{height_m}));
    ASSERT_TRUE(until([&] { return controller.state() == FlightState::kFlying; }, 12.0));
  }
};

struct Rms {
  double horizontal_m, vertical_m, worst_vertical_m;
};
inline Rms hoverFor(Flight& flight, double seconds, const Eigen::Vector3d& at) {
  double horizontal2 = 0, vertical2 = 0, worst = 0;
  const int n = static_cast<int>(seconds * 100);
  for (int i = 0; i < n; ++i) {
    flight.tick();
    const Eigen::Vector3d error = flight.model.position_m - at;
    horizontal2 += error.head<2>().squaredNorm();
    vertical2 += error.z() * error.z();
    worst = std::max(worst, std::abs(error.z()));
  }
  return {std::sqrt(horizontal2 / n), std::sqrt(vertical2 / n), worst};
}

}  // namespace swiftlet::control
