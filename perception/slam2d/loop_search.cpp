#include "perception/slam2d/loop_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/scan_matching/branch_and_bound.hpp"
#include "perception/scan_matching/likelihood_field.hpp"
#include "perception/slam2d/free_space_violation.hpp"

namespace swiftlet::perception {
namespace {

using common::kRadPerDeg;
using common::Pose2;

/// Newest key scans joined to the query.
constexpr int kQueryScans = 5;
/// Key scans around the candidate joined to the reference.
constexpr int kReferenceScans = 9;
/// Side of a cell of the wide search, which a fine match follows.
constexpr double kWideResolution_m = 0.04;
/// Step of the rotation of the wide search.
constexpr double kWideAngularResolution_deg = 0.5;
/// Least quality of the wide match, on its coarse cells.
constexpr double kMinWideQuality = 0.60;
/// A second, distinct place must score less than this share of the best.
constexpr double kMaxAmbiguity = 0.90;
/// Distance from which a second place is distinct.
constexpr double kDistinct_m = 0.4;
/// Rotation from which a second place is distinct.
constexpr double kDistinct_deg = 12.0;

/// Size of the searched ellipse of the projected uncertainty, in sigmas.
constexpr double kSigmas = 3.0;
/// Views within this distance of each other overlap, however certain their poses are.
constexpr double kViewDistance_m = 2.0;
/// Standard deviation of the wide search's likelihood field, in its cells.
constexpr double kWideSigmaCells = 2.0;

/// Of the newest `count` key scans up to the query, those connected to it with little uncertainty; the newest first.
std::vector<int> queryKeys(int query, const std::vector<ProjectedUncertainty>& connected_to_query, int count) {
  std::vector<int> keys;
  for (const ProjectedUncertainty& u : connected_to_query)
    if (u.key <= query && u.key > query - count) keys.push_back(u.key);
  std::sort(keys.rbegin(), keys.rend());
  return keys;
}

/// The key scans as one scan, in the frame of the first of them.
ProjectedScan joined(const SlamGraph& graph, const std::vector<int>& keys) {
  const Pose2& T_map_query = graph.keys[static_cast<std::size_t>(keys.front())].T_map_body;
  ProjectedScan joined;
  joined.stamp = graph.keys[static_cast<std::size_t>(keys.front())].scan->stamp;
  for (const int key : keys) {
    const KeyScan& source = graph.keys[static_cast<std::size_t>(key)];
    const Pose2 T_query_key = between(T_map_query, source.T_map_body);
    const auto c = static_cast<float>(std::cos(T_query_key.yaw_rad)),
               s = static_cast<float>(std::sin(T_query_key.yaw_rad));
    for (const Eigen::Vector2f& p : source.scan->points_level_m)
      joined.points_level_m.emplace_back(c * p.x() - s * p.y() + static_cast<float>(T_query_key.x_m),
                                         s * p.x() + c * p.y() + static_cast<float>(T_query_key.y_m));
  }
  return joined;
}

/// Key scans around the candidate that are connected to it with little uncertainty, but not to the query; the nearest
/// first.
std::vector<int> referenceKeys(const SlamGraph& graph, const std::vector<ProjectedUncertainty>& connected_to_query,
                               int candidate, const Slam2dConfig& config) {
  std::vector<char> of_query(graph.keys.size(), 0);
  for (const ProjectedUncertainty& u : connected_to_query) of_query[static_cast<std::size_t>(u.key)] = 1;
  std::vector<int> keys;
  const Pose2& center = graph.keys[static_cast<std::size_t>(candidate)].T_map_body;
  for (const ProjectedUncertainty& u : projectUncertainty(graph, candidate, config.local_sigma_m))
    if (of_query[static_cast<std::size_t>(u.key)] == 0 &&
        distance(center, graph.keys[static_cast<std::size_t>(u.key)].T_map_body) < config.local_radius_m)
      keys.push_back(u.key);
  std::stable_sort(keys.begin(), keys.end(), [&](int a, int b) {
    return distance(center, graph.keys[static_cast<std::size_t>(a)].T_map_body) <
           distance(center, graph.keys[static_cast<std::size_t>(b)].T_map_body);
  });
  if (static_cast<int>(keys.size()) > kReferenceScans) keys.resize(static_cast<std::size_t>(kReferenceScans));
  return keys;
}

/// Key scans at their estimated poses, moved by `T_map_believed`.
std::vector<PlacedScan> placed(const SlamGraph& graph, const std::vector<int>& keys, const Pose2& T_map_believed) {
  std::vector<PlacedScan> scans;
  for (const int key : keys) {
    const KeyScan& source = graph.keys[static_cast<std::size_t>(key)];
    scans.push_back({source.scan.get(), T_map_believed * source.T_map_body});
  }
  return scans;
}

/// The free-space violation among the key scans themselves, between every second one and the others. Its causes are
/// people, doors that moved, and distortions of the map.
double ownFreeSpaceViolation(const SlamGraph& graph, std::vector<int> keys, double max_range_m) {
  std::sort(keys.begin(), keys.end());
  std::vector<int> one, other;
  for (std::size_t i = 0; i < keys.size(); ++i) (i % 2 == 0 ? one : other).push_back(keys[i]);
  return freeSpaceViolation(placed(graph, one, {}), placed(graph, other, {}), max_range_m);
}

/// Whether the newest key scans, moved by `T_map_believed`, and the reference violate each other's free space by more
/// than each set violates its own.
bool loopViolatesFreeSpace(const SlamGraph& graph, const std::vector<int>& newest, const Pose2& T_map_believed,
                           const std::vector<int>& reference, const Slam2dConfig& config) {
  const double max_range_m = ScanMatcher::kMaxRange_m, most = config.loops.max_free_space_violation;
  const double share =
      freeSpaceViolation(placed(graph, newest, T_map_believed), placed(graph, reference, {}), max_range_m);
  if (share <= most) return false;
  return share > most + std::max(ownFreeSpaceViolation(graph, newest, max_range_m),
                                 ownFreeSpaceViolation(graph, reference, max_range_m));
}

/// Draws the contours of the reference scans, in the map frame.
void drawReference(const SlamGraph& graph, const std::vector<int>& keys, LikelihoodField& field) {
  for (const int key : keys) {
    const KeyScan& source = graph.keys[static_cast<std::size_t>(key)];
    field.draw(contourOf(source.scan->points_level_m, CorrelativeMatcher::kMaxGap_m, ScanMatcher::kMaxRange_m,
                         source.T_map_body));
  }
}

/// The pose at which the points fit the reference, searched within the candidate's uncertainty on the coarse grid.
/// Nothing when the fit is poor, when the best pose is at the edge of the window, or when a distinct pose scores nearly
/// as high.
std::optional<Pose2> searchWidely(const SlamGraph& graph, const std::vector<int>& reference,
                                  const std::vector<Eigen::Vector2f>& points, const Pose2& believed,
                                  const LoopCandidate& candidate, const Slam2dConfig& config) {
  const LoopClosureConfig& loops = config.loops;
  LikelihoodField field(kWideResolution_m, kWideSigmaCells * kWideResolution_m);
  drawReference(graph, reference, field);
  if (field.empty()) return std::nullopt;

  const double half_m = std::clamp(kSigmas * candidate.sigma_m, loops.min_window_m, loops.max_sigma_m);
  const double half_rad = std::clamp(kSigmas * std::sqrt(candidate.covariance_map(2, 2)),
                                     loops.min_window_deg * kRadPerDeg, loops.max_window_deg * kRadPerDeg);
  const int half = static_cast<int>(std::ceil(half_m / kWideResolution_m));
  const double step_rad = kWideAngularResolution_deg * kRadPerDeg;
  const int half_turn = static_cast<int>(std::ceil(half_rad / step_rad));
  const PoseGrid grid{believed.x_m - half * kWideResolution_m,
                      believed.y_m - half * kWideResolution_m,
                      believed.yaw_rad - half_turn * step_rad,
                      step_rad,
                      2 * half_turn + 1,
                      2 * half + 1};
  BranchAndBound wide(bestInstructions());
  const int poor = static_cast<int>(kMinWideQuality * LikelihoodField::kTopValue * static_cast<double>(points.size()));
  const BestPose best = wide.search(field, points, grid, {}, poor);
  if (best.score <= poor) return std::nullopt;
  const auto atEdge = [](int i, int size) { return i == 0 || i == size - 1; };
  const bool whole_turn = 2.0 * half_rad >= 2.0 * std::numbers::pi;
  if (atEdge(best.x, grid.translations) || atEdge(best.y, grid.translations) ||
      (atEdge(best.rotation, grid.rotations) && !whole_turn))
    return std::nullopt;  // The true pose may lie beyond the window.

  const ExcludedPoses same_place{best, static_cast<int>(kDistinct_m / kWideResolution_m),
                                 static_cast<int>(kDistinct_deg * kRadPerDeg / step_rad)};
  const int rival = static_cast<int>(kMaxAmbiguity * best.score);
  if (wide.searchElsewhere(field, points, grid, same_place, rival).score > rival) return std::nullopt;
  return Pose2{grid.first_x_m + best.x * kWideResolution_m, grid.first_y_m + best.y * kWideResolution_m,
               grid.first_yaw_rad + best.rotation * step_rad};
}

}  // namespace

Eigen::Matrix3d edgeCovariance(const Eigen::Matrix3d& covariance, const Slam2dConfig& config) {
  const double sigma_rad = config.edge_sigma_deg * kRadPerDeg;
  Eigen::Matrix3d result = 0.5 * (covariance + covariance.transpose());
  result.diagonal() += Eigen::Vector3d(config.edge_sigma_m * config.edge_sigma_m,
                                       config.edge_sigma_m * config.edge_sigma_m, sigma_rad * sigma_rad);
  return result;
}

std::vector<LoopCandidate> loopCandidates(const SlamGraph& graph, int query, const Slam2dConfig& config) {
  const Pose2& here = graph.keys[static_cast<std::size_t>(query)].T_map_body;
  // The projection stops when it has reached these; most of a large map is out of reach.
  std::vector<int> reachable;
  const double farthest_m = std::max(kViewDistance_m, kSigmas * config.loops.max_sigma_m);
  for (int key = 0; key < static_cast<int>(graph.keys.size()); ++key)
    if (distance(here, graph.keys[static_cast<std::size_t>(key)].T_map_body) <= farthest_m) reachable.push_back(key);
  std::vector<LoopCandidate> near;
  for (const ProjectedUncertainty& u : projectUncertainty(graph, query, INFINITY, reachable)) {
    if (u.sigma_m <= config.local_sigma_m) continue;
    const double reach_m = std::max(kViewDistance_m, kSigmas * std::min(u.sigma_m, config.loops.max_sigma_m));
    if (distance(here, graph.keys[static_cast<std::size_t>(u.key)].T_map_body) <= reach_m)
      near.push_back({u.key, u.covariance_map, u.sigma_m});
  }
  const auto distanceTo = [&](const LoopCandidate& c) {
    return distance(here, graph.keys[static_cast<std::size_t>(c.key)].T_map_body);
  };
  std::stable_sort(near.begin(), near.end(), [&](const LoopCandidate& a, const LoopCandidate& b) {
    return distanceTo(a) != distanceTo(b) ? distanceTo(a) < distanceTo(b) : a.key < b.key;
  });
  std::vector<LoopCandidate> chosen;
  for (const LoopCandidate& candidate : near) {
    if (static_cast<int>(chosen.size()) >= config.loops.max_candidates) break;
    const Pose2& pose = graph.keys[static_cast<std::size_t>(candidate.key)].T_map_body;
    const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const LoopCandidate& other) {
      return distance(pose, graph.keys[static_cast<std::size_t>(other.key)].T_map_body) > kViewDistance_m;
    });
    if (apart) chosen.push_back(candidate);
  }
  return chosen;
}

