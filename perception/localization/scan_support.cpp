#include "perception/localization/scan_support.hpp"

#include <algorithm>

#include "common/config_fields.hpp"
#include "perception/localization/evenly_spread.hpp"

namespace swiftlet::perception {

void ScanSupportConfig::describe(common::config::Fields& fields) {
  fields("beams", beams, {5, 10'000}, "Beams of a scan, evenly spread, that are judged.");
  fields("tolerance_m", tolerance_m, {0.01, 1}, "A beam is explained when a wall is this near to its end.");
  fields("tolerance_rad", tolerance_rad, {0, 0.5},
         "Growth of tolerance_m with the range, for the error of the heading.");
}

ScanSupport supportOf(const MapField& map, std::span<const Eigen::Vector2f> points_body_m,
                      const common::Pose2& T_grid_body, const ScanSupportConfig& config) {
  ScanSupport support;
  support.beams = static_cast<int>(std::min(points_body_m.size(), static_cast<std::size_t>(config.beams)));
  int explained = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(support.beams); ++i) {
    const Eigen::Vector2f& point =
        points_body_m[evenlySpread(i, static_cast<std::size_t>(support.beams), points_body_m.size())];
    const Eigen::Vector2d end_m = T_grid_body * point.cast<double>();
    const double range_m = static_cast<double>(point.norm());
    const double tolerance_m = config.tolerance_m + config.tolerance_rad * range_m;
    const MapField::Place place = map.at(end_m);
    const bool through = map.rayLength_m(T_grid_body.position_m(), end_m) < range_m - 2.0 * tolerance_m;
    const bool on_wall = place.wall_distance_m <= tolerance_m;
    if (!through && !on_wall && !place.known) continue;
    ++support.evidence;
    explained += on_wall && !through ? 1 : 0;
  }
  if (support.evidence > 0) support.explained = static_cast<double>(explained) / support.evidence;
  return support;
}

void LostTestConfig::describe(common::config::Fields& fields) {
  fields("at_none", at_none, {-100, 100},
         "Log-odds of being lost when nothing of a scan is explained (logistic regression on simulated walks, "
         "docs/localization.md).");
  fields("by_explained", by_explained, {-100, 0},
         "Change of the log-odds with the share explained (from the same regression as at_none).");
  fields("most", most, {0.1, 100}, "Greatest log-odds that one scan adds, for or against.");
  fields("scans_per_s", scans_per_s, {0.1, 100},
         "Rate of scans that count as independent: nearer ones see the same person in front.");
  fields("distrust_explained", distrust_explained, {0, 1},
         "While the map explains less than this share, the pose is also sought elsewhere.");
  fields("threshold", threshold, {0.1, 100}, "Log-odds from which the pose counts as lost.");
  fields("least_evidence", least_evidence, {1, 10'000}, "A scan with fewer beams that tell anything is left out.");
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
