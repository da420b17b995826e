// A flight through a planar world, for tests: smooth motion along waypoints, a tilt that follows the acceleration, an
// attitude with an error of about a degree, and a substitute for the filter, which bridges the laser odometry by a
// noisy prediction between the scans. Only the scoring sees the truth.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "perception/laser_odometry/laser_odometry.hpp"
#include "perception/projection/scan_projection.hpp"
#include "tests/scan_matching/planar_world.hpp"
#include "tests/slam2d/smoothed.hpp"

namespace swiftlet::test {

/// Constant speed along a polyline, smoothed over about a second; the nose points where it flies.
class SmoothPath {
 public:
  SmoothPath(const std::vector<Eigen::Vector2d>& waypoints, double speed_m_s) {
    constexpr double kStep_s = 0.02;
    std::vector<Eigen::Vector2d> raw;
    for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
      const double length = (waypoints[i + 1] - waypoints[i]).norm();
      const int steps = std::max(1, static_cast<int>(length / (speed_m_s * kStep_s)));
      for (int k = 0; k < steps; ++k)
        raw.push_back(waypoints[i] + (waypoints[i + 1] - waypoints[i]) * (static_cast<double>(k) / steps));
    }
    for (int i = 0; i < 60; ++i) raw.push_back(waypoints.back());
    positions_ = smoothed(smoothed(raw, 20), 20);
    // The nose follows slowly, unwrapped, so that a turn takes the time a quadrotor takes.
    double yaw = 0.0;
    std::vector<Eigen::Vector2d> yaws;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const Eigen::Vector2d ahead = positions_[std::min(i + 10, positions_.size() - 1)] - positions_[i];
      if (ahead.norm() > 0.02)
        yaw += std::clamp(common::wrapAngle(std::atan2(ahead.y(), ahead.x()) - yaw), -0.03, 0.03);
      yaws.emplace_back(yaw, 0.0);
    }
    yaws_ = smoothed(yaws, 15);
    step_s_ = kStep_s;
  }

  double duration_s() const { return step_s_ * static_cast<double>(positions_.size() - 1); }

  /// With the tilt that the acceleration takes.
  common::Pose3 at(common::Time time) const {
    const double s = std::clamp(time.seconds() / step_s_, 1.0, static_cast<double>(positions_.size()) - 3.0);
    const auto i = static_cast<std::size_t>(s);
    const double share = s - static_cast<double>(i);
    const auto mix = [&](const std::vector<Eigen::Vector2d>& v) -> Eigen::Vector2d {
      return (1.0 - share) * v[i] + share * v[i + 1];
    };
    const double yaw = mix(yaws_).x();
    const auto accelerationAt = [&](std::size_t k) -> Eigen::Vector2d {
      return (positions_[k + 1] - 2.0 * positions_[k] + positions_[k - 1]) / (step_s_ * step_s_);
    };
    const Eigen::Vector2d acceleration =
        Eigen::Rotation2Dd(-yaw) * ((1.0 - share) * accelerationAt(i) + share * accelerationAt(i + 1));
    const Eigen::Vector2d p = mix(positions_);
    return {common::quaternionFrom({-acceleration.y() / 9.81, acceleration.x() / 9.81, yaw}),
            {p.x(), p.y(), 1.0 + 0.05 * std::sin(0.7 * time.seconds())}};
  }

 private:
  std::vector<Eigen::Vector2d> positions_, yaws_;
  double step_s_ = 0.02;
};

/// The filter's outputs for a flight, scan by scan.
class Flight {
 public:
  struct Step {
    perception::ProjectedScan scan;
    common::Pose2 T_odom_body;  ///< After the laser's measurement.
    Eigen::Matrix3d covariance_since_last;
    common::Pose2 truth_T_world_body;
    std::optional<perception::RelativePose> relative;
  };

  Flight(PlanarWorld world, SmoothPath path, common::LaserConfig laser, std::uint64_t seed,
         perception::LaserOdometryConfig odometry = {})
      : world_(std::move(world)), path_(std::move(path)), laser_(std::move(laser)), seed_(seed), odometry_(odometry) {}

  double attitude_error_rad = 0.0175;
  double prediction_error_m = 0.003;
  double prediction_error_rad = 0.0008;

