// A smooth artificial flight with an IMU and a laser odometry, to test the fusion filter.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "common/random.hpp"
#include "common/sensor_event.hpp"
#include "perception/fusion/error_state_filter.hpp"

namespace swiftlet::perception {

struct Truth {
  common::Pose3 T_odom_body;
  Eigen::Vector3d velocity_m_s;
};

/// Rests for two seconds, then moves with growing amplitude. The position is analytic, the attitude is given by angles.
struct Motion {
  double amplitude = 1.0;

  static double ramp(double t) {
    return t <= 2.0 ? 0.0 : (t >= 5.0 ? 1.0 : 0.5 - 0.5 * std::cos((t - 2.0) / 3.0 * std::numbers::pi));
  }
  common::Pose3 pose(double t) const {
    const double a = amplitude * ramp(t);
    const Eigen::Vector3d position(a * 1.5 * std::sin(0.7 * t), a * 1.0 * std::sin(0.9 * t + 0.5),
                                   0.15 + ramp(t) * (0.9 + 0.2 * amplitude * std::sin(0.5 * t)));
    const common::RollPitchYaw angles{a * 0.12 * std::sin(1.3 * t), a * 0.10 * std::sin(1.1 * t + 1.0),
                                      a * 0.9 * std::sin(0.4 * t)};
    return {common::quaternionFrom(angles), position};
  }
  Truth truth(double t) const {
    constexpr double h = 1e-4;
    return {pose(t), (pose(t + h).position_m - pose(t - h).position_m) / (2 * h)};
  }
  Eigen::Vector3d angularVelocity(double t) const {
    constexpr double h = 1e-4;
    return common::logSO3(pose(t - h).rotation.conjugate() * pose(t + h).rotation) / (2 * h);
  }
  Eigen::Vector3d specificForce(double t) const {
    constexpr double h = 1e-3;
    const Eigen::Vector3d acceleration =
        (pose(t + h).position_m - 2.0 * pose(t).position_m + pose(t - h).position_m) / (h * h);
    return pose(t).rotation.conjugate() * (acceleration + Eigen::Vector3d(0, 0, 9.81));
  }
};

struct SensorNoise {
  double accelerometer = 0.02, gyroscope = 0.002;  ///< Densities.
  double accelerometer_walk = 0.003, gyroscope_walk = 0.0005;
  Eigen::Vector3d accelerometer_bias{0.08, -0.06, 0.10}, gyroscope_bias{0.004, -0.003, 0.005};
  double ahrs_sigma_rad = 1.0 * std::numbers::pi / 180.0, ahrs_correlation_s = 10.0;
  double scan_m = 0.01, scan_rad = 0.2 * std::numbers::pi / 180.0, height_m = 0.01;
  double camera_m = 0.01, camera_rad = 0.004;
};

/// The artificial flight tilts independently of its motion, so its accelerometer shows no drag.
inline ErrorStateFilter::Config withoutDrag() {
  ErrorStateFilter::Config config;
  config.use_drag = false;
  return config;
}

/// A measurement for the filter, delivered when it arrives.
struct Delivery {
  common::Time arrives;
  int order = 0;
  std::function<void(ErrorStateFilter&)> deliver;
};

class SyntheticFlight {
 public:
  SyntheticFlight(std::uint64_t seed, double seconds, const SensorNoise& noise = {}, double amplitude = 1.0)
      : motion{amplitude}, noise_(noise), random_(seed, "flight"), seconds_(seconds) {}

  Motion motion;
  double imu_hz = 200.0, scan_hz = 40.0;
  double camera_hz = 0.0;  ///< 0: without a camera.
  double delay_s = 0.02;
  double reference_every_s = 0.5;  ///< A new reference scan.
  double rest_until_s = 2.0;
  /// The interval without scans.
  double silent_from_s = 1e9, silent_until_s = 1e9;
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero(), gyroscope_bias = Eigen::Vector3d::Zero();

  std::vector<common::ImuSample> imuSamples() {
    std::vector<common::ImuSample> samples;
    accelerometer_bias = noise_.accelerometer_bias;
    gyroscope_bias = noise_.gyroscope_bias;
    const double dt = 1.0 / imu_hz, share = dt / noise_.ahrs_correlation_s;
    Eigen::Vector3d lean = vector(noise_.ahrs_sigma_rad);
    const int n = static_cast<int>(seconds_ * imu_hz);
    for (int i = 0; i <= n; ++i) {
      const double t = i * dt;
      common::ImuSample sample;
      sample.stamps.measured = sample.stamps.arrived = common::Time::fromSeconds(t);
      sample.angular_velocity_body_rad_s =
          motion.angularVelocity(t) + gyroscope_bias + vector(noise_.gyroscope / std::sqrt(dt));
      sample.specific_force_body_m_s2 =
          motion.specificForce(t) + accelerometer_bias + vector(noise_.accelerometer / std::sqrt(dt));
      lean += -share * lean + vector(noise_.ahrs_sigma_rad * std::sqrt(2.0 * share));
      sample.rotation_ahrs_body = common::expSO3({lean.x(), lean.y(), 0.0}) * motion.pose(t).rotation;
      accelerometer_bias += vector(noise_.accelerometer_walk * std::sqrt(dt));
      gyroscope_bias += vector(noise_.gyroscope_walk * std::sqrt(dt));
      samples.push_back(sample);
    }
    return samples;
  }

