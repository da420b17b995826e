// Gyroscopes, accelerometers, and the attitude that the autopilot computes from them: its error is about a degree, it
// leans into long accelerations as a complementary filter does, and its yaw drifts from an arbitrary origin.
#pragma once

#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/sensor_event.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

/// Angular rate and attitude as the autopilot knows them.
struct AttitudeMeasurement {
  Eigen::Quaterniond rotation_ahrs_body = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_body_rad_s = Eigen::Vector3d::Zero();
  double battery_voltage_v = 0.0;
};

class InertialUnit {
 public:
  /// `sheet`: of the vehicle that shakes it.
  InertialUnit(const ImuConfig& config, const common::VehicleConfig& sheet, std::uint64_t seed);

  /// Call it after each physics step. It averages the measurements between two samples.
  void feel(const QuadrotorState& state);

  /// The AHRS at tick number `tick` of the attitude loop; advances its errors by step_s.
  AttitudeMeasurement attitude(std::uint64_t tick, const QuadrotorState& state, double step_s);

  /// Sample number `frame`: the mean since the last sample. The stamps are left to the caller.
  common::ImuSample sample(std::uint64_t frame, const QuadrotorState& state);

 private:
  Eigen::Quaterniond withErrors(const QuadrotorState& state, const Eigen::Vector3d& noise_rad) const;

  double accelNoise_m_s2(double thrust_n) const;

  ImuConfig config_;
  double max_thrust_n_;
  std::uint64_t seed_;
  Eigen::Vector3d gyro_bias_rad_s_;
  Eigen::Vector3d accel_bias_m_s2_;
  Eigen::Vector3d rectification_m_s2_n2_;  ///< Mean shift of the accelerometer per squared thrust.
  Eigen::Vector2d slow_tilt_rad_;
  Eigen::Vector2d lean_rad_ = Eigen::Vector2d::Zero();
  double yaw_rad_;
  double yaw_drift_rad_s_;
  Eigen::Vector3d last_velocity_world_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_sum_m_s2_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_sum_rad_s_ = Eigen::Vector3d::Zero();
  int sum_count_ = 0;
};

}  // namespace swiftlet::simulation
