// The choice of the scan matcher, and the settings of each kind.
#pragma once

#include <memory>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// The settings of the correlative matcher, the default, are on the same level as `kind`; those of the other kinds are
/// in sections of their own. Only the settings of the chosen kind have an effect.
struct MatcherChoiceConfig : CorrelativeMatcherConfig {
  MatcherKind kind = MatcherKind::kCorrelative;
  GaussNewtonMatcherConfig gauss_newton;
  PointToLineMatcherConfig point_to_line;

  void describe(common::config::Fields& fields);

  // A kind without a setting of its own uses that of the correlative matcher.

  /// Quality of the chosen kind below which a match failed.
  double minQuality() const;
  /// Number of points of the chosen kind below which a match failed.
  int minPoints() const;
  /// Points beyond it are not matched.
  double maxRange_m() const;
};

/// Creates a matcher of the chosen kind, without a reference; never null.
std::unique_ptr<ScanMatcher> makeMatcher(const MatcherChoiceConfig& config);

}  // namespace swiftlet::perception
