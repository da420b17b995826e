#include "autonomy/estimation/laser_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "common/config_fields.hpp"
#include "common/geometry.hpp"
#include "perception/projection/leaning_walls.hpp"

namespace swiftlet::autonomy {
namespace {

/// Least standard deviation of a match's yaw.
constexpr double kMatchFloor_deg = 0.10;
/// Least yaw error that a new reference of the odometry adds to its drift.
constexpr double kDriftFloor_deg = 0.03;
/// Position and yaw error of a match for each radian of tilt: the attitude errs by about a degree, and walls that stand
/// upright are displaced by that share of their distance times the tilt.
constexpr double kMatchPerTilt_m_rad = 0.05, kMatchPerTilt_deg_rad = 1.5;

}  // namespace

using common::Pose2;

void LaserPipelineConfig::describe(common::config::Fields& fields) {
  fields.section("projection", projection, "Scans corrected for motion and tilt.");
  fields.section("odometry", odometry, "Scans matched to the last ones.");
  fields("match_rate_hz", match_rate_hz, {0, 1000},
         "Scans that are matched in a second, at most; the others only measure heights, and what is near. 0: all.");
}

LaserPipeline::LaserPipeline(const LaserPipelineConfig& config, const common::LaserConfig& laser)
    : config_(config),
      laser_(laser),
      walls_(std::make_unique<perception::LeaningWalls>()),
      odometry_(config.odometry, walls_.get()) {}
LaserPipeline::~LaserPipeline() = default;

void LaserPipeline::learnWalls(const perception::ProjectedScan& scan, const common::Pose3& T_odom_body) {
  walls_->add(scan, T_odom_body);
}

perception::ProjectedScan LaserPipeline::atBodyHeight(perception::ProjectedScan scan) const {
  if (walls_->any()) return walls_->atHeight(scan, scan.T_odom_body.position_m.z());
  return scan;
}

perception::ProjectedScan LaserPipeline::project(const common::LaserScan& scan,
                                                 const perception::PoseAt& pose_at) const {
  return perception::project(scan, laser_, pose_at, config_.projection);
}

bool LaserPipeline::wants(common::Time stamp) const {
  if (config_.match_rate_hz <= 0.0 || !asked_) return true;
  return (stamp - *asked_).seconds() >= 1.0 / config_.match_rate_hz - 0.5 / laser_.rate_hz;
}

OdometryStep LaserPipeline::match(const perception::ProjectedScan& scan, const FilterView& filter) {
  asked_ = scan.stamp;
  const bool begun = lastMatch().has_value();
  const auto relative = odometry_.add(scan, filter.T_odom_last);
  if (!relative) return {};
  if (relative->from == relative->to) return restart(*relative, begun);

  OdometryStep step;
  step.matched = true;
  if (!filter.has_clone) {
    track_ = {relative->from, {}, std::nullopt, {}};
    step.clone_before = relative->from;
  }
  const Pose2 T_clone_body = track_.T_clone_reference * relative->T_from_to;
  const Eigen::Matrix3d covariance = relative->covariance + tiltCovariance(scan, kMatchFloor_m, kMatchFloor_deg);
  step.measurement = perception::measuredRelativePose(track_.clone, relative->to, T_clone_body,
                                                      common::turned(covariance, track_.T_clone_reference.yaw_rad));
  const std::optional<common::UnobservableMotion> hidden_clone = hiddenMotion(*relative, T_clone_body);
  step.measurement->unobservable_motion = hidden_clone;
  if (!relative->reference_changed) return step;

  track_.T_clone_reference = T_clone_body;
  std::optional<common::UnobservableMotion> hidden_body;
  if (hidden_clone) {
    hidden_body = common::turned(*hidden_clone, -T_clone_body.yaw_rad);
    track_ = {relative->to, {}, hidden_body, track_.hidden_at};
    step.clone_after = relative->to;
  }
  // Within one reference the error does not grow; it accumulates from reference to reference.
  const Eigen::Matrix3d covariance_to = common::turned(relative->covariance, -relative->T_from_to.yaw_rad);
  step.covariance =
      common::withoutVarianceAlong(hidden_body, covariance_to) + tiltCovariance(scan, kDriftFloor_m, kDriftFloor_deg);
  return step;
}

/// What a scan does not show of the motion since the clone. Noise may let a single scan seem to show what those about
/// it do not; if the filter took one of them, it would know the place along the walls for good.
std::optional<common::UnobservableMotion> LaserPipeline::hiddenMotion(const perception::RelativePose& relative,
                                                                      const Pose2& T_clone_body) {
  constexpr double kWhole_s = 0.25;  // Ten scans of a laser at 40 Hz.
  if (relative.unobservable_motion) {
    track_.hidden_at = relative.to;
    return unobservableMotion(common::turned(*relative.unobservable_motion, T_clone_body.yaw_rad), T_clone_body);
  }
  if (!track_.unobservable_clone || (relative.to - track_.hidden_at).seconds() > kWhole_s) return std::nullopt;
  return common::movedBy(*track_.unobservable_clone, T_clone_body.position_m());
}

/// The walls along which a vehicle flies stand still, but each scan measures the motion that they do not show a little
/// differently. If the filter took each of these as exact, two of them would fix the position along the walls, which
/// neither has seen.
common::UnobservableMotion LaserPipeline::unobservableMotion(const common::UnobservableMotion& measured_clone,
                                                             const Pose2& T_clone_body) {
  constexpr double kSameWalls_rad =
      5.0 * common::kRadPerDeg;  // Above the noise of a direction, below the least bend of a corridor.
  const Eigen::Vector2d from_clone_m = T_clone_body.position_m();
  if (track_.unobservable_clone) {
    const common::UnobservableMotion last_clone = common::movedBy(*track_.unobservable_clone, from_clone_m);
    if (common::likeness(last_clone, measured_clone) >= std::cos(kSameWalls_rad)) return last_clone;
  }
  track_.unobservable_clone = common::movedBy(measured_clone, -from_clone_m);
  return measured_clone;
}

/// Starts a local map with this scan. After an interruption the motion since the last match is unknown, so its
/// covariance is taken from the size of the search window.
OdometryStep LaserPipeline::restart(const perception::RelativePose& relative, bool interrupted) {
  track_ = {relative.to, {}, std::nullopt, {}};
  OdometryStep step;
  step.matched = true;
  step.interrupted = interrupted;
  step.clone_after = relative.to;
  if (interrupted) {
    const double off_m = config_.odometry.max_window_m;
    const double off_rad = config_.odometry.max_window_deg * std::numbers::pi / 180.0;
    step.covariance = common::planarCovariance(off_m, off_rad);
  }
  return step;
}

Eigen::Matrix3d LaserPipeline::tiltCovariance(const perception::ProjectedScan& scan, double floor_m,
                                              double floor_deg) const {
  const double tilt_rad = std::acos(std::clamp(common::cosTilt(scan.T_odom_body.rotation), -1.0, 1.0));
  const double position_m = floor_m + kMatchPerTilt_m_rad * tilt_rad;
  const double yaw_rad = (floor_deg + kMatchPerTilt_deg_rad * tilt_rad) * std::numbers::pi / 180.0;
  return common::planarCovariance(position_m, yaw_rad);
}

}  // namespace swiftlet::autonomy
