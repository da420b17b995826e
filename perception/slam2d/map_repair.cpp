#include "perception/slam2d/map_repair.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace swiftlet::perception {
namespace {

/// How far a stretch may be from where it belongs: walls that are drawn twice are seldom farther apart.
constexpr double kAstray_m = 2.0;  ///< Standard deviation; three of them are searched.
constexpr double kAstray_rad = 10.0 * common::kRadPerDeg;
/// Searches of one repair, those of the worst contradictions first: each takes some 0.1 s.
constexpr std::size_t kMostSearches = 40;

}  // namespace

MapJudgement judgeMap(const SlamGraph& graph, const std::vector<common::Pose2>& T_map_key) {
  std::vector<PlacedScan> placed;
  for (std::size_t i = 0; i < graph.keys.size(); ++i) placed.push_back({graph.keys[i].scan.get(), T_map_key[i]});
  return judgeMap(placed, ScanMatcher::kMaxRange_m);
}

std::vector<FoundLoop> loopsWhereContradicting(const SlamGraph& graph, const MapJudgement& judgement,
                                               const Slam2dConfig& config) {
  std::vector<FoundLoop> loops;
  for (std::size_t i = 0; i < std::min(judgement.contradicting.size(), kMostSearches); ++i) {
    const SeenTwice& pair = judgement.contradicting[i];
    LoopCandidate candidate;
    candidate.key = static_cast<int>(pair.first_key + MapJudgement::kStretch / 2);
    candidate.sigma_m = kAstray_m;
    candidate.covariance_map =
        Eigen::Vector3d(kAstray_m * kAstray_m, kAstray_m * kAstray_m, kAstray_rad * kAstray_rad).asDiagonal();
    const int query = static_cast<int>(pair.other_key + MapJudgement::kStretch) - 1;
    if (const auto found = searchLoop(graph, query, candidate, config)) loops.push_back(*found);
  }
  return loops;
}

}  // namespace swiftlet::perception
