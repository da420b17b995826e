#include "evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"

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
  result.median = quantile(values, 0.5);
  result.min = *std::min_element(values.begin(), values.end());
  result.max = *std::max_element(values.begin(), values.end());
  return result;
}

double quantile(std::vector<double> values, double q) {
  SWIFTLET_CHECK(!values.empty() && q >= 0 && q <= 1, values.size(), q);
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace swiftlet::evaluation
