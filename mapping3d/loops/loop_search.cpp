#include "mapping3d/loops/loop_search.hpp"

#include <algorithm>
#include <optional>

#include "mapping3d/odometry/frame_pyramid.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

/// This many of the newest key frames are no candidates: the track connects them.
constexpr int kApart = 5;
/// Part of a candidate's points that must lie in the picture.
constexpr double kLeastOverlap = 0.4;

/// Whether a key frame is so old that an alignment of the newest one to it closes a loop.
bool isOld(int scan, int newest) { return newest - scan > kApart; }

/// From the key frame to the newest one; none if it does not show the same place.
std::optional<KeyFrameEdge> aligned(const FramePyramid& pyramid, const RgbdPose& pose, const KeyFrame& newest,
                                    const KeyFrame& key, int scan, const RgbdOdometryConfig& odometry) {
  const auto seed = static_cast<std::uint64_t>(scan);
  const auto found = registerPoints(key.described, newest.described, seed);
  if (!found) return std::nullopt;
  const std::vector<ReferenceView> view{{common::Pose3{}, &key.levels}};
  const Alignment fit = align(pyramid, view, {*found, Matrix6d::Zero()}, pose.fit.exposure,
                              odometry.features.depth_noise, odometry.alignment);
  if (fit.overlap < kLeastOverlap || !isGoodFit(fit)) return std::nullopt;
  return KeyFrameEdge{scan, fit.T_map_camera, fit.measured_information};
}

}  // namespace

std::vector<KeyFrameEdge> trackEdges(const RgbdPose& pose, int number, const KeyFrameMap& keys) {
  if (pose.aligned_to.empty()) return {};
  const auto recent =
      std::find_if(pose.aligned_to.begin(), pose.aligned_to.end(), [&](int from) { return !isOld(from, number); });
  const int from = recent != pose.aligned_to.end() ? *recent : pose.aligned_to.front();
  return {{from, keys.T_map_scan(from).inverse() * pose.T_map_camera, pose.fit.measured_information}};
}

std::vector<KeyFrameEdge> findLoops(const common::RgbdFrame& frame, const RgbdPose& pose, const KeyFrameMap& keys,
                                    const RgbdOdometryConfig& odometry, int candidates) {
  std::vector<KeyFrameEdge> loops;
  if (candidates == 0) return loops;
  const KeyFrame& newest = keys.at(keys.size() - 1);
  std::optional<FramePyramid> pyramid;
  int tried = 0;
  const auto greatest = static_cast<std::size_t>(candidates + kApart + 1);
  for (const std::size_t index : keys.similar(newest.described, greatest)) {
    const int scan = keys.placeOf(index).scan;
    if (!isOld(scan, keys.placeOf(keys.size() - 1).scan)) continue;
    if (tried++ == candidates) break;
    if (!pyramid) pyramid = makePyramid(frame);
    if (const auto edge = aligned(*pyramid, pose, newest, keys.at(index), scan, odometry)) loops.push_back(*edge);
  }
  return loops;
}

}  // namespace swiftlet::mapping3d
