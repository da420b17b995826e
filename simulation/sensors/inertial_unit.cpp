#include "simulation/sensors/inertial_unit.hpp"

#include <cmath>
#include <numbers>

#include "common/gravity.hpp"
#include "common/random.hpp"

namespace swiftlet::simulation {
namespace {

using common::kRadPerDeg;
using common::RandomStream;
using Eigen::Vector3d;

constexpr double kGreatestSpecificForce_m_s2 = 157.0;  // 16 g, the range of the MPU-6000 (data sheet).

Vector3d gaussians(RandomStream& random, double standard_deviation) {
  const double x = random.gaussian(standard_deviation), y = random.gaussian(standard_deviation);
  return {x, y, random.gaussian(standard_deviation)};
}

/// Rectification goes with the power of the vibration, which goes with the square of the thrust. It is strongest along
/// the axis of the motors, with either sign.
Vector3d rectification_m_s2_n2(const ImuConfig& config, const common::VehicleConfig& sheet, std::uint64_t seed) {
  RandomStream random(seed, "rectification");
  const double z = random.chance(0.5) ? 1.0 : -1.0;
  const double x = random.uniform(-0.5, 0.5), y = random.uniform(-0.5, 0.5);
  const double hover_n = sheet.mass_kg * common::kGravity_m_s2;
  return config.rectification_m_s2 / (hover_n * hover_n) * Vector3d(x, y, z);
}

double thrustOf_n(const QuadrotorState& state) {
  const MotorThrusts& f = state.thrusts_n;
  return f[0] + f[1] + f[2] + f[3];
}

}  // namespace

InertialUnit::InertialUnit(const ImuConfig& config, const common::VehicleConfig& sheet, std::uint64_t seed)
    : config_(config),
      max_thrust_n_(sheet.max_thrust_n),
      seed_(seed),
      rectification_m_s2_n2_(rectification_m_s2_n2(config, sheet, seed)) {
  RandomStream random(seed, "inertial unit");
  gyro_bias_rad_s_ = gaussians(random, config.gyro_bias_rad_s);
  accel_bias_m_s2_ = gaussians(random, config.accel_bias_m_s2);
  slow_tilt_rad_ = gaussians(random, config.tilt_error_deg * kRadPerDeg).head<2>();
  yaw_drift_rad_s_ = random.gaussian(config.yaw_drift_deg_s * kRadPerDeg);
  yaw_rad_ = random.uniform(-std::numbers::pi, std::numbers::pi);
}

void InertialUnit::feel(const QuadrotorState& state) {
  specific_force_sum_m_s2_ += state.specific_force_body_m_s2;
  rate_sum_rad_s_ += state.angular_velocity_body_rad_s;
  ++sum_count_;
}

Eigen::Quaterniond InertialUnit::withErrors(const QuadrotorState& state, const Vector3d& noise_rad) const {
  common::RollPitchYaw angles = common::rollPitchYaw(state.T_world_body.rotation);
  angles.roll_rad += slow_tilt_rad_.x() + lean_rad_.x() + noise_rad.x();
  angles.pitch_rad += slow_tilt_rad_.y() + lean_rad_.y() + noise_rad.y();
  angles.yaw_rad += yaw_rad_ + noise_rad.z();
  return common::quaternionFrom(angles);
}

AttitudeMeasurement InertialUnit::attitude(std::uint64_t tick, const QuadrotorState& state, double step_s) {
  RandomStream random(seed_, "ahrs", tick);
  const double root_step = std::sqrt(step_s);

  // Gauss-Markov process: correlated over tilt_error_time_s, with constant variance.
  const double keep = std::exp(-step_s / config_.tilt_error_time_s);
  const double drive_rad = config_.tilt_error_deg * kRadPerDeg * std::sqrt(1.0 - keep * keep);
  const Vector3d tilt_drive = gaussians(random, drive_rad);
  slow_tilt_rad_ = keep * slow_tilt_rad_ + tilt_drive.head<2>();
  gyro_bias_rad_s_ += gaussians(random, config_.gyro_bias_walk_rad_s * root_step);
  accel_bias_m_s2_ += gaussians(random, config_.accel_bias_walk_m_s2 * root_step);
  yaw_rad_ += step_s * yaw_drift_rad_s_ + random.gaussian(config_.yaw_walk_deg * kRadPerDeg * root_step);

  // During forward acceleration (nose down) the accelerometers measure less tilt than there is.
  const Vector3d acceleration_world = (state.velocity_world_m_s - last_velocity_world_m_s_) / step_s;
  last_velocity_world_m_s_ = state.velocity_world_m_s;
  const double yaw = common::yawOf(state.T_world_body.rotation);
  const Eigen::Vector2d level = Eigen::Rotation2Dd(-yaw) * acceleration_world.head<2>();
  const Eigen::Vector2d target = config_.tilt_per_accel_deg * kRadPerDeg * Eigen::Vector2d(level.y(), -level.x());
  lean_rad_ += step_s / config_.tilt_accel_time_s * (target - lean_rad_);

  AttitudeMeasurement measured;
  measured.rotation_ahrs_body = withErrors(state, gaussians(random, config_.tilt_noise_deg * kRadPerDeg));
  measured.angular_velocity_body_rad_s =
      state.angular_velocity_body_rad_s + gyro_bias_rad_s_ + gaussians(random, config_.gyro_noise_rad_s);
  return measured;
}

/// The propellers shake the sensor with a force that goes with the square of their speed, as the thrust does.
double InertialUnit::accelNoise_m_s2(double thrust_n) const {
  if (config_.vibration_m_s2 <= 0.0) return config_.accel_noise_m_s2;
  const double thrust_share = thrust_n / max_thrust_n_;
  return std::hypot(config_.accel_noise_m_s2, config_.vibration_m_s2 * thrust_share);
}

common::ImuSample InertialUnit::sample(std::uint64_t frame, const QuadrotorState& state) {
  RandomStream random(seed_, "imu", frame);
  const double share = sum_count_ > 0 ? 1.0 / sum_count_ : 0.0;
  const double thrust_n = thrustOf_n(state);
  common::ImuSample sample;
  sample.angular_velocity_body_rad_s =
      share * rate_sum_rad_s_ + gyro_bias_rad_s_ + gaussians(random, config_.gyro_noise_rad_s);
  sample.specific_force_body_m_s2 =
      (share * specific_force_sum_m_s2_ + accel_bias_m_s2_ + gaussians(random, accelNoise_m_s2(thrust_n)) +
       thrust_n * thrust_n * rectification_m_s2_n2_)
          .cwiseMax(-kGreatestSpecificForce_m_s2)
          .cwiseMin(kGreatestSpecificForce_m_s2);
  sample.rotation_ahrs_body = withErrors(state, gaussians(random, config_.tilt_noise_deg * kRadPerDeg));
  specific_force_sum_m_s2_.setZero();
  rate_sum_rad_s_.setZero();
  sum_count_ = 0;
  return sample;
}

}  // namespace swiftlet::simulation
