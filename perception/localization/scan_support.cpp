#include "perception/localization/scan_support.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "perception/localization/evenly_spread.hpp"

namespace swiftlet::perception {

namespace {

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
std::optional<Witness> witnessOf(const MapField& map, const Eigen::Vector2d& from_m, const Eigen::Vector2d& end_m,
                                 const ScanSupportConfig& config) {
  const double range_m = (end_m - from_m).norm();
  const double tolerance_m = config.tolerance_m + config.tolerance_rad * range_m;
  const auto pieceAt = [&](const Eigen::Vector2d& at_m) -> Eigen::Vector2i {
    return (at_m / config.tolerance_m).array().floor().matrix().cast<int>();
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
                      const common::Pose2& T_grid_body, const ScanSupportConfig& config) {
  ScanSupport support;
  const std::size_t beams = std::min(points_body_m.size(), static_cast<std::size_t>(config.beams));
  support.beams = static_cast<int>(beams);
  std::vector<Witness> witnesses;
  witnesses.reserve(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const Eigen::Vector2f& point = points_body_m[evenlySpread(i, beams, points_body_m.size())];
    if (const auto witness = witnessOf(map, T_grid_body.position_m(), T_grid_body * point.cast<double>(), config))
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
  if (support.evidence < config_.least_evidence) return 0.0;
  const double odds = config_.at_none + config_.by_explained * support.explained;
  return std::clamp(odds, -config_.most, config_.most);
}

void LostTest::add(const ScanSupport& support, double elapsed_s) {
  if (support.evidence < config_.least_evidence) return;
  const double share = std::clamp(elapsed_s * config_.scans_per_s, 0.0, 1.0);
  explained_ += share * (support.explained - explained_);
  sum_ = std::max(0.0, sum_ + share * logOdds(support));
}

}  // namespace swiftlet::perception