  bool done() const { return frame_ / laser_.rate_hz + 0.1 > path_.duration_s(); }
  PlanarWorld& world() { return world_; }
  common::Pose2 start() const { return common::planar(path_.at(common::Time{})); }

  Step next() {
    common::RandomStream random(seed_, "flight", frame_);
    const auto begin = common::Time::fromSeconds(static_cast<double>(frame_) / laser_.rate_hz);
    ++frame_;
    const auto motion = [&](common::Time t) { return path_.at(t); };
    const common::LaserScan raw = sweep(world_, laser_, motion, begin, random);

    // The attitude error wanders with a standard deviation of one degree over seconds.
    for (double* angle : {&roll_error_rad_, &pitch_error_rad_})
      *angle = 0.99 * *angle + random.gaussian(attitude_error_rad * std::sqrt(1.0 - 0.99 * 0.99));
    // The prediction since the last scan: true motion plus what an IMU would get wrong.
    const common::Pose2 noise{random.gaussian(prediction_error_m), random.gaussian(prediction_error_m),
                              random.gaussian(prediction_error_rad)};
    const auto predicted = [&](common::Time t) {
      const common::Pose3 truth = path_.at(t);
      const common::Pose2 since = T_world_last_.inverse() * common::planar(truth);
      const common::Pose2 pose = T_odom_last_ * since * noise;
      const common::RollPitchYaw angles = common::rollPitchYaw(truth.rotation);
      return common::Pose3{common::quaternionFrom(
                               {angles.roll_rad + roll_error_rad_, angles.pitch_rad + pitch_error_rad_, pose.yaw_rad}),
                           {pose.x_m, pose.y_m, truth.position_m.z()}};
    };
    if (frame_ == 1) T_world_last_ = start();

    Step step;
    step.scan = perception::project(raw, laser_, predicted, {});
    step.truth_T_world_body = common::planar(path_.at(step.scan.stamp));
    step.T_odom_body = common::planar(step.scan.T_odom_body);
    step.covariance_since_last = Eigen::Vector3d(9e-6, 9e-6, 6.4e-7).asDiagonal();
    step.relative = odometry_.add(step.scan, T_odom_matched_);
    if (step.relative) {
      if (step.relative->from != step.relative->to) step.T_odom_body = T_odom_reference_ * step.relative->T_from_to;
      if (step.relative->reference_changed) T_odom_reference_ = step.T_odom_body;
      T_odom_matched_ = step.T_odom_body;
      step.covariance_since_last = Eigen::Vector3d(4e-6, 4e-6, 1e-6).asDiagonal();
    }
    T_odom_last_ = step.T_odom_body;
    T_world_last_ = step.truth_T_world_body;
    return step;
  }

  const perception::LaserOdometry& odometry() const { return odometry_; }

 private:
  PlanarWorld world_;
  SmoothPath path_;
  common::LaserConfig laser_;
  std::uint64_t seed_;
  perception::LaserOdometry odometry_;
  std::uint64_t frame_ = 0;
  double roll_error_rad_ = 0.0, pitch_error_rad_ = 0.0;
  common::Pose2 T_odom_last_, T_odom_matched_, T_odom_reference_, T_world_last_;
};

/// Loops through both rooms of the flat.
inline std::vector<Eigen::Vector2d> flatLoop(int loops) {
  std::vector<Eigen::Vector2d> waypoints{{0.0, 0.0}};
  for (int i = 0; i < loops; ++i)
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(2.3, -1.5), Eigen::Vector2d(2.5, 0.9), Eigen::Vector2d(4.6, 0.9), Eigen::Vector2d(5.2, -2.0),
          Eigen::Vector2d(8.2, -1.6), Eigen::Vector2d(8.2, 2.0), Eigen::Vector2d(6.2, 4.2), Eigen::Vector2d(4.6, 0.9),
          Eigen::Vector2d(2.3, 0.9), Eigen::Vector2d(2.5, 4.3), Eigen::Vector2d(-1.0, 4.2), Eigen::Vector2d(-1.0, 0.5)})
      waypoints.push_back(p);
  return waypoints;
}

}  // namespace swiftlet::test
