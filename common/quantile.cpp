#include "common/quantile.hpp"

#include <algorithm>
#include <cstddef>

#include "common/check.hpp"

namespace swiftlet::common {

double quantile(std::vector<double> values, double q) {
  SWIFTLET_CHECK(!values.empty() && q >= 0 && q <= 1, values.size(), q);
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace swiftlet::common
