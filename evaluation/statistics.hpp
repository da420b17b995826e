// What a set of errors comes to.
#pragma once

#include <cstddef>
#include <vector>

namespace swiftlet::evaluation {

/// Of a set of values in one unit; all zero when there are none.
struct Statistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double standard_deviation = 0.0;  ///< Of the set itself, divided by its count.
  double min = 0.0;
  double max = 0.0;
};

Statistics statisticsOf(const std::vector<double>& values);

/// The value below which the share q of the sorted values lies, linearly between neighbours; q in [0, 1], values not
/// empty. quantile(v, 0.5) is the median.
double quantile(std::vector<double> values, double q);

}  // namespace swiftlet::evaluation
