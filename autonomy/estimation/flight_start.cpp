#include "autonomy/estimation/flight_start.hpp"

#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include <fmt/format.h>

#include "autonomy/estimation/altitude_pipeline.hpp"

namespace swiftlet::autonomy {

using common::Pose3;
using common::Time;

common::ImuSample FlightStart::withAttitude(const common::ImuSample& sample,
                                            const perception::ErrorStateFilter& filter) const {
  if (uses_ahrs_) return sample;
  common::ImuSample known = sample;
  known.rotation_ahrs_body.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  if (filter.initialized())
    known.rotation_ahrs_body = filter.state().T_odom_body.rotation;
  else if (const auto rest = filter.attitudeAtRest())
    known.rotation_ahrs_body = *rest;
  return known;
}

void FlightStart::imuArrived(const common::ImuSample& sample) {
  imu_seen_ = true;
  if (sample.rotation_ahrs_body.coeffs().allFinite()) last_imu_ = sample;
}

std::optional<double> FlightStart::start(const common::LaserScan& scan, const LaserPipeline& laser,
                                         HeardFilter& filter) {
  look(scan, last_imu_ ? last_imu_->rotation_ahrs_body : Eigen::Quaterniond::Identity());
  if (!last_imu_) {
    if (imu_seen_ && uses_ahrs_)
      sayWaiting(scan.stamps.arrived,
                 "the samples have no attitude: without an AHRS set `use_ahrs` of the filter to false");
    return std::nullopt;
  }
  const common::RollPitchYaw tilt = common::rollPitchYaw(last_imu_->rotation_ahrs_body);
  const Eigen::Quaterniond R_level_body = common::quaternionFrom({tilt.roll_rad, tilt.pitch_rad, 0.0});
  const auto standing = laser.project(scan, [&](Time) { return Pose3{R_level_body, Eigen::Vector3d::Zero()}; });
  const double height_m = medianBelow_m(standing).value_or(standing_height_m_);

  const auto initialized = filter.tell(perception::TapedStart{height_m});
  if (!initialized) {
    sayWaiting(scan.stamps.arrived, initialized.error());
    return std::nullopt;
  }
  started_ = filter->newest();
  log_.info(scan.stamps.arrived, "fusion", fmt::format("initialized, body {:.3f} m above the floor", height_m));
  return height_m;
}

void FlightStart::look(const common::LaserScan& scan, const Eigen::Quaterniond& R_odom_body) {
  const common::RollPitchYaw tilt = common::rollPitchYaw(R_odom_body);
  view_.add(scan, common::quaternionFrom({tilt.roll_rad, tilt.pitch_rad, 0.0}));
}

std::string FlightStart::problem(Time now, bool position_known) const {
  if (!imu_seen_) return "the IMU has sent no sample";
  return view_.problem(now, position_known);
}

void FlightStart::sayWaiting(Time now, std::string reason) {
  if (!std::exchange(waits_, true))
    log_.info(now, "fusion", "waiting until the vehicle stands still", std::move(reason));
}

}  // namespace swiftlet::autonomy
