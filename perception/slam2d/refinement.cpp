#include "perception/slam2d/refinement.hpp"

#include <algorithm>
#include <cmath>

#include "perception/slam2d/local_reference.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

/// So many key scans apart is another pass.
constexpr int kOtherPass = 15;
/// Key scans of the other passes that are joined to one reference.
constexpr std::size_t kJoined = 6;

/// The nearest key scans of earlier passes, in ascending order.
std::vector<int> earlierPasses(const SlamGraph& graph, int key, const Slam2dConfig& config) {
  const Pose2& here = graph.keys[static_cast<std::size_t>(key)].T_map_body;
  std::vector<int> near;
  for (int other = 0; other <= key - kOtherPass; ++other)
    if (distance(here, graph.keys[static_cast<std::size_t>(other)].T_map_body) < 0.5 * config.local_radius_m)
      near.push_back(other);
  const auto distanceTo = [&](int other) {
    const Pose2& there = graph.keys[static_cast<std::size_t>(other)].T_map_body;
    return distance(here, there) + std::abs(common::wrapAngle(here.yaw_rad - there.yaw_rad));
  };
  std::stable_sort(near.begin(), near.end(), [&](int a, int b) { return distanceTo(a) < distanceTo(b); });
  if (near.size() > kJoined) near.resize(kJoined);
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace

std::vector<FoundLoop> matchPasses(const SlamGraph& graph, const Slam2dConfig& config) {
  std::vector<FoundLoop> found;
  LocalReference reference(config.matcher);
  const SearchWindow window{2.0 * config.local_window_m, config.local_window_deg * kRadPerDeg};
  for (int key = kOtherPass; key < static_cast<int>(graph.keys.size()); ++key) {
    const std::vector<int> others = earlierPasses(graph, key, config);
    if (others.empty()) continue;
    const KeyScan& source = graph.keys[static_cast<std::size_t>(key)];
    const MatchResult match = reference.match(graph, others, *source.scan, source.T_map_body, window);
    if (match.failed || match.at_window_edge || match.quality < config.loops.min_quality) continue;
    const int nearest = *std::min_element(others.begin(), others.end(), [&](int a, int b) {
      return distance(graph.keys[static_cast<std::size_t>(a)].T_map_body, source.T_map_body) <
             distance(graph.keys[static_cast<std::size_t>(b)].T_map_body, source.T_map_body);
    });
    const Pose2& T_map_other = graph.keys[static_cast<std::size_t>(nearest)].T_map_body;
    FoundLoop loop;
    loop.edge = {nearest, key, between(T_map_other, match.T_reference_body),
                 edgeCovariance(2.0 * common::turned(match.covariance, -T_map_other.yaw_rad), config), true};
    loop.quality = match.quality;
    loop.shift_m = distance(source.T_map_body, match.T_reference_body);
    found.push_back(loop);
  }
  return found;
}

}  // namespace swiftlet::perception
