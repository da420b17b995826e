// Properties of the airframe and of its autopilot that only the simulator knows.
#pragma once

#include "common/config_fwd.hpp"
#include "simulation/battery.hpp"

namespace swiftlet::simulation {

struct QuadrotorConfig {
  double inertia_xx_kg_m2 = 0.020;
  double inertia_yy_kg_m2 = 0.021;
  double inertia_zz_kg_m2 = 0.036;
  double arm_m = 0.165;
  double torque_per_thrust_m = 0.016;
  double motor_lag_s = 0.035;
  double linear_drag_n_s_m = 0.25;
  double quadratic_drag_n_s2_m2 = 0.06;
  double angular_drag_n_m_s = 0.004;
  double gear_height_m = 0.15;
  double gear_radius_m = 0.15;
  double mass_share = 1.0;
  double thrust_share = 1.0;
  double throttle_exponent = 1.0;
  int weak_motor = 0;
  double weak_motor_share = 1.0;
  double ground_effect_radius_m = 0.0;
  double wall_effect_share = 0.0;
  double wall_effect_range_m = 0.127;
  Battery::Config battery;

  void describe(common::config::Fields& fields);
};

/// How torques and thrust share the motors where they ask for more than a motor can give.
enum class Mixing {
  kClampEach,      ///< Each motor is clamped by itself, so that thrust and all torques suffer alike.
  kAttitudeFirst,  ///< Roll and pitch are kept, at the expense of the yaw torque, then of the thrust.
};

struct AutopilotConfig {
  double attitude_gain_1_s = 7.0;
  double max_rate_rad_s = 4.0;
  double max_yaw_rate_rad_s = 2.5;
  double rate_gain_1_s = 18.0;
  double yaw_rate_gain_1_s = 7.0;
  double rate_integral_1_s2 = 12.0;
  double link_timeout_s = 0.5;
  double failsafe_thrust_share = 0.93;
  double tilt_share = 1.0;
  double tilt_expo = 0.0;
  Mixing mixing = Mixing::kClampEach;
  double program_share = 0.0;

  void describe(common::config::Fields& fields);
};

}  // namespace swiftlet::simulation
