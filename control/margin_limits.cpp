#include "control/margin_limits.hpp"

#include <algorithm>
#include <cmath>

#include "common/config_fields.hpp"
#include "common/first_order_lag.hpp"
#include "common/validation.hpp"

namespace swiftlet::control {

using common::config::kPositive;

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

void MarginLimits::Config::describe(common::config::Fields& fields) {
  fields("full_margin", full_margin, {1, 5},
         "Greatest thrust over the weight from which on it does not limit speeds and accelerations.");
  fields("least_margin", least_margin, {1, 5},
         "Greatest thrust over the weight at which, and below which, least_share of the accelerations is flown.");
  fields("least_share", least_share, {0.05, 1},
         "Share of the accelerations that is flown at least_margin; the share of the speeds is its root.");
  fields("filter_s", filter_s, kPositive, "Time constant by which the limits follow the margin.");
}

std::vector<std::string> MarginLimits::Config::validate() const {
  return common::Validation().atMost("least_margin", least_margin, "full_margin", full_margin).problems();
}

}  // namespace swiftlet::control
