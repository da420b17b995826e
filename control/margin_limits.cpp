#include "control/margin_limits.hpp"

#include <algorithm>
#include <cmath>

#include "common/first_order_lag.hpp"

namespace swiftlet::control {
namespace {

/// From this margin on it limits nothing. At the least one, and below it, kLeastShare of the accelerations is flown.
/// Measured: docs/decisions/control.md#033 and docs/decisions/control.md#094.
constexpr double kFullMargin = 1.20, kLeastMargin = 1.05;
constexpr double kLeastShare = 0.35;
constexpr double kFilter_s = 2.0;  ///< Time constant by which the limits follow the margin.

}  // namespace

double MarginLimits::shareAt(double margin) const {
  const double span = std::max(1e-6, kFullMargin - kLeastMargin);
  const double left = margin > kLeastMargin ? std::min(1.0, (margin - kLeastMargin) / span) : 0.0;
  return std::lerp(kLeastShare, 1.0, left);
}

void MarginLimits::observe(double margin, double dt_s) {
  const double blend = observed_ ? common::followedShare(dt_s, kFilter_s) : 1.0;
  share_ += blend * (shareAt(margin) - share_);
  observed_ = true;
}

double MarginLimits::speed() const { return std::sqrt(share_); }

}  // namespace swiftlet::control
