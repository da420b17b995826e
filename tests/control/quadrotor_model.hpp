// A small model of a quadrotor: attitude loop on a drifting horizon, lagging thrust that sags with the battery, drag,
// wind, late commands and a noisy, late estimate. It stands on a floor at z = 0 (feet 0.15 m below the origin).
#pragma once

#include <cmath>
#include <deque>
#include <numbers>

#include "common/random.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"

namespace swiftlet::control {

struct QuadrotorModel {
  static constexpr double kStep_s = 0.002;
  static constexpr double kStanding_m = 0.15;

  // Differences between the real vehicle and the data sheet.
  double attitude_sigma_deg = 1.0, attitude_correlation_s = 2.0;
  double motor_lag_s = 0.05, latency_s = 0.03, drag_1_s = 0.18;
  double position_sigma_m = 0.005, velocity_sigma_m_s = 0.02;
  double voltage_v = 12.4, voltage_drop_v_s = 0.004;
  double thrust_factor = 1.0;  ///< Share of the thrust in the data sheet.
  Eigen::Vector3d wind_m_s = Eigen::Vector3d::Zero();
  double floor_m = 0.0;

  common::VehicleConfig vehicle;
  common::RandomStream random{1, "model"};
  common::Time now;
  Eigen::Vector3d position_m{0.0, 0.0, kStanding_m}, velocity_m_s = Eigen::Vector3d::Zero();
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0, roll_rate = 0, pitch_rate = 0, yaw_rate = 0;
  double horizon_roll_rad = 0, horizon_pitch_rad = 0;
  double thrust_n = 0;
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
  double hardest_touch_m_s = 0;
  std::deque<common::Setpoint> under_way;
  common::Setpoint in_force;

  void apply(const common::Setpoint& setpoint) { under_way.push_back(setpoint); }

  void advance(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep_s)); ++i) step();
  }

  void step() {
    now += common::Duration::fromSeconds(kStep_s);
    while (!under_way.empty() && (now - under_way.front().stamp).seconds() >= latency_s) {
      in_force = under_way.front();
      under_way.pop_front();
    }
    wander(horizon_roll_rad);
    wander(horizon_pitch_rad);
    // The attitude loop of a small autopilot: rate from error, torque from rate error.
    const auto loop = [](double wanted, double angle, double rate) { return 18.0 * (7.0 * (wanted - angle) - rate); };
    roll_rate += kStep_s * loop(in_force.roll_rad, roll_rad + horizon_roll_rad, roll_rate);
    pitch_rate += kStep_s * loop(in_force.pitch_rad, pitch_rad + horizon_pitch_rad, pitch_rate);
    yaw_rate += kStep_s * 8.0 * (in_force.yaw_rate_rad_s - yaw_rate);
    roll_rad += kStep_s * roll_rate;
    pitch_rad += kStep_s * pitch_rate;
    yaw_rad = common::wrapAngle(yaw_rad + kStep_s * yaw_rate);
    voltage_v -= kStep_s * voltage_drop_v_s * (in_force.motors_on ? 1.0 : 0.0);
    const double sag = std::pow(voltage_v / vehicle.battery_full_v, 2);
    const double wanted_n = in_force.motors_on ? in_force.thrust * vehicle.max_thrust_n * sag * thrust_factor : 0.0;
    thrust_n += kStep_s / motor_lag_s * (wanted_n - thrust_n);
    Eigen::Vector3d acceleration =
        rotation() * Eigen::Vector3d(0, 0, thrust_n / vehicle.mass_kg) - Eigen::Vector3d(0, 0, 9.81);
    acceleration -= drag_1_s * (velocity_m_s - wind_m_s);
    acceleration_m_s2 = acceleration;
    velocity_m_s += kStep_s * acceleration;
    position_m += kStep_s * velocity_m_s;
    if (position_m.z() <= floor_m + kStanding_m) stand();
  }

  void stand() {
    hardest_touch_m_s = std::max(hardest_touch_m_s, -velocity_m_s.z());
    position_m.z() = floor_m + kStanding_m;
    velocity_m_s = {0, 0, std::max(0.0, velocity_m_s.z())};
    roll_rad = pitch_rad = roll_rate = pitch_rate = 0;
  }

  Eigen::Quaterniond rotation() const { return common::quaternionFrom({roll_rad, pitch_rad, yaw_rad}); }

  common::VehicleState estimate() {
    common::VehicleState state;
    state.stamp = now;
    const auto noise = [this](double sigma) {
      return Eigen::Vector3d(random.gaussian(sigma), random.gaussian(sigma), random.gaussian(sigma));
    };
    state.T_odom_body = {rotation(), position_m + noise(position_sigma_m)};
    state.velocity_odom_m_s = velocity_m_s + noise(velocity_sigma_m_s);
    state.velocity_covariance_m2_s2.setIdentity();
    state.velocity_covariance_m2_s2 *= velocity_sigma_m_s * velocity_sigma_m_s;
    state.height_above_ground_m = position_m.z() - floor_m;
    state.horizontal_valid = state.vertical_valid = true;
    state.horizontal_supported = state.vertical_supported = now;
    return state;
  }

 private:
  void wander(double& angle_rad) {
    const double sigma = attitude_sigma_deg * std::numbers::pi / 180.0, share = kStep_s / attitude_correlation_s;
    angle_rad += -share * angle_rad + random.gaussian(sigma * std::sqrt(2.0 * share));
  }
};

}  // namespace swiftlet::control
