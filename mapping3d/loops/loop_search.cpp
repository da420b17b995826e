#include "mapping3d/loops/loop_search.hpp"

#include <algorithm>
#include <optional>

#include "mapping3d/odometry/frame_pyramid.hpp"
#include "mapping3d/odometry/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

/// From the key frame to the newest one; none if it does not show the same place.
std::optional<KeyFrameEdge> aligned(const FramePyramid& pyramid, const RgbdPose& pose, const KeyFrame& newest,
                                    const KeyFrame& key, int scan, const RgbdOdometryConfig& odometry,
                                    const LoopSearchConfig& config) {
  const auto seed = static_cast<std::uint64_t>(scan);
  const auto found = registerPoints(key.described, newest.described, seed, odometry.recognition);
  if (!found) return std::nullopt;
  const std::vector<ReferenceView> view{{common::Pose3{}, &key.levels}};
  const Alignment fit = align(pyramid, view, {found->T_a_b, Matrix6d::Zero()}, pose.fit.exposure,
                              odometry.features.depth_noise, odometry.alignment);
  if (fit.overlap < config.least_overlap || !isGoodFit(fit, odometry)) return std::nullopt;
  return KeyFrameEdge{scan, fit.T_map_camera, fit.measured_information};
}

}  // namespace

bool isOld(int scan, int newest, const LoopSearchConfig& config) { return newest - scan > config.apart; }

std::vector<KeyFrameEdge> trackEdges(const RgbdPose& pose, int number, const KeyFrameMap& keys,
                                     const LoopSearchConfig& config) {
  if (pose.aligned_to.empty()) return {};
  const auto recent = std::find_if(pose.aligned_to.begin(), pose.aligned_to.end(),
                                   [&](int from) { return !isOld(from, number, config); });
  const int from = recent != pose.aligned_to.end() ? *recent : pose.aligned_to.front();
  return {{from, keys.T_map_scan(from).inverse() * pose.T_map_camera, pose.fit.measured_information}};
}

std::vector<KeyFrameEdge> findLoops(const common::RgbdFrame& frame, const RgbdPose& pose, const KeyFrameMap& keys,
                                    const RgbdOdometryConfig& odometry, const LoopSearchConfig& config) {
  std::vector<KeyFrameEdge> loops;
  if (config.candidates == 0) return loops;
  const KeyFrame& newest = keys.at(keys.size() - 1);
  std::optional<FramePyramid> pyramid;
  int tried = 0;
  const auto greatest = static_cast<std::size_t>(config.candidates + config.apart + 1);
  for (const std::size_t index : keys.similar(newest.described, greatest)) {
    const int scan = keys.placeOf(index).scan;
    if (!isOld(scan, keys.placeOf(keys.size() - 1).scan, config)) continue;
    if (tried++ == config.candidates) break;
    if (!pyramid) pyramid = makePyramid(frame, odometry.greatest_width_px, odometry.levels);
    if (const auto edge = aligned(*pyramid, pose, newest, keys.at(index), scan, odometry, config))
      loops.push_back(*edge);
  }
  return loops;
}

}  // namespace swiftlet::mapping3d
