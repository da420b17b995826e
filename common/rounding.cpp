#include "common/rounding.hpp"

#include <cmath>

namespace swiftlet::common {

double rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  constexpr double kLargestWhole = 9e15;  // Above it a double has no decimals left.
  if (!(std::abs(value) * power < kLargestWhole)) return value;
  return std::round(value * power) / power + 0.0;  // No negative zero.
}

}  // namespace swiftlet::common
