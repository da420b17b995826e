#include "mapping3d/odometry/key_frame_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

/// A key frame is added where less than this part of the nearest one's points is in the picture.
constexpr double kCovered = 0.6;
/// A key frame is added where the nearest one is turned by more than this against the picture.
constexpr double kGreatestTurn_rad = 0.35;
/// A key frame is added where the nearest one is farther away than this part of its median depth.
constexpr double kGreatestStep = 0.2;
/// Of the points of the coarsest level, one in this many is looked at for the overlap.
constexpr std::size_t kSampleStep = 8;
/// Key frames that see a smaller part of the picture do not help.
constexpr double kLeastOverlap = 0.25;

double overlapOf(const std::vector<ReferencePoint>& points, const common::Pose3& T_camera_key,
                 const common::PinholeCamera& camera) {
  int seen = 0, all = 0;
  const Eigen::Matrix3d rotation = T_camera_key.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < points.size(); i += kSampleStep) {
    ++all;
    const Eigen::Vector3d point = rotation * points[i].point_camera_m.cast<double>() + T_camera_key.position_m;
    if (point.x() <= 0.0) continue;
    const Eigen::Vector2d pixel = camera.pixel(point);
    if (pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < camera.width_px && pixel.y() < camera.height_px) ++seen;
  }
  return all > 0 ? static_cast<double>(seen) / all : 0.0;
}

double turnBetween_rad(const common::Pose3& a, const common::Pose3& b) {
  return a.rotation.angularDistance(b.rotation);
}

}  // namespace

void KeyFrameMap::add(std::shared_ptr<const KeyFrame> key, const KeyFramePlace& place) {
  if (static_cast<int>(keys_.size()) >= greatest_number_) {
    const auto oldest =
        std::min_element(keys_.begin(), keys_.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
    places_.remove(oldest->number, oldest->frame->described);
    keys_.erase(oldest);
  }
  places_.add(next_number_, key->described);
  keys_.push_back(
      {std::move(key), place, T_map_scan(place.scan).inverse() * place.T_map_key, ++clock_, next_number_++});
}

void KeyFrameMap::hang(std::size_t index, int scan) {
  Kept& kept = keys_[index];
  kept.place.scan = scan;
  kept.T_scan_key = T_map_scan(scan).inverse() * kept.place.T_map_key;
}

void KeyFrameMap::joinTracks(int from, int into) {
  for (Kept& kept : keys_)
    if (kept.place.track == from) kept.place.track = into;
}

common::Pose3 KeyFrameMap::T_map_scan(int scan) const { return scans_ ? scans_->T_map_level(scan) : common::Pose3{}; }

void KeyFrameMap::moveTo(std::shared_ptr<const common::KeyPoses> scans) {
  scans_ = std::move(scans);
  for (Kept& kept : keys_) kept.place.T_map_key = T_map_scan(kept.place.scan) * kept.T_scan_key;
}

std::vector<std::size_t> KeyFrameMap::overlapping(const common::PinholeCamera& coarsest,
                                                  const common::Pose3& T_map_camera, std::optional<int> track,
                                                  std::size_t greatest) const {
  struct Ranked {
    std::size_t index;
    double score;
  };
  std::vector<Ranked> ranked;
  const common::Pose3 T_camera_map = T_map_camera.inverse();
  // Of equal ones the newest.
  for (std::size_t i = keys_.size(); i-- > 0;) {
    if (track && keys_[i].place.track != *track) continue;
    const KeyFrame& key = *keys_[i].frame;
    const common::Pose3& T_map_key = keys_[i].place.T_map_key;
    const double overlap = overlapOf(key.levels.back(), T_camera_map * T_map_key, coarsest);
    if (overlap < kLeastOverlap) continue;
    // Of views that overlap alike, the one from nearer by looks more alike.
    const double distance = (T_map_key.position_m - T_map_camera.position_m).norm() / std::max(key.median_depth_m, 0.3);
    ranked.push_back({i, overlap - 0.5 * distance - 0.3 * turnBetween_rad(T_map_key, T_map_camera)});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.score > b.score; });
  std::vector<std::size_t> indices;
  for (const Ranked& one : ranked)
    if (indices.size() < greatest && placeOf(one.index).track == placeOf(ranked.front().index).track)
      indices.push_back(one.index);
  return indices;
}

std::vector<ReferenceView> KeyFrameMap::views(const std::vector<std::size_t>& indices) const {
  std::vector<ReferenceView> views;
  for (const std::size_t index : indices) views.push_back({placeOf(index).T_map_key, &at(index).levels});
  return views;
}

void KeyFrameMap::markUsed(const std::vector<std::size_t>& indices) {
  ++clock_;
  for (const std::size_t index : indices) keys_[index].used = clock_;
}

std::vector<std::size_t> KeyFrameMap::similar(const std::vector<DescribedPoint>& points, std::size_t greatest) const {
  std::vector<std::size_t> indices;
  for (const std::uint64_t number : places_.similar(points, greatest)) {
    const auto kept = std::lower_bound(keys_.begin(), keys_.end(), number,
                                       [](const Kept& one, std::uint64_t sought) { return one.number < sought; });
    indices.push_back(static_cast<std::size_t>(kept - keys_.begin()));
  }
  return indices;
}

bool KeyFrameMap::needsNew(const std::vector<std::size_t>& overlapping, const common::Pose3& T_map_camera,
                           double overlap) const {
  if (overlapping.empty() || overlap < kCovered) return true;
  const common::Pose3& T_map_nearest = placeOf(overlapping.front()).T_map_key;
  const double step_m = (T_map_nearest.position_m - T_map_camera.position_m).norm();
  return turnBetween_rad(T_map_nearest, T_map_camera) > kGreatestTurn_rad ||
         step_m > kGreatestStep * at(overlapping.front()).median_depth_m;
}

}  // namespace swiftlet::mapping3d
