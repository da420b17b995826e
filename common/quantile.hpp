// Quantiles of a set of values.
#pragma once

#include <vector>

namespace swiftlet::common {

/// The value below which the share q of the sorted values lies, linear between neighbours. q is in [0, 1], and there is
/// at least one value. quantile(v, 0.5) is the median.
double quantile(std::vector<double> values, double q);

}  // namespace swiftlet::common
