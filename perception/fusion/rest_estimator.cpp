#include "perception/fusion/rest_estimator.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "common/geometry.hpp"

namespace swiftlet::perception::fusion {
namespace {

/// Duration of the samples at rest that the start averages.
constexpr double kRest_s = 0.5;
/// With more spread of the gyroscope than this the vehicle is moving.
constexpr double kRestGyroscopeSigma_rad_s = 0.05;
/// With more spread of the accelerometer than this the vehicle is moving.
constexpr double kRestAccelerometerSigma_m_s2 = 0.5;

/// Samples that are kept: 5 s at the autopilot's 200 Hz.
constexpr std::size_t kCapacity = 1024;
/// With fewer samples a standard deviation is uncertain by more than 16 %, 1 / sqrt(2 n).
constexpr std::size_t kFewest = 20;
/// Ten times the usual accelerometer bias of a MEMS IMU; more is another axis or unit, or a vehicle that moves.
constexpr double kGravityTolerance_m_s2 = 1.0;
/// Ten times the usual gyroscope bias of a MEMS IMU (1 deg/s).
constexpr double kGyroscopeBiasLimit_rad_s = 0.2;

}  // namespace

RestEstimator::RestEstimator(double gravity_m_s2) : gravity_m_s2_(gravity_m_s2), samples_(kCapacity) {}

void RestEstimator::add(const common::ImuSample& sample) {
  samples_[next_] = {sample.stamps.measured, sample.angular_velocity_body_rad_s, sample.specific_force_body_m_s2};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

tl::expected<RestEstimate, std::string> RestEstimator::estimate() const {
  if (count_ == 0) return tl::unexpected(std::string("no IMU sample yet"));
  const auto sample = [this](std::size_t age) -> const Sample& {
    return samples_[(next_ + kCapacity - 1 - age) % kCapacity];
  };
  std::size_t used = 0;
  Eigen::Vector3d gyro = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();
  double covered_s = 0.0;
  while (used < count_ && covered_s < kRest_s) {
    covered_s = (sample(0).stamp - sample(used).stamp).seconds();
    gyro += sample(used).angular_velocity_body_rad_s;
    force += sample(used).specific_force_body_m_s2;
    ++used;
  }
  const bool enough = covered_s >= kRest_s || used == kCapacity;
  if (!enough || used < kFewest)
    return tl::unexpected(
        fmt::format("{} IMU samples over {:.2f} s at rest, {:.2f} s are needed", used, covered_s, kRest_s));
  const double n = static_cast<double>(used);
  gyro /= n;
  force /= n;
  double gyro_variance = 0.0, force_variance = 0.0;
  for (std::size_t i = 0; i < used; ++i) {
    gyro_variance += (sample(i).angular_velocity_body_rad_s - gyro).squaredNorm() / (3.0 * n);
    force_variance += (sample(i).specific_force_body_m_s2 - force).squaredNorm() / (3.0 * n);
  }
  const double gyro_sigma = std::sqrt(gyro_variance), force_sigma = std::sqrt(force_variance);
  if (gyro_sigma > kRestGyroscopeSigma_rad_s || gyro.norm() > kGyroscopeBiasLimit_rad_s ||
      force_sigma > kRestAccelerometerSigma_m_s2)
    return tl::unexpected(fmt::format("it moves: rotation {:.3f} +- {:.3f} rad/s, force +- {:.2f} m/s^2", gyro.norm(),
                                      gyro_sigma, force_sigma));
  if (std::abs(force.norm() - gravity_m_s2_) > kGravityTolerance_m_s2)
    return tl::unexpected(fmt::format("the accelerometer reads {:.2f} m/s^2 at rest", force.norm()));

  RestEstimate out;
  out.angular_velocity_body_rad_s = gyro;
  out.specific_force_body_m_s2 = force;
  const double roll = std::atan2(force.y(), force.z());
  const double pitch = std::atan2(-force.x(), std::hypot(force.y(), force.z()));
  out.rotation_level_body = common::quaternionFrom({roll, pitch, 0.0});
  out.gyroscope_mean_sigma_rad_s = gyro_sigma / std::sqrt(n);
  out.accelerometer_mean_sigma_m_s2 = force_sigma / std::sqrt(n);
  return out;
}

}  // namespace swiftlet::perception::fusion
