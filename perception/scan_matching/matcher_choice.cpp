#include "perception/scan_matching/matcher_choice.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::perception {

void MatcherChoiceConfig::describe(common::config::Fields& fields) {
  fields.choice("kind", kind, {"correlative", "gauss_newton", "point_to_line"}, "Which matcher does the work.");
  CorrelativeMatcherConfig::describe(fields);
}

std::unique_ptr<ScanMatcher> makeMatcher(const MatcherChoiceConfig& config) {
  switch (config.kind) {
    case MatcherKind::kGaussNewton:
      return std::make_unique<GaussNewtonMatcher>();
    case MatcherKind::kPointToLine:
      return std::make_unique<PointToLineMatcher>();
    case MatcherKind::kCorrelative:
      break;
  }
  return std::make_unique<CorrelativeMatcher>(config);
}

}  // namespace swiftlet::perception
