#include "perception/targets/target_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "common/geometry.hpp"
#include "common/square.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose3;

/// Places from which a target must be seen to count as found (docs/decisions/cameras_and_lasers.md#050).
constexpr int kConfirmViews = 3;
/// Least distance between two places from which a target is seen; a picture from a place before is no new measurement
/// (docs/decisions/cameras_and_lasers.md#050).
constexpr double kViewDistance_m = 0.2;
/// Standard deviation of the vehicle's attitude.
constexpr double kAttitudeSigma_deg = 0.4;
/// Standard deviation of the camera's error of inverse depth that is equal in all pictures.
constexpr double kInverseDepthSigma_1_m = 0.001;
/// Standard deviation of the time of a picture: it matters in turns.
constexpr double kTimeSigma_s = 0.004;
/// Greatest Mahalanobis distance of a sighting from its target.
constexpr double kGateSigma = 4.0;
/// A candidate is dropped after this many pictures with a free-space violation of its place.
constexpr int kMissesMax = 6;

/// This many of the places from which a target was seen are compared with the next one.
constexpr std::size_t kPlacesKept = 64;
/// A sighting nearer to a target of its class than this share of their diameter is of that target, even if the
/// estimates differ: two things cannot be in one place.
constexpr double kSameShare = 0.8;
/// A depth this much greater than that of a target is a free-space violation of its place.
constexpr double kThrough_m = 0.4;
/// The rim of the picture, where a target need not be whole, as a share of its width.
constexpr double kRim = 0.1;

/// T_to_camera for a view relative to key scan `key`.
Pose3 cameraIn(int key, const TargetView& view) {
  return view.keys.T_map_level(key).inverse() * view.keys.T_map_level(view.key) * view.T_key_camera;
}

bool isUsable(const TargetSighting& sighting) {
  return sighting.point_camera_m.allFinite() && sighting.covariance_m2.allFinite() &&
         sighting.point_camera_m.x() > 0.0 && std::isfinite(sighting.diameter_m);
}

PointEstimate::SharedCovariance sharedCovariance(const TargetTrackerConfig& config) {
  const double mount_rad = config.mount_sigma_deg * common::kRadPerDeg;
  PointEstimate::SharedCovariance shared = PointEstimate::SharedCovariance::Zero();
  shared.diagonal() << common::square(mount_rad), common::square(mount_rad), common::square(mount_rad),
      common::square(kInverseDepthSigma_1_m);
  return shared;
}

}  // namespace

TargetTracker::TargetTracker(const TargetTrackerConfig& config, std::vector<TargetClassConfig> classes, double range_m)
    : config_(config),
      range_m_(range_m),
      classes_(std::move(classes)),
      shared_(sharedCovariance(config)),
      last_number_(classes_.size()) {}

void TargetTracker::add(const std::vector<TargetSighting>& sightings, const TargetView& view) {
  const bool known_key = view.key >= 0 && static_cast<std::size_t>(view.key) < view.keys.keys.size();
  if (!known_key || !isFinite(view.T_key_camera) || !std::isfinite(view.position_sigma_m)) return;
  for (Track& track : tracks_) track.seen_now = false;
  for (const TargetSighting& sighting : sightings) {
    if (!isUsable(sighting) || sighting.color >= classes_.size()) continue;
    if (Track* track = trackOf(sighting, view))
      update(*track, sighting, view);
    else
      begin(sighting, view);
  }
  dropViolated(view);
  mergeDuplicates(view.keys);
}

/// A point p in the camera, turned by a small rotation vector r of the mount, moves by r x p = -[p]x r. An inverse
/// depth too great by d moves it by -x p d.
PointMeasurement TargetTracker::measurement(const TargetSighting& sighting, const TargetView& view, int key) const {
  const Pose3 T_key_camera = cameraIn(key, view);
  const Eigen::Matrix3d R_key_camera = T_key_camera.rotation.toRotationMatrix();
  const Eigen::Vector3d& p = sighting.point_camera_m;
  PointMeasurement m;
  m.point_m = T_key_camera * p;
  Eigen::Matrix<double, 3, kSharedErrors> by_shared;
  by_shared.leftCols<3>() = -common::skew(p);
  by_shared.col(3) = -p.x() * p;
  m.by_shared = R_key_camera * by_shared;
  const double angle_rad = std::hypot(kAttitudeSigma_deg * common::kRadPerDeg, view.turn_rate_rad_s * kTimeSigma_s);
  const Eigen::Matrix3d turning = common::skew(p);
  m.covariance_m2 =
      R_key_camera * (sighting.covariance_m2 + common::square(angle_rad) * turning * turning.transpose()) *
          R_key_camera.transpose() +
      (common::square(config_.position_sigma_m) + common::square(view.position_sigma_m)) * Eigen::Matrix3d::Identity();
  return m;
}

