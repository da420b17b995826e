// Cascaded PID: position -> velocity -> acceleration -> roll, pitch and thrust; P on yaw (Grzonka 2012, equations 3 to
// 5; Saeedi, III-E). The reference's velocity and acceleration are fed forward.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/vehicle_state.hpp"
#include "control/reference.hpp"
#include "control/thrust_model.hpp"

namespace swiftlet::control {

/// Call at 100 Hz from one thread; it keeps the integral between ticks. A NaN in the state never reaches the setpoint,
/// which is then level at hover thrust.
class PositionController {
 public:
  struct Config {
    double horizontal_p_1_s = 1.4;
    double horizontal_v_1_s = 3.0;
    double horizontal_i_1_s2 = 2.0;
    double vertical_p_1_s = 1.8;
    double vertical_v_1_s = 4.5;
    double vertical_i_1_s2 = 2.0;
    double yaw_p_1_s = 2.0;
    double max_correction_m_s = 1.0;
    double max_speed_m_s = 1.5;
    double max_climb_m_s = 1.0;
    double max_acceleration_up_m_s2 = 4.0;
    double max_integral_m_s2 = 2.0;
    double max_yaw_rate_deg_s = 90.0;
    double latency_s = 0.03;
    double attitude_lag_s = 0.2;
    ThrustModel::Config thrust;

    void describe(common::config::Fields& fields);
  };

  enum class Horizontal {
    kPosition,  ///< Hold the reference.
    kVelocity,  ///< The position is unknown: only damp the velocity.
    kLevel,     ///< Neither is known: keep the trim learned so far.
  };

  PositionController(const Config& config, const common::VehicleConfig& vehicle);

  /// Resets the integrals; the learned hover command stays.
  void reset();

  /// While `on_ground` the tilt and the yaw rate stay zero, and neither the horizontal integrals nor the learned hover
  /// command change.
  common::Setpoint tick(common::Time now, double dt_s, const common::VehicleState& state, const Reference& reference,
                        double battery_v, Horizontal horizontal = Horizontal::kPosition, bool on_ground = false);

  /// The horizontal acceleration that balances wind and a wrong horizon, as learned so far.
  Eigen::Vector2d trim_odom_m_s2() const { return integral_m_s2_.head<2>(); }
  ThrustModel& thrust() { return thrust_; }
  const ThrustModel& thrust() const { return thrust_; }

 private:
  /// Where a vehicle whose attitude follows with a lag is when it is given the reference's acceleration.
  struct Delayed {
    Eigen::Vector2d position_odom_m;
    Eigen::Vector2d velocity_odom_m_s;
  };
  double greatestTilt_rad() const;
  void delay(const Reference& reference, double dt_s);
  /// The velocity error, including the correction for the position error, on which the velocity and integral gains act.
  Eigen::Vector3d missingVelocity(const common::VehicleState& state, const Reference& reference,
                                  Horizontal horizontal) const;
  void integrate(const Eigen::Vector3d& missing_m_s, const Eigen::Vector3d& wanted_m_s2,
                 const Eigen::Vector3d& given_m_s2, double dt_s);

  Config config_;
  common::VehicleConfig vehicle_;
  ThrustModel thrust_;
  Eigen::Vector3d integral_m_s2_ = Eigen::Vector3d::Zero();
  std::optional<Delayed> delayed_;  ///< None while the horizontal position is not held.
};

}  // namespace swiftlet::control
