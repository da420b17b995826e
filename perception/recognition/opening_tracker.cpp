#include "perception/recognition/opening_tracker.hpp"

#include <algorithm>

#include <Eigen/LU>

#include "common/square.hpp"
#include "perception/recognition/opening_recognizer.hpp"

namespace swiftlet::perception {
namespace {

/// As for coloured targets: docs/decisions/cameras_and_lasers.md#050.
constexpr double kOtherView_m = 0.2;
constexpr int kConfirmedBy = 3;
/// Of these so many must have told it from a mirror, or seen the pane.
constexpr int kSureBy = 2;
/// Greatest Mahalanobis distance, and the distance within which two openings cannot be two.
constexpr double kGate = 4.0, kOnePlace_m = 0.3;
/// Attitude and mount are off by half a degree in every look.
constexpr double kAngleSigma_rad = 0.5 * common::kRadPerDeg;

}  // namespace

void OpeningTracker::add(const std::vector<Recognized>& recognized, const common::Pose3& T_map_camera,
                         double position_sigma_m) {
  if (!common::isFinite(T_map_camera)) return;
  const Eigen::Matrix3d R = T_map_camera.rotation.toRotationMatrix();
  for (const Recognized& one : recognized) {
    const Eigen::Vector3d centre = T_map_camera * one.T_sensor_object.position_m;
    const double off_m2 =
        common::square(position_sigma_m) + common::square(kAngleSigma_rad * one.T_sensor_object.position_m.norm());
    const Eigen::Matrix3d covariance =
        R * one.covariance.bottomRightCorner<3, 3>() * R.transpose() + off_m2 * Eigen::Matrix3d::Identity();
    Track* track = trackOf(centre, covariance);
    if (track == nullptr) {
      tracks_.push_back({});
      track = &tracks_.back();
      track->opening.id = static_cast<int>(tracks_.size());
      track->opening.centre_map_m = centre;
      track->opening.covariance_m2 = covariance;
    } else {
      const bool known = std::any_of(track->from_map_m.begin(), track->from_map_m.end(), [&](const auto& from) {
        return (from - T_map_camera.position_m).norm() < kOtherView_m;
      });
      if (known) continue;
      Eigen::Matrix3d& P = track->opening.covariance_m2;
      const Eigen::Matrix3d gain = P * (P + covariance).inverse();
      track->opening.centre_map_m += gain * (centre - track->opening.centre_map_m);
      P = (Eigen::Matrix3d::Identity() - gain) * P;
    }
    track->from_map_m.push_back(T_map_camera.position_m);
    track->opening.normal_map = R * (one.T_sensor_object.rotation * Eigen::Vector3d::UnitX());
    track->opening.size_m = track->opening.size_m.cwiseMax(one.size_m);
    ++track->opening.looks;
    count(one, track->evidence);
  }
}

void OpeningTracker::count(const Recognized& one, Evidence& evidence) {
  const bool is_sure = one.confidence > kSureOpening;
  if (one.what == "mirror") ++evidence.mirror;
  if (one.passage == Passage::kOpen && is_sure) ++evidence.open;
  if (one.passage == Passage::kClosed && one.what != "mirror") ++evidence.closed;
  if (one.what == "door") ++evidence.doors;
  if (one.what == "window") ++evidence.windows;
}

/// The nearest in the middle of which it lies, or whose centre is in the same place within the errors of both.
OpeningTracker::Track* OpeningTracker::trackOf(const Eigen::Vector3d& centre_map_m,
                                               const Eigen::Matrix3d& covariance_m2) {
  Track* nearest = nullptr;
  for (Track& track : tracks_) {
    const Eigen::Vector3d off = centre_map_m - track.opening.centre_map_m;
    const Eigen::Matrix3d both = track.opening.covariance_m2 + covariance_m2;
    if (off.norm() > kOnePlace_m && off.dot(both.inverse() * off) > common::square(kGate)) continue;
    if (nearest == nullptr || off.norm() < (centre_map_m - nearest->opening.centre_map_m).norm()) nearest = &track;
  }
  return nearest;
}

std::vector<TrackedOpening> OpeningTracker::openings() const {
  std::vector<TrackedOpening> openings;
  for (const Track& track : tracks_) {
    openings.push_back(track.opening);
    const Evidence& evidence = track.evidence;
    TrackedOpening& opening = openings.back();
    opening.what = evidence.mirror >= std::max(1, evidence.open) ? "mirror"
                   : evidence.doors + evidence.windows == 0      ? "opening"
                   : evidence.doors > evidence.windows           ? "door"
                                                                 : "window";
    if (opening.looks < kConfirmedBy || opening.what == "mirror") continue;
    if (evidence.open >= kSureBy && evidence.open > evidence.closed) opening.passage = Passage::kOpen;
    if (evidence.closed >= kSureBy && evidence.closed >= evidence.open) opening.passage = Passage::kClosed;
  }
  return openings;
}

}  // namespace swiftlet::perception
