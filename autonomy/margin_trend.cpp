#include "autonomy/margin_trend.hpp"

#include <cmath>

namespace swiftlet::autonomy {

/// Welford's recursion for means and co-moments, with weights that fade.
void MarginTrend::add(double remaining, double margin) {
  constexpr double kForgottenCharge = 0.06;
  if (weight_ == 0.0) first_ = last_ = remaining;
  const double fade = std::exp(-std::abs(last_ - remaining) / kForgottenCharge);
  last_ = remaining;
  weight_ = fade * weight_ + 1.0;
  const double from_mean = remaining - mean_charge_;
  mean_charge_ += from_mean / weight_;
  mean_margin_ += (margin - mean_margin_) / weight_;
  charge2_ = fade * charge2_ + from_mean * (remaining - mean_charge_);
  charge_margin_ = fade * charge_margin_ + from_mean * (margin - mean_margin_);
}

std::optional<double> MarginTrend::chargeAt(double margin) const {
  constexpr double kTellingDrop = 0.05;
  if (first_ - last_ < kTellingDrop || charge2_ <= 0.0 || charge_margin_ <= 0.0) return std::nullopt;
  return mean_charge_ + (margin - mean_margin_) * charge2_ / charge_margin_;
}

}  // namespace swiftlet::autonomy