std::optional<FoundLoop> searchLoop(const SlamGraph& graph, int query, const LoopCandidate& candidate,
                                    const Slam2dConfig& config) {
  const LoopClosureConfig& loops = config.loops;
  const std::vector<ProjectedUncertainty> connected_to_query = projectUncertainty(graph, query, config.local_sigma_m);
  const std::vector<int> reference = referenceKeys(graph, connected_to_query, candidate.key, config);
  if (reference.empty()) return std::nullopt;
  const std::vector<int> newest = queryKeys(query, connected_to_query, kQueryScans);
  const ProjectedScan query_scan = joined(graph, newest);
  const std::vector<Eigen::Vector2f> points =
      spreadPoints(query_scan.points_level_m, config.matcher.search_points, ScanMatcher::kMaxRange_m);
  if (static_cast<int>(points.size()) < ScanMatcher::kMinPoints) return std::nullopt;

  const Pose2& believed = graph.keys[static_cast<std::size_t>(query)].T_map_body;
  const std::optional<Pose2> coarse = searchWidely(graph, reference, points, believed, candidate, config);
  if (!coarse) return std::nullopt;

  CorrelativeMatcher fine(config.matcher);
  for (const int key : reference)
    fine.addReference(*graph.keys[static_cast<std::size_t>(key)].scan,
                      graph.keys[static_cast<std::size_t>(key)].T_map_body);
  const double step_rad = kWideAngularResolution_deg * kRadPerDeg;
  const MatchResult match = fine.match(query_scan, *coarse, {1.5 * kWideResolution_m, 1.5 * step_rad});
  if (match.failed || match.quality < loops.min_fine_quality || match.unobservable_motion) return std::nullopt;
  if (loopViolatesFreeSpace(graph, newest, match.T_reference_body * believed.inverse(), reference, config))
    return std::nullopt;

  const Pose2& T_map_candidate = graph.keys[static_cast<std::size_t>(candidate.key)].T_map_body;
  FoundLoop found;
  found.edge.from = candidate.key;
  found.edge.to = query;
  found.edge.T_from_to = between(T_map_candidate, match.T_reference_body);
  found.edge.covariance = edgeCovariance(common::turned(match.covariance, -T_map_candidate.yaw_rad), config);
  found.edge.loop = true;
  found.quality = match.quality;
  found.shift_m = distance(believed, match.T_reference_body);
  return found;
}

}  // namespace swiftlet::perception