  /// Scans matched to a reference that changes now and then, and heights. Times fall between IMU samples.
  std::vector<Delivery> deliveries() {
    std::vector<Delivery> out;
    const Eigen::Matrix3d covariance =
        Eigen::Vector3d(noise_.scan_m * noise_.scan_m, noise_.scan_m * noise_.scan_m, noise_.scan_rad * noise_.scan_rad)
            .asDiagonal();
    double reference_s = -1.0;
    for (double t = 0.7013; t < seconds_ - 0.05; t += 1.0 / scan_hz) {
      if (t > silent_from_s && t < silent_until_s) continue;
      const common::Time to = common::Time::fromSeconds(t), arrives = common::Time::fromSeconds(t + delay_s);
      const double measured_height_m = motion.pose(t).position_m.z() + random_.gaussian(noise_.height_m);
      const double variance = noise_.height_m * noise_.height_m;
      out.push_back(
          {arrives, 0, [=](ErrorStateFilter& f) { (void)f.add(measuredHeight(to, measured_height_m, variance)); }});
      if (reference_s >= 0.0) {
        const common::Time from = common::Time::fromSeconds(reference_s);
        common::Pose2 relative = planar(motion.pose(reference_s)).inverse() * planar(motion.pose(t));
        relative.x_m += random_.gaussian(noise_.scan_m);
        relative.y_m += random_.gaussian(noise_.scan_m);
        relative.yaw_rad += random_.gaussian(noise_.scan_rad);
        out.push_back({arrives, 1, [=](ErrorStateFilter& f) {
                         (void)f.add(measuredRelativePose(from, to, relative, covariance));
                       }});
      }
      if (reference_s < 0.0 || t - reference_s >= reference_every_s) {
        out.push_back({arrives, 2, [=](ErrorStateFilter& f) { (void)f.add(poseClone(to)); }});
        reference_s = t;
      }
    }
    if (camera_hz > 0.0) addCamera(out);
    return out;
  }

  double seconds() const { return seconds_; }
  double restUntil() const { return rest_until_s; }

 private:
  /// Poses in space relative to a key frame, which is another one every second; late by the time of alignment.
  void addCamera(std::vector<Delivery>& out) {
    constexpr double kLate_s = 0.12, kKeyFrame_s = 1.0;
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    covariance.diagonal().head<3>().setConstant(noise_.camera_m * noise_.camera_m);
    covariance.diagonal().tail<3>().setConstant(noise_.camera_rad * noise_.camera_rad);
    double key_s = -1.0;
    for (double t = 0.7307; t < seconds_ - 0.15; t += 1.0 / camera_hz) {
      const common::Time to = common::Time::fromSeconds(t), arrives = common::Time::fromSeconds(t + kLate_s);
      if (key_s >= 0.0) {
        const common::Time from = common::Time::fromSeconds(key_s);
        const Eigen::Vector3d moved = vector(noise_.camera_m), turned = vector(noise_.camera_rad);
        const common::Pose3 pose =
            motion.pose(key_s).inverse() * motion.pose(t) * common::Pose3{common::expSO3(turned), moved};
        out.push_back(
            {arrives, 3, [=](ErrorStateFilter& f) { (void)f.add(measuredRelativePose3(from, to, pose, covariance)); }});
      }
      if (key_s < 0.0 || t - key_s >= kKeyFrame_s) {
        out.push_back({arrives, 4, [=](ErrorStateFilter& f) { (void)f.add(poseClone(to)); }});
        key_s = t;
      }
    }
  }
  Eigen::Vector3d vector(double sigma) {
    const double x = random_.gaussian(sigma), y = random_.gaussian(sigma), z = random_.gaussian(sigma);
    return {x, y, z};
  }
  SensorNoise noise_;
  common::RandomStream random_;
  double seconds_;
};

/// Feeds a filter: IMU in order, deliveries as they arrive; starts it at 0.6 s. `each` is called after every IMU sample
/// once it runs.
inline void feed(
    ErrorStateFilter& filter, const std::vector<common::ImuSample>& samples, std::vector<Delivery> deliveries,
    double rest_until_s, const std::function<void(double)>& each = [](double) {}) {
  std::stable_sort(deliveries.begin(), deliveries.end(),
                   [](const Delivery& a, const Delivery& b) { return a.arrives < b.arrives; });
  std::size_t next = 0;
  for (const common::ImuSample& sample : samples) {
    const double t = sample.stamps.measured.seconds();
    filter.setAtRest(t < rest_until_s - 0.05);
    filter.predict(sample);
    if (!filter.initialized()) {
      if (t >= 0.6) (void)filter.initialize(0.15);
      continue;
    }
    for (; next < deliveries.size() && deliveries[next].arrives <= sample.stamps.measured; ++next)
      deliveries[next].deliver(filter);
    each(t);
  }
}

}  // namespace swiftlet::perception
