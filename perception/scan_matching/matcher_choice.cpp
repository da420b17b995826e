#include "perception/scan_matching/matcher_choice.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

void MatcherChoiceConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"correlative", "gauss_newton", "point_to_line"}, "Which matcher does the work.");
  CorrelativeMatcherConfig::describe(fields);
}

double MatcherChoiceConfig::minQuality() const {
  switch (kind) {
    case MatcherKind::kGaussNewton:
      return gauss_newton.min_quality;
    case MatcherKind::kPointToLine:
      return point_to_line.min_quality;
    case MatcherKind::kCorrelative:
      break;
  }
  return min_quality;
}

int MatcherChoiceConfig::minPoints() const {
  switch (kind) {
    case MatcherKind::kGaussNewton:
      return gauss_newton.min_points;
    case MatcherKind::kPointToLine:
      return point_to_line.min_points;
    case MatcherKind::kCorrelative:
      break;
  }
  return min_points;
}

double MatcherChoiceConfig::maxRange_m() const {
  switch (kind) {
    case MatcherKind::kGaussNewton:
      return gauss_newton.max_range_m;
    case MatcherKind::kPointToLine:
      return point_to_line.max_range_m;
    case MatcherKind::kCorrelative:
      break;
  }
  return max_range_m;
}

std::unique_ptr<ScanMatcher> makeMatcher(const MatcherChoiceConfig& config) {
  switch (config.kind) {
    case MatcherKind::kGaussNewton:
      return std::make_unique<GaussNewtonMatcher>(config.gauss_newton);
    case MatcherKind::kPointToLine:
      return std::make_unique<PointToLineMatcher>(config.point_to_line);
    case MatcherKind::kCorrelative:
      break;
  }
  return std::make_unique<CorrelativeMatcher>(config);
}

}  // namespace swiftlet::perception
