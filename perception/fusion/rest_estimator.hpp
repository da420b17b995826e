// Estimates the direction of gravity and the gyroscope's bias from an IMU at rest, and detects when the IMU is not at
// rest.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <tl/expected.hpp>

#include "common/sensor_event.hpp"

namespace swiftlet::perception::fusion {

struct RestEstimate {
  Eigen::Vector3d angular_velocity_body_rad_s;
  Eigen::Vector3d specific_force_body_m_s2;
  Eigen::Quaterniond rotation_level_body;  ///< Yaw zero.
  double gyroscope_mean_sigma_rad_s = 0.0;
  double accelerometer_mean_sigma_m_s2 = 0.0;
};

/// Uses the samples of the last half second, at most 1024.
class RestEstimator {
 public:
  /// `gravity_m_s2`: the magnitude of gravity.
  explicit RestEstimator(double gravity_m_s2);

  void add(const common::ImuSample& sample);
  /// The estimate, or the reason why there is none: too few samples, motion, or a specific force that is not gravity.
  tl::expected<RestEstimate, std::string> estimate() const;

 private:
  struct Sample {
    common::Time stamp;
    Eigen::Vector3d angular_velocity_body_rad_s;
    Eigen::Vector3d specific_force_body_m_s2;
  };
  double gravity_m_s2_;
  std::vector<Sample> samples_;  ///< A ring.
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace swiftlet::perception::fusion
