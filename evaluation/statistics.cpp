#include "evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "common/quantile.hpp"

namespace swiftlet::evaluation {

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics result;
  if (values.empty()) return result;
  const double count = static_cast<double>(values.size());
  double sum = 0, squares = 0, deviations = 0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  result.count = values.size();
  result.mean = sum / count;
  result.rmse = std::sqrt(squares / count);
  for (const double value : values) deviations += (value - result.mean) * (value - result.mean);
  result.standard_deviation = std::sqrt(deviations / count);
  result.median = common::quantile(values, 0.5);
  result.min = *std::min_element(values.begin(), values.end());
  result.max = *std::max_element(values.begin(), values.end());
  return result;
}

}  // namespace swiftlet::evaluation
