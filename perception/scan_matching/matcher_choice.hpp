// The choice of the scan matcher, and the settings of each kind.
#pragma once

#include <memory>

#include "perception/scan_matching/correlative_matcher.hpp"
#include "perception/scan_matching/gauss_newton_matcher.hpp"
#include "perception/scan_matching/point_to_line_matcher.hpp"
#include "perception/scan_matching/scan_matcher.hpp"

namespace swiftlet::perception {

/// Beside `kind` are the settings of the correlative matcher, the default; the other kinds have none.
struct MatcherChoiceConfig : CorrelativeMatcherConfig {
  MatcherKind kind = MatcherKind::kCorrelative;

  void describe(common::config::Fields& fields);
};

/// Creates a matcher of the chosen kind, without a reference; never null.
std::unique_ptr<ScanMatcher> makeMatcher(const MatcherChoiceConfig& config);

}  // namespace swiftlet::perception
