#include "perception/slam2d/map_judgement.hpp"

#include <algorithm>
#include <span>

namespace swiftlet::perception {
namespace {

constexpr std::size_t kStretch = MapJudgement::kStretch;
/// Stretches whose middles are this near see the same place, if at least this share of their points was observed by the
/// other one.
constexpr double kSamePlace_m = 6.0;
constexpr double kLeastObserved = 0.2;
/// Two stretches contradict each other when they violate each other's free space by this much more than each one its
/// own, as people, doors and errors of the laser do.
constexpr double kMostViolation = 0.10;

struct Stretch {
  std::size_t first = 0;
  std::span<const PlacedScan> scans;
  double own_violation = 0.0;

  Eigen::Vector2d middle_m() const { return scans[scans.size() / 2].T_map_body.position_m(); }
};

/// Between every second scan and the others.
double ownViolation(std::span<const PlacedScan> scans, double max_range_m) {
  std::vector<PlacedScan> one, other;
  for (std::size_t i = 0; i < scans.size(); ++i) (i % 2 == 0 ? one : other).push_back(scans[i]);
  return freeSpaceViolation(one, other, max_range_m);
}

std::vector<Stretch> stretchesOf(const std::vector<PlacedScan>& keys, double max_range_m) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first + kStretch <= keys.size(); first += kStretch) {
    const std::span<const PlacedScan> scans = std::span(keys).subspan(first, kStretch);
    stretches.push_back({first, scans, ownViolation(scans, max_range_m)});
  }
  return stretches;
}

}  // namespace

double MapJudgement::violation() const {
  double sum = 0.0;
  for (const SeenTwice& pair : contradicting) sum += pair.violation;
  return pairs() > 0 ? sum / static_cast<double>(pairs()) : 0.0;
}

MapJudgement judgeMap(const std::vector<PlacedScan>& keys, double max_range_m) {
  const std::vector<Stretch> stretches = stretchesOf(keys, max_range_m);
  MapJudgement judgement;
  for (std::size_t i = 0; i < stretches.size(); ++i)
    for (std::size_t k = i + 2; k < stretches.size(); ++k) {  // The matches of neighbours hold them together.
      const Stretch &one = stretches[i], &other = stretches[k];
      if ((one.middle_m() - other.middle_m()).norm() > kSamePlace_m) continue;
      const FreeSpaceEvidence seen = freeSpaceEvidence(one.scans, other.scans, max_range_m);
      if (seen.observed < kLeastObserved * seen.points) continue;
      const double violation = seen.violation() - std::max(one.own_violation, other.own_violation);
      const bool contradicts = violation > kMostViolation;
      (contradicts ? judgement.contradicting : judgement.agreeing)
          .push_back(
              {one.first, other.first, contradicts ? violation : 0.0, 0.5 * (one.middle_m() + other.middle_m())});
    }
  std::stable_sort(judgement.contradicting.begin(), judgement.contradicting.end(),
                   [](const SeenTwice& a, const SeenTwice& b) { return a.violation > b.violation; });
  return judgement;
}

}  // namespace swiftlet::perception
