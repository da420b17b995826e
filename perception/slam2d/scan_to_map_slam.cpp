#include "perception/slam2d/scan_to_map_slam.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "perception/laser_odometry/unknown_step.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/slam2d/progress.hpp"
#include "perception/slam2d/sliced_map.hpp"
#include "perception/slam2d/surface_map.hpp"
#include "perception/slam2d/uncertain_pose.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;
using common::Time;

/// A scan is matched to the map after this distance.
constexpr double kMatchDistance_m = 0.10;
/// A scan is matched to the map after this rotation.
constexpr double kMatchRotation_deg = 5.0;
/// A scan is matched to the map after this time.
constexpr double kMatchTime_s = 0.25;
/// A scan becomes a key scan, which is drawn into the surfaces, after this distance.
constexpr double kKeyDistance_m = 0.4;
/// A scan becomes a key scan after this rotation.
constexpr double kKeyRotation_deg = 20.0;
/// A scan becomes a key scan after this time.
constexpr double kKeyTime_s = 2.0;
/// Half the least search window.
constexpr double kWindow_m = 0.15;
/// Half the least search window of the rotation.
constexpr double kWindow_deg = 3.0;
/// Half the greatest search window; at least kWindow_m.
constexpr double kMaxWindow_m = 0.5;
/// Half the greatest search window of the rotation; at least kWindow_deg.
constexpr double kMaxWindow_deg = 10.0;

/// Half width of the search window, in standard deviations of the predicted pose.
constexpr double kWindowSigmas = 3.0;

}  // namespace

struct ScanToMapSlam::Impl {
  explicit Impl(const GridDrawingConfig& config_in) : config(config_in), surfaces(config_in), map(config_in) {}

  void follow(const Pose2& T_odom_body, const Eigen::Matrix3d& covariance_since_last);
  bool correct(const ProjectedScan& scan);
  SearchWindow window() const;
  void drawReference();
  void addKeyScan(const ProjectedScan& scan);
  void draw(const ProjectedScan& scan) { map.draw(thinForDrawing(scan, config), pose.T_map_body); }
  DrawnHeights band() const { return heightsAround(flight_height_m.value_or(0.0), config); }

  GridDrawingConfig config;
  GaussNewtonMatcher matcher;
  SurfaceMap surfaces;
  DrawingBoard board;
  bool reference_is_old = true;  ///< The surfaces have changed since they were drawn for the matcher.
  SlicedMap map;
  std::optional<double> flight_height_m;
  std::vector<KeyPose> keys;
  SlamCounts counts;

  UncertainPose pose{Pose2{}, Eigen::Matrix3d::Zero()};  ///< Pose of the last scan.
  Pose2 T_odom_body;
  Pose2 T_map_odom;
  Time last_stamp;
  Progress last_match, last_key;
};

/// Moves the estimate by the motion that the odometry has measured since the last scan.
void ScanToMapSlam::Impl::follow(const Pose2& T_odom_body_now, const Eigen::Matrix3d& covariance_since_last) {
  const Pose2 moved = T_map_odom * T_odom_body_now;
  const Eigen::Matrix3d step_covariance = stepCovarianceOrUnknown(covariance_since_last);
  pose.covariance =
      propagated(pose.covariance, pose.T_map_body, moved, common::turned(step_covariance, pose.T_map_body.yaw_rad));
  pose.T_map_body = moved;
  T_odom_body = T_odom_body_now;
}

SearchWindow ScanToMapSlam::Impl::window() const {
  const Eigen::Vector3d sigmas = pose.covariance.diagonal().cwiseSqrt();
  return {std::clamp(kWindowSigmas * sigmas.head<2>().maxCoeff(), kWindow_m, kMaxWindow_m),
          std::clamp(kWindowSigmas * sigmas.z(), kWindow_deg * kRadPerDeg, kMaxWindow_deg * kRadPerDeg)};
}

/// Draws the surfaces that a scan from here can meet as the reference of the matcher, if they have changed.
void ScanToMapSlam::Impl::drawReference() {
  if (!reference_is_old) return;
  reference_is_old = false;
  matcher.clearReference();
  matcher.addReference(surfaces.contourAround(pose.T_map_body.position_m(), ScanMatcher::kMaxRange_m + kMaxWindow_m));
}

