#include "perception/recognition/object_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "common/square.hpp"
#include "perception/recognition/opening_recognizer.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose3;

/// As for coloured targets: docs/decisions/cameras_and_lasers.md#050.
constexpr double kOtherView_m = 0.2;
constexpr int kConfirmedBy = 3;
/// Of these so many must have told it from a mirror, or seen the pane.
constexpr int kSureBy = 2;
/// No pattern was recognized in 2,500 pictures without one (docs/recognition.md): a second look is for the place.
constexpr int kPatternConfirmedBy = 2;
/// Greatest Mahalanobis distance, and the distance within which two openings, or two of a pattern, cannot be two.
constexpr double kGateSigma = 4.0, kOnePlace_m = 0.3;
/// The place of an opening of which a side is not seen is known to half a metre: farther apart are two.
constexpr double kFarthest_m = 1.0;
/// Attitude is off by half a degree in every look; mount and inverse depth are off alike in all of them, as for
/// coloured targets.
constexpr double kAttitudeSigma_rad = 0.5 * common::kRadPerDeg, kMountSigma_rad = 0.6 * common::kRadPerDeg;
constexpr double kInverseDepthSigma_1_m = 0.001;
/// Standard deviations of the vehicle's place in its map, and of the time of a picture, which matters in turns.
constexpr double kPlaceSigma_m = 0.02, kTimeSigma_s = 0.004;
/// So many of the places from which an object was seen are compared with the next one.
constexpr std::size_t kPlacesKept = 64;

constexpr std::array<const char*, 4> kOpeningNames = {"window", "door", "opening", "mirror"};

/// T_to_camera for a view relative to key scan `key`.
Pose3 cameraAtKey(int key, const ObjectView& view) {
  return view.keys.T_map_level(key).inverse() * view.keys.T_map_level(view.key) * view.T_key_camera;
}

PointEstimate::SharedCovariance sharedErrors() {
  PointEstimate::SharedCovariance shared = PointEstimate::SharedCovariance::Zero();
  shared.diagonal() << common::square(kMountSigma_rad), common::square(kMountSigma_rad),
      common::square(kMountSigma_rad), common::square(kInverseDepthSigma_1_m);
  return shared;
}

bool isUsable(const Recognized& one) {
  return common::isFinite(one.T_sensor_object) && one.covariance.allFinite() && one.size_m.allFinite();
}

/// From which side of its wall: whether the object's x axis points to where the camera is.
bool facesAway(const Eigen::Quaterniond& track, const Eigen::Quaterniond& measured) {
  return (track * Eigen::Vector3d::UnitX()).dot(measured * Eigen::Vector3d::UnitX()) < 0.0;
}

}  // namespace

bool isOpeningName(const std::string& what) {
  return std::find(kOpeningNames.begin(), kOpeningNames.end(), what) != kOpeningNames.end();
}

void ObjectTracker::add(const std::vector<Recognized>& recognized, const ObjectView& view) {
  const bool known_key = view.key >= 0 && static_cast<std::size_t>(view.key) < view.keys.keys.size();
  if (!known_key || !common::isFinite(view.T_key_camera) || !std::isfinite(view.position_sigma_m)) return;
  for (const Recognized& one : recognized) {
    if (!isUsable(one)) continue;
    if (Track* track = trackOf(one, view))
      update(*track, one, view);
    else
      begin(one, view);
  }
  mergeDuplicates(view.keys);
}

/// A point p in the camera, turned by a small rotation vector r, moves by r x p = -[p]x r. An inverse depth too great
/// by d moves it by -x p d; a pattern's place does not depend on the depths.
ObjectTracker::Measured ObjectTracker::measured(const Recognized& one, const ObjectView& view, int key) {
  const Pose3 T_key_camera = cameraAtKey(key, view);
  const Eigen::Matrix3d R = T_key_camera.rotation.toRotationMatrix();
  const Eigen::Vector3d& p = one.T_sensor_object.position_m;
  const Eigen::Matrix3d turning = common::skew(p);
  const double angle_rad2 = common::square(kAttitudeSigma_rad) + common::square(view.turn_rate_rad_s * kTimeSigma_s);
  Measured m;
  m.place.point_m = T_key_camera * p;
  m.place.by_shared.leftCols<3>() = -R * turning;
  m.place.by_shared.col(3) =
      isOpeningName(one.what) ? Eigen::Vector3d(R * (-p.x() * p)) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  m.place.covariance_m2 =
      R * (one.covariance.bottomRightCorner<3, 3>() + angle_rad2 * turning * turning.transpose()) * R.transpose() +
      (common::square(kPlaceSigma_m) + common::square(view.position_sigma_m)) * Eigen::Matrix3d::Identity();
  m.rotation = (T_key_camera.rotation * one.T_sensor_object.rotation).normalized();
  const Eigen::Matrix3d turned = R * one.covariance.topLeftCorner<3, 3>() * R.transpose();
  m.heading_variance_rad2 = std::max(0.0, turned(2, 2)) + angle_rad2;
  return m;
}

/// The nearest of its kind within the errors of both.
ObjectTracker::Track* ObjectTracker::trackOf(const Recognized& one, const ObjectView& view) {
  const std::string name = isOpeningName(one.what) ? std::string() : one.what;
  Track* nearest = nullptr;
  double least_m = std::numeric_limits<double>::infinity();
  for (Track& track : tracks_) {
    if (track.name != name) continue;
    const PointMeasurement place = measured(one, view, track.key).place;
    const double apart_m = (place.point_m - track.place_key.point_m()).norm();
    const bool same = apart_m <= kOnePlace_m ||
                      (apart_m <= kFarthest_m && track.place_key.distanceSquared(place) <= common::square(kGateSigma));
    if (!same || !(apart_m < least_m)) continue;
    nearest = &track;
    least_m = apart_m;
  }
  return nearest;
}