/// The nearest by Mahalanobis distance among those of its class that no sighting of this frame belongs to yet.
TargetTracker::Track* TargetTracker::trackOf(const TargetSighting& sighting, const TargetView& view) {
  Track* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Track& track : tracks_) {
    if (track.color != sighting.color || track.seen_now) continue;
    const PointMeasurement m = measurement(sighting, view, track.key);
    const double distance = track.place_key.distanceSquared(m);
    const double apart_m = (m.point_m - track.place_key.point_m()).norm();
    const bool same = distance <= common::square(kGateSigma) ||
                      apart_m < kSameShare * std::max(track.diameter_m, sighting.diameter_m);
    if (!same || !(distance < least)) continue;
    nearest = &track;
    least = distance;
  }
  return nearest;
}

void TargetTracker::begin(const TargetSighting& sighting, const TargetView& view) {
  const int key = view.key;
  Track track{.id = ++last_id_,
              .color = sighting.color,
              .key = key,
              .place_key = PointEstimate(measurement(sighting, view, key), shared_),
              .views_key_m = {view.T_key_camera.position_m},
              .views = 1,
              .diameter_m = sighting.diameter_m,
              .seen_now = true};
  confirm(track);
  tracks_.push_back(std::move(track));
}

/// A picture from a place before shares its errors, except for the noise of its pixels, which is small.
void TargetTracker::update(Track& track, const TargetSighting& sighting, const TargetView& view) {
  track.seen_now = true;
  track.misses = 0;
  const Eigen::Vector3d from_key_m = cameraIn(track.key, view).position_m;
  const bool known = std::any_of(track.views_key_m.begin(), track.views_key_m.end(), [&](const Eigen::Vector3d& place) {
    return (place - from_key_m).norm() < kViewDistance_m;
  });
  const PointMeasurement m = measurement(sighting, view, track.key);
  if (known || track.place_key.distanceSquared(m) > common::square(kGateSigma)) return;
  track.place_key.update(m);
  track.diameter_m += (sighting.diameter_m - track.diameter_m) / ++track.views;
  if (track.views_key_m.size() == kPlacesKept) track.views_key_m.erase(track.views_key_m.begin());
  track.views_key_m.push_back(from_key_m);
  confirm(track);
}

void TargetTracker::confirm(Track& track) {
  if (track.number == 0 && track.views >= kConfirmViews) track.number = ++last_number_[track.color];
}

/// A candidate that is in the middle of the picture and in range, where the camera sees something farther.
void TargetTracker::dropViolated(const TargetView& view) {
  const common::PinholeCamera& camera = view.frame.camera;
  std::erase_if(tracks_, [&](Track& track) {
    if (track.number > 0 || track.seen_now) return false;
    const Eigen::Vector3d p = cameraIn(track.key, view).inverse() * track.place_key.point_m();
    if (!(p.x() > 0.1)) return false;
    const Eigen::Vector2d pixel = camera.pixel(p);
    const double rim_px = kRim * camera.width_px;
    if (!(pixel.minCoeff() > rim_px) || !(pixel.x() < camera.width_px - rim_px) ||
        !(pixel.y() < camera.height_px - rim_px))
      return false;
    const float depth_m = view.frame.depth.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    const double seen_m = depth_m == common::DepthImage::kTooFar ? range_m_ : static_cast<double>(depth_m);
    if (seen_m > p.x() + kThrough_m) ++track.misses;
    return track.misses >= kMissesMax;
  });
}

/// Two targets of a class in each other's place are one, seen before and after the map was corrected. The
/// one with more views stays.
void TargetTracker::mergeDuplicates(const common::KeyPoses& keys) {
  const auto inMap = [&](const Track& track) -> Eigen::Vector3d {
    return keys.T_map_level(track.key) * track.place_key.point_m();
  };
  for (std::size_t a = 0; a < tracks_.size(); ++a)
    for (std::size_t b = a + 1; b < tracks_.size();) {
      const double within_m = kSameShare * std::max(tracks_[a].diameter_m, tracks_[b].diameter_m);
      if (tracks_[a].color != tracks_[b].color || (inMap(tracks_[a]) - inMap(tracks_[b])).norm() >= within_m) {
        ++b;
        continue;
      }
      const bool second_stays = tracks_[b].views > tracks_[a].views && tracks_[a].number == 0;
      if (second_stays) std::swap(tracks_[a], tracks_[b]);
      tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(b));
    }
}

std::vector<common::Target> TargetTracker::targets(const common::KeyPoses& keys) const {
  std::vector<common::Target> targets;
  for (const Track& track : tracks_) {
    const Pose3 T_map_key = keys.T_map_level(track.key);
    const Eigen::Matrix3d R_map_key = T_map_key.rotation.toRotationMatrix();
    targets.push_back({.id = track.id,
                       .name = classes_[track.color].name,
                       .number = track.number,
                       .position_map_m = T_map_key * track.place_key.point_m(),
                       .covariance_m2 = R_map_key * track.place_key.covariance_m2() * R_map_key.transpose(),
                       .diameter_m = track.diameter_m,
                       .views = track.views,
                       .state = track.number > 0 ? common::TargetState::kFound : common::TargetState::kCandidate});
  }
  std::sort(targets.begin(), targets.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return targets;
}

}  // namespace swiftlet::perception