/// False when the scan does not match the map. The estimate is then unchanged.
bool ScanToMapSlam::Impl::correct(const ProjectedScan& scan) {
  drawReference();
  const MatchResult match = matcher.match(scan, pose.T_map_body, window());
  ++counts.map_matches;
  if (match.failed || match.at_window_edge) {
    ++counts.local_failures;
    return false;
  }
  const Eigen::Matrix3d of_map = common::planarCovariance(kMapSigma_m, kMapSigma_deg * kRadPerDeg);
  pose = weightedMean(pose, {match.T_reference_body, match.covariance + of_map});
  // The error of the map is the same in every match, so the mean of many matches is not more certain.
  pose.covariance.diagonal() = pose.covariance.diagonal().cwiseMax(of_map.diagonal());
  T_map_odom = pose.T_map_body * T_odom_body.inverse();
  return true;
}

void ScanToMapSlam::Impl::addKeyScan(const ProjectedScan& scan) {
  if (!flight_height_m) flight_height_m = scan.T_odom_body.position_m.z();
  surfaces.draw(toDraw(scan, config, band()), pose.T_map_body, board);
  reference_is_old = true;
  keys.push_back({scan.stamp, pose.T_map_body});
  ++counts.key_scans;
  last_key = {T_odom_body, scan.stamp};
}

ScanToMapSlam::ScanToMapSlam(const GridDrawingConfig& config) : impl_(std::make_unique<Impl>(config)) {}
ScanToMapSlam::~ScanToMapSlam() = default;
ScanToMapSlam::ScanToMapSlam(ScanToMapSlam&&) noexcept = default;
ScanToMapSlam& ScanToMapSlam::operator=(ScanToMapSlam&&) noexcept = default;

SlamUpdate ScanToMapSlam::addScan(const ProjectedScan& scan, const Pose2& T_odom_body,
                                  const Eigen::Matrix3d& covariance_since_last) {
  Impl& self = *impl_;
  ++self.counts.scans;
  const bool first = self.keys.empty();
  if (!isFinite(T_odom_body) || (!first && scan.stamp <= self.last_stamp) ||
      (first && static_cast<int>(scan.points_level_m.size()) < ScanMatcher::kMinPoints)) {
    ++self.counts.ignored_scans;
    return {false, false, first ? T_odom_body : self.pose.T_map_body};
  }
  self.last_stamp = scan.stamp;
  if (first) {
    // The map frame starts equal to odom.
    self.pose.T_map_body = self.T_odom_body = T_odom_body;
  } else {
    self.follow(T_odom_body, covariance_since_last);
    if (!self.last_match.exceeds(T_odom_body, scan.stamp, kMatchDistance_m, kMatchRotation_deg, kMatchTime_s))
      return {false, false, self.pose.T_map_body};
  }
  self.last_match = {T_odom_body, scan.stamp};
  const bool matched = first || self.correct(scan);
  // A scan of new area hardly matches. A key scan at its predicted pose lets the map grow there, so that the next scans
  // match.
  const bool is_key =
      first || self.last_key.exceeds(T_odom_body, scan.stamp, kKeyDistance_m, kKeyRotation_deg, kKeyTime_s);
  if (is_key) self.addKeyScan(scan);
  if (matched || is_key) self.draw(scan);
  SlamUpdate update{is_key, matched || is_key, self.pose.T_map_body};
  update.gone = self.map.takeGone();
  return update;
}

Pose2 ScanToMapSlam::T_map_odom() const { return impl_->T_map_odom; }
int ScanToMapSlam::anchor() const { return static_cast<int>(impl_->keys.size()) - 1; }

Pose2 ScanToMapSlam::T_anchor_body() const {
  return impl_->keys.empty() ? Pose2{} : between(impl_->keys.back().T_map_body, impl_->pose.T_map_body);
}

std::vector<PlanarSlam::KeyPose> ScanToMapSlam::keyPoses() const { return impl_->keys; }

bool ScanToMapSlam::setFlightHeight(double height_m) {
  if (std::isfinite(height_m)) impl_->flight_height_m = height_m;
  return impl_->map.setFlightHeight(height_m);
}

common::OccupancyGrid ScanToMapSlam::snapshot() { return impl_->map.atFlightHeight(); }
const SlamCounts& ScanToMapSlam::counts() const { return impl_->counts; }
const Eigen::Matrix3d& ScanToMapSlam::covariance() const { return impl_->pose.covariance; }

}  // namespace swiftlet::perception