void ObjectTracker::begin(const Recognized& one, const ObjectView& view) {
  const Measured m = measured(one, view, view.key);
  Track track{.id = ++last_id_,
              .name = isOpeningName(one.what) ? std::string() : one.what,
              .key = view.key,
              .place_key = PointEstimate(m.place, sharedErrors()),
              .rotation_key_object = m.rotation,
              .heading_variance_rad2 = m.heading_variance_rad2,
              .from_key_m = {view.T_key_camera.position_m},
              .size_m = one.size_m,
              .last_seen = view.stamp};
  count(one, track);
  tracks_.push_back(std::move(track));
}

void ObjectTracker::update(Track& track, const Recognized& one, const ObjectView& view) {
  track.last_seen = view.stamp;
  const Eigen::Vector3d from_key_m = cameraAtKey(track.key, view).position_m;
  const bool known = std::any_of(track.from_key_m.begin(), track.from_key_m.end(), [&](const Eigen::Vector3d& place) {
    return (place - from_key_m).norm() < kOtherView_m;
  });
  if (known) return;
  if (track.from_key_m.size() == kPlacesKept) track.from_key_m.erase(track.from_key_m.begin());
  track.from_key_m.push_back(from_key_m);
  count(one, track);
  const Measured m = measured(one, view, track.key);
  // Behind the wall is its other face, which is farther by the thickness of the wall.
  if (track.name.empty() && facesAway(track.rotation_key_object, m.rotation)) return;
  track.place_key.update(m.place);
  const double gain = track.heading_variance_rad2 / (track.heading_variance_rad2 + m.heading_variance_rad2);
  track.rotation_key_object = track.rotation_key_object.slerp(gain, m.rotation).normalized();
  track.heading_variance_rad2 *= 1.0 - gain;
  track.size_m = track.size_m.cwiseMax(one.size_m);
}

void ObjectTracker::count(const Recognized& one, Track& track) {
  ++track.looks;
  Evidence& evidence = track.evidence;
  const bool is_sure = one.confidence > kSureOpening;
  if (one.what == "mirror") ++evidence.mirror;
  if (one.passage == Passage::kOpen && is_sure) ++evidence.open;
  if (one.passage == Passage::kClosed && one.what != "mirror") ++evidence.closed;
  if (one.what == "door") ++evidence.doors;
  if (one.what == "window") ++evidence.windows;
}

/// Two in one place are one, seen before and after the map was corrected. The one with more looks stays.
void ObjectTracker::mergeDuplicates(const common::KeyPoses& keys) {
  const auto inMap = [&](const Track& track) -> Eigen::Vector3d {
    return keys.T_map_level(track.key) * track.place_key.point_m();
  };
  for (std::size_t a = 0; a < tracks_.size(); ++a)
    for (std::size_t b = a + 1; b < tracks_.size();) {
      if (tracks_[a].name != tracks_[b].name || (inMap(tracks_[a]) - inMap(tracks_[b])).norm() > kOnePlace_m) {
        ++b;
        continue;
      }
      if (tracks_[b].looks > tracks_[a].looks) std::swap(tracks_[a], tracks_[b]);
      tracks_[a].id = std::min(tracks_[a].id, tracks_[b].id);
      tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(b));
    }
}

void ObjectTracker::judge(const Evidence& evidence, common::RecognizedObject& object) {
  object.what = evidence.mirror >= std::max(1, evidence.open) ? "mirror"
                : evidence.doors + evidence.windows == 0      ? "opening"
                : evidence.doors > evidence.windows           ? "door"
                                                              : "window";
  if (object.looks < kConfirmedBy) return;
  const bool is_mirror = object.what == "mirror";
  if (!is_mirror && evidence.open >= kSureBy && evidence.open > evidence.closed) object.passage = Passage::kOpen;
  if (!is_mirror && evidence.closed >= kSureBy && evidence.closed >= evidence.open) object.passage = Passage::kClosed;
  object.confirmed = is_mirror || object.passage != Passage::kNone;
}

std::vector<common::RecognizedObject> ObjectTracker::objects(const common::KeyPoses& keys) const {
  std::vector<common::RecognizedObject> objects;
  for (const Track& track : tracks_) {
    const Pose3 T_map_key = keys.T_map_level(track.key);
    const Eigen::Matrix3d R_map_key = T_map_key.rotation.toRotationMatrix();
    common::RecognizedObject object;
    object.id = track.id;
    object.T_map_object = T_map_key * Pose3{track.rotation_key_object, track.place_key.point_m()};
    object.covariance_m2 = R_map_key * track.place_key.covariance_m2() * R_map_key.transpose();
    object.yaw_sigma_rad = std::sqrt(track.heading_variance_rad2 + common::square(kMountSigma_rad));
    object.size_m = track.size_m;
    object.looks = track.looks;
    object.last_seen = track.last_seen;
    if (track.name.empty()) {
      judge(track.evidence, object);
    } else {
      object.what = track.name;
      object.confirmed = track.looks >= kPatternConfirmedBy;
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace swiftlet::perception
