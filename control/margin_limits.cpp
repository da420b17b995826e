#include "control/margin_limits.hpp"

#include <algorithm>
#include <cmath>

#include "common/first_order_lag.hpp"

namespace swiftlet::control {

double MarginLimits::shareAt(double margin) const {
  const double span = std::max(1e-6, config_.full_margin - config_.least_margin);
  const double left = margin > config_.least_margin ? std::min(1.0, (margin - config_.least_margin) / span) : 0.0;
  return std::lerp(config_.least_share, 1.0, left);
}

void MarginLimits::observe(double margin, double dt_s) {
  const double blend = observed_ ? common::followedShare(dt_s, config_.filter_s) : 1.0;
  share_ += blend * (shareAt(margin) - share_);
  observed_ = true;
}

double MarginLimits::speed() const { return std::sqrt(share_); }

}  // namespace swiftlet::control
