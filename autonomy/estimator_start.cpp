// The start of the estimator: the attitude of a vehicle that stands still, and the height of its body above the floor.
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "autonomy/estimator.hpp"

namespace swiftlet::autonomy {

using common::Pose3;
using common::Severity;
using common::Time;

namespace {

/// Several frames of a slow camera.
constexpr double kCameraSaw_s = 0.3;

}  // namespace

common::ImuSample Estimator::withAttitude(const common::ImuSample& sample) const {
  if (uses_ahrs_) return sample;
  common::ImuSample known = sample;
  known.rotation_ahrs_body.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  if (filter_.initialized())
    known.rotation_ahrs_body = filter_.state().T_odom_body.rotation;
  else if (const auto rest = filter_.attitudeAtRest())
    known.rotation_ahrs_body = *rest;
  return known;
}

void Estimator::initialize(const common::LaserScan& scan) {
  lookFromStart(scan, last_imu_ ? last_imu_->rotation_ahrs_body : Eigen::Quaterniond::Identity());
  if (!last_imu_) {
    if (imu_seen_ && uses_ahrs_)
      sayWaiting(scan.stamps.arrived,
                 "the samples have no attitude: without an AHRS set `use_ahrs` of the filter to false");
    return;
  }
  const common::RollPitchYaw tilt = common::rollPitchYaw(last_imu_->rotation_ahrs_body);
  const Eigen::Quaterniond R_level_body = common::quaternionFrom({tilt.roll_rad, tilt.pitch_rad, 0.0});
  const auto standing = laser_.project(scan, [&](Time) { return Pose3{R_level_body, Eigen::Vector3d::Zero()}; });
  const double height_m = medianBelow_m(standing).value_or(standing_height_m_);

  const auto initialized = tell(perception::TapedStart{height_m});
  if (!initialized) return sayWaiting(scan.stamps.arrived, initialized.error());
  started_ = filter_.newest();
  altitude_.initialize(started_, height_m);
  say(scan.stamps.arrived, Severity::kInfo, "fusion",
      fmt::format("initialized, body {:.3f} m above the floor", height_m));
}

void Estimator::lookFromStart(const common::LaserScan& scan, const Eigen::Quaterniond& R_odom_body) {
  const common::RollPitchYaw tilt = common::rollPitchYaw(R_odom_body);
  start_view_.add(scan, common::quaternionFrom({tilt.roll_rad, tilt.pitch_rad, 0.0}));
}

std::string Estimator::whyUnready(Time now) const {
  if (!imu_seen_) return "the IMU has sent no sample";
  return start_view_.problem(now, rgbd_ && (now - position_seen_).seconds() < kCameraSaw_s);
}

void Estimator::sayWaiting(Time now, std::string reason) {
  if (!std::exchange(waiting_said_, true))
    say(now, Severity::kInfo, "fusion", "waiting until the vehicle stands still", std::move(reason));
}

}  // namespace swiftlet::autonomy
