#include "common/config_fields.hpp"

#include <cmath>

#include <fmt/format.h>

namespace swiftlet::common::config {

bool Bounds::contain(double value) const { return value <= high && (low_excluded ? value > low : value >= low); }

std::string Bounds::text() const {
  const bool high_open = !(high < kFinite.high);
  if (!(low > kFinite.low) && high_open) return "";
  if (high_open) return fmt::format("{} {}", low_excluded ? "above" : "at least", low);
  return fmt::format("{}{} to {}", low_excluded ? "above " : "", low, high);
}

Message Bounds::problem(double value) const {
  if (high < kFinite.high && !low_excluded)
    return Message("config.not-within", "{} is not within {} and {}", value, low, high);
  if (!(low > kFinite.low)) return Message("config.not-finite", "{} is not a finite number", value);
  if (low_excluded && low == 0.0) return Message("config.not-positive", "{} is not positive", value);
  return Message("config.out-of-bounds", "{} is not {}", value, text());
}

}  // namespace swiftlet::common::config
