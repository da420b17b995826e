#include "mapping3d/loops/loop_search.hpp"

#include <algorithm>

#include "mapping3d/odometry/found_place.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

/// This many of the newest key frames are no candidates: the track connects them.
constexpr int kApart = 5;
/// Part of a candidate's points that must lie in the picture.
constexpr double kLeastOverlap = 0.4;

/// Key frames that a new one is connected to, at most.
constexpr std::size_t kMostEdges = 5;

/// Whether a key frame is so old that an alignment of the newest one to it closes a loop.
bool isOld(int scan, int newest) { return newest - scan > kApart; }

/// The frame as a key frame alone shows it, from a pose that is nearly right.
Alignment alignedTo(const KeyFrame& key, const FramePyramid& frame, const common::Pose3& T_key_frame,
                    const Exposure& exposure, const RgbdOdometryConfig& odometry) {
  const std::vector<ReferenceView> view{{common::Pose3{}, &key.levels}};
  return align(frame, view, {T_key_frame, Matrix6d::Zero()}, exposure, odometry.features.depth_noise,
               odometry.alignment, T_key_frame);
}

bool showsSame(const Alignment& fit, const common::Pose3& T_key_frame) {
  return fit.overlap >= kLeastOverlap && isGoodFit(fit) && isConfirmed(fit, T_key_frame);
}

/// Whether two key frames of other pieces place the newest one differently in the same piece, or both claim it.
bool contradict(const KeyFrameMap& keys, const std::vector<std::size_t>& met, const std::vector<KeyFrameEdge>& edges) {
  for (std::size_t i = 1; i < met.size(); ++i) {
    const KeyFramePlace &first = keys.placeOf(met.front()), &other = keys.placeOf(met[i]);
    if (first.track == other.track &&
        !isSamePlace(first.T_map_key * edges.front().T_from_to, other.T_map_key * edges[i].T_from_to))
      return true;
  }
  return false;
}

}  // namespace

std::vector<KeyFrameEdge> trackEdges(const FramePyramid& frame, const RgbdPose& pose, int number,
                                     const KeyFrameMap& keys, const RgbdOdometryConfig& odometry) {
  if (pose.aligned_to.empty()) return {};
  const int track = keys.placeOf(keys.size() - 1).track;
  std::vector<KeyFrameEdge> edges;
  for (const std::size_t index : keys.overlapping(frame.back().camera, pose.T_map_camera, track, kMostEdges + 1)) {
    const KeyFramePlace& place = keys.placeOf(index);
    if (index + 1 == keys.size() || isOld(place.scan, number)) continue;
    const common::Pose3 T_key_frame = place.T_map_key.inverse() * pose.T_map_camera;
    const Alignment fit = alignedTo(keys.at(index), frame, T_key_frame, pose.fit.exposure, odometry);
    if (showsSame(fit, T_key_frame)) edges.push_back({place.scan, fit.T_map_camera, fit.measured_information});
  }
  if (!edges.empty()) return edges;
  const auto recent =
      std::find_if(pose.aligned_to.begin(), pose.aligned_to.end(), [&](int from) { return !isOld(from, number); });
  const int from = recent != pose.aligned_to.end() ? *recent : pose.aligned_to.front();
  return {{from, keys.T_map_scan(from).inverse() * pose.T_map_camera, pose.fit.measured_information}};
}

PlaceMatches findPlace(const FramePyramid& frame, const RgbdPose& pose, const KeyFrameMap& keys,
                       const RgbdOdometryConfig& odometry, int candidates) {
  PlaceMatches matches;
  if (candidates == 0) return matches;
  const KeyFrame& newest = keys.at(keys.size() - 1);
  const KeyFramePlace& here = keys.placeOf(keys.size() - 1);
  std::vector<std::size_t> met;
  int tried = 0;
  for (const std::size_t index : keys.similar(newest.described, static_cast<std::size_t>(candidates + kApart + 1))) {
    const KeyFramePlace& place = keys.placeOf(index);
    const bool is_foreign = place.track != here.track;
    if (!is_foreign && !isOld(place.scan, here.scan)) continue;
    if (tried++ == candidates) break;
    const auto found =
        vision::registerPoints(keys.at(index).described, newest.described, static_cast<std::uint64_t>(place.scan));
    if (!found) continue;
    const Alignment fit = alignedTo(keys.at(index), frame, *found, pose.fit.exposure, odometry);
    if (!showsSame(fit, *found) || (is_foreign && !isRecognized(fit))) continue;
    (is_foreign ? matches.meetings : matches.loops).push_back({place.scan, fit.T_map_camera, fit.measured_information});
    if (is_foreign) met.push_back(index);
  }
  if (contradict(keys, met, matches.meetings)) matches.meetings.clear();
  return matches;
}

}  // namespace swiftlet::mapping3d
