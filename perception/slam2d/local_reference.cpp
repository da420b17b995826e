#include "perception/slam2d/local_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swiftlet::perception {
namespace {

using common::Pose2;

/// Greatest number of key scans in the reference of the local match.
constexpr int kLocalScans = 10;

/// Two poses that are closer than this, in position and in heading, have the same view.
constexpr double kSameView_m = 0.7;
constexpr double kSameView_rad = 40.0 * std::numbers::pi / 180.0;

bool isSameView(const Pose2& a, const Pose2& b) {
  return distance(a, b) < kSameView_m && std::abs(common::wrapAngle(a.yaw_rad - b.yaw_rad)) < kSameView_rad;
}

}  // namespace

std::vector<int> connectedKeys(const SlamGraph& graph, int anchor, const Pose2& T_map_body,
                               const Slam2dConfig& config) {
  std::vector<int> connected;
  for (const ProjectedUncertainty& u : projectUncertainty(graph, anchor, config.local_sigma_m))
    if (distance(graph.keys[static_cast<std::size_t>(u.key)].T_map_body, T_map_body) < config.local_radius_m)
      connected.push_back(u.key);
  std::sort(connected.begin(), connected.end());
  return connected;
}

std::vector<int> localReferenceKeys(const SlamGraph& graph, const std::vector<int>& connected, int anchor,
                                    const Pose2& T_map_body) {
  const auto poseOf = [&](int key) -> const Pose2& { return graph.keys[static_cast<std::size_t>(key)].T_map_body; };
  std::vector<int> chosen;
  for (const int key : connected)
    if (std::none_of(chosen.begin(), chosen.end(), [&](int other) { return isSameView(poseOf(key), poseOf(other)); }))
      chosen.push_back(key);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](int a, int b) { return distance(poseOf(a), T_map_body) < distance(poseOf(b), T_map_body); });
  if (static_cast<int>(chosen.size()) > kLocalScans - 1) chosen.resize(static_cast<std::size_t>(kLocalScans - 1));
  if (std::find(chosen.begin(), chosen.end(), anchor) == chosen.end()) chosen.push_back(anchor);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

MatchResult LocalReference::match(const SlamGraph& graph, const std::vector<int>& keys, const ProjectedScan& scan,
                                  const Pose2& guess_T_map_body, const SearchWindow& window) {
  if (drawn_.empty() || !std::includes(keys.begin(), keys.end(), drawn_.begin(), drawn_.end())) {
    matcher_.clearReference();
    drawn_.clear();
  }
  for (const int key : keys) {
    if (std::binary_search(drawn_.begin(), drawn_.end(), key)) continue;
    const KeyScan& source = graph.keys[static_cast<std::size_t>(key)];
    matcher_.addReference(*source.scan, source.T_map_body);
  }
  drawn_ = keys;
  return matcher_.match(scan, guess_T_map_body, window);
}

}  // namespace swiftlet::perception
