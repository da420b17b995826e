#include "common/resampling.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"

namespace swiftlet::common {

std::vector<double> normalizedWeights(const std::vector<double>& log_weights) {
  SWIFTLET_CHECK(!log_weights.empty());
  const double greatest = *std::max_element(log_weights.begin(), log_weights.end());
  std::vector<double> weights;
  weights.reserve(log_weights.size());
  double sum = 0.0;
  for (const double log_weight : log_weights) sum += weights.emplace_back(std::exp(log_weight - greatest));
  for (double& weight : weights) weight /= sum;
  return weights;
}

double effectiveSampleSize(const std::vector<double>& weights) {
  double squares = 0.0;
  for (const double weight : weights) squares += weight * weight;
  return 1.0 / squares;
}

std::vector<std::size_t> resampled(const std::vector<double>& weights, RandomStream& random) {
  std::vector<std::size_t> chosen;
  drawSystematically(weights, 1.0, weights.size(), random.uniform(), chosen);
  return chosen;
}

}  // namespace swiftlet::common
