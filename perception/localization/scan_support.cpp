#include "perception/localization/scan_support.hpp"

#include <algorithm>

#include "common/validation.hpp"
#include "perception/localization/evenly_spread.hpp"

namespace swiftlet::perception {

void ScanSupportConfig::describe(common::config::Fields& fields) {
  fields("beams", beams, "Beams of a scan that are looked at.");
  fields("tolerance_m", tolerance_m, "A beam is explained when a wall is this near to its end;");
  fields("tolerance_rad", tolerance_rad, "wider with the range.");
}

std::vector<std::string> ScanSupportConfig::validate() const {
  return common::Validation()
      .within("beams", beams, 5, 10'000)
      .within("tolerance_m", tolerance_m, 0.01, 1)
      .within("tolerance_rad", tolerance_rad, 0, 0.5)
      .problems();
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
  fields("at_none", at_none, "Log-odds of being lost when nothing of a scan is explained.");
  fields("by_explained", by_explained, "What it changes by with the share explained.");
  fields("distrust_explained", distrust_explained, "While the map explains less, the pose is looked for elsewhere.");
  fields("most", most, "No scan says more than this.");
  fields("scans_per_s", scans_per_s, "Scans that are independent.");
  fields("threshold", threshold, "Log-odds that are believed.");
  fields("least_evidence", least_evidence, "A scan with fewer beams that say something is left out.");
}

std::vector<std::string> LostTestConfig::validate() const {
  return common::Validation()
      .within("at_none", at_none, -100, 100)
      .within("by_explained", by_explained, -100, 0)
      .within("distrust_explained", distrust_explained, 0, 1)
      .within("most", most, 0.1, 100)
      .within("scans_per_s", scans_per_s, 0.1, 100)
      .within("threshold", threshold, 0.1, 100)
      .within("least_evidence", least_evidence, 1, 10'000)
      .problems();
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
