#include "perception/slam2d/particle/resampling.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"

namespace swiftlet::perception {

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

std::vector<std::size_t> resampled(const std::vector<double>& weights, common::RandomStream& random) {
  const std::size_t count = weights.size();
  const double share = 1.0 / static_cast<double>(count);
  std::vector<std::size_t> chosen;
  chosen.reserve(count);
  double pointer = random.uniform() * share, sum = weights.front();
  for (std::size_t i = 0; chosen.size() < count; pointer += share) {
    while (pointer >= sum && i + 1 < count) sum += weights[++i];
    chosen.push_back(i);
  }
  return chosen;
}

}  // namespace swiftlet::perception
