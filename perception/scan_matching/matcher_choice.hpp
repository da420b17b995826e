// Which scan matcher does the work, chosen by a profile, and the settings of each.
#pragma once

#include <memory>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// The settings of the correlative matcher, the default, stand beside `kind`; those of the others in sections of their
/// own. Only those of the chosen kind have an effect.
struct MatcherChoiceConfig : CorrelativeMatcherConfig {
  MatcherKind kind = MatcherKind::kCorrelative;
  GaussNewtonMatcherConfig gauss_newton;
  PointToLineMatcherConfig point_to_line;

  void describe(common::config::Fields& fields);

  /// Of the chosen kind: below this quality, or with fewer points, a match failed.
  double minQuality() const;
  int minPoints() const;
};

/// A matcher of the chosen kind, without a reference; never null.
std::unique_ptr<ScanMatcher> makeMatcher(const MatcherChoiceConfig& config);

}  // namespace swiftlet::perception
