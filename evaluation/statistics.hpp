// Statistics of a set of errors.
#pragma once

#include <cstddef>
#include <vector>

namespace swiftlet::evaluation {

/// Figures of a set of values in one unit; all zero if the set is empty.
struct Statistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double standard_deviation = 0.0;  ///< Standard deviation of the set itself, divided by its count.
  double min = 0.0;
  double max = 0.0;
};

Statistics statisticsOf(const std::vector<double>& values);

}  // namespace swiftlet::evaluation
