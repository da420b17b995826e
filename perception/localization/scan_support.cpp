#include "perception/localization/scan_support.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "perception/localization/evenly_spread.hpp"

namespace swiftlet::perception {

namespace {

/// Log-odds of being lost when nothing of a scan is explained (logistic regression on simulated walks:
/// docs/localization.md).
constexpr double kAtNone = 9.4;
/// Change of the log-odds with the share explained (from the same regression as kAtNone).
constexpr double kByExplained = -17.6;
/// Greatest log-odds that one scan adds, for or against.
constexpr double kMost = 3.0;
/// Rate of scans that count as independent: scans closer in time see the same person in front.
constexpr double kScansPer_s = 2.0;
/// A scan that covers fewer pieces of wall or free space is left out.
constexpr int kLeastEvidence = 15;

/// Beams of a scan, evenly spread, that are judged, at most.
constexpr std::size_t kMostBeams = 90;
/// Growth of kTolerance_m with the range, for the error of the heading.
constexpr double kTolerance_rad = 0.015;

/// What one beam says about the piece of the map that it hits.
struct Witness {
  Eigen::Vector2i piece;
  /// A wall of the map; something that the map lacks, before its walls; a wall of the map that is not there.
  enum class Says { kWall, kObject, kNoWall } says = Says::kWall;

  auto key() const { return std::tuple(says, piece.x(), piece.y()); }
  bool operator<(const Witness& other) const { return key() < other.key(); }
  bool operator==(const Witness& other) const { return key() == other.key(); }
};

/// nullopt if the beam ends where the map is unknown.
std::optional<Witness> witnessOf(const MapField& map, const Eigen::Vector2d& from_m, const Eigen::Vector2d& end_m) {
  const double range_m = (end_m - from_m).norm();
  const double tolerance_m = kTolerance_m + kTolerance_rad * range_m;
  const auto pieceAt = [&](const Eigen::Vector2d& at_m) -> Eigen::Vector2i {
    return (at_m / kTolerance_m).array().floor().matrix().cast<int>();
  };
  const double free_m = map.rayLength_m(from_m, end_m);
  if (free_m < range_m - 2.0 * tolerance_m)
    return Witness{pieceAt(from_m + (end_m - from_m) * (free_m / range_m)), Witness::Says::kNoWall};
  const MapField::Place place = map.at(end_m);
  if (place.wall_distance_m <= tolerance_m) return Witness{pieceAt(end_m), Witness::Says::kWall};
  if (!place.known) return std::nullopt;
  return Witness{pieceAt(end_m), Witness::Says::kObject};
}

}  // namespace

ScanSupport supportOf(const MapField& map, std::span<const Eigen::Vector2f> points_body_m,
                      const common::Pose2& T_grid_body) {
  ScanSupport support;
  const std::size_t beams = std::min(points_body_m.size(), kMostBeams);
  support.beams = static_cast<int>(beams);
  std::vector<Witness> witnesses;
  witnesses.reserve(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const Eigen::Vector2f& point = points_body_m[evenlySpread(i, beams, points_body_m.size())];
    if (const auto witness = witnessOf(map, T_grid_body.position_m(), T_grid_body * point.cast<double>()))
      witnesses.push_back(*witness);
  }
  std::sort(witnesses.begin(), witnesses.end());
  witnesses.erase(std::unique(witnesses.begin(), witnesses.end()), witnesses.end());
  support.evidence = static_cast<int>(witnesses.size());
  const auto explained = std::count_if(witnesses.begin(), witnesses.end(),
                                       [](const Witness& w) { return w.says == Witness::Says::kWall; });
  if (support.evidence > 0) support.explained = static_cast<double>(explained) / support.evidence;
  return support;
}

void LostTest::reset() {
  sum_ = 0.0;
  explained_ = 1.0;
}

double LostTest::logOdds(const ScanSupport& support) const {
  if (support.evidence < kLeastEvidence) return 0.0;
  const double odds = kAtNone + kByExplained * support.explained;
  return std::clamp(odds, -kMost, kMost);
}

void LostTest::add(const ScanSupport& support, double elapsed_s) {
  if (support.evidence < kLeastEvidence) return;
  const double share = std::clamp(elapsed_s * kScansPer_s, 0.0, 1.0);
  explained_ += share * (support.explained - explained_);
  sum_ = std::max(0.0, sum_ + share * logOdds(support));
}

bool LostTest::lost() const {
  constexpr double kThreshold = 5.0;  // Log-odds (docs/localization.md).
  return sum_ >= kThreshold;
}

bool LostTest::doubtful() const {
  constexpr double kDistrustExplained = 0.75;  // Share explained (docs/localization.md).
  return sum_ > 0.0 || explained_ < kDistrustExplained;
}

}  // namespace swiftlet::perception
