// The resampling of particles: systematic, also called the low-variance sampler (Probabilistic Robotics, Table 4.4;
// Doucet 2000), by weights whose effective sample size says when it is due (Grisetti 2007, section III.B).
#pragma once

#include <cstddef>
#include <vector>

#include "common/random.hpp"

namespace swiftlet::common {

/// Replaces `chosen` by `count` indices into the weights, ascending, each count * weight / sum times,
/// rounded up or down. `sum` is that of the weights and positive; `uniform`, in [0, 1), is the one random number that
/// serves for all. There must be at least one weight.
template <typename Weight, typename Index>
void drawSystematically(const std::vector<Weight>& weights, double sum, std::size_t count, double uniform,
                        std::vector<Index>& chosen) {
  const double step = sum / static_cast<double>(count);
  double pointer = step * uniform, passed = 0.0;
  chosen.clear();
  chosen.reserve(count);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    passed += static_cast<double>(weights[i]);
    for (; pointer < passed && chosen.size() < count; pointer += step) chosen.push_back(static_cast<Index>(i));
  }
  // Rounding may leave the pointer behind the last weight.
  chosen.resize(count, static_cast<Index>(weights.size() - 1));
}

/// Weights that sum up to 1, from their logarithms. There must be at least one; all must be finite, of any size.
std::vector<double> normalizedWeights(const std::vector<double>& log_weights);

/// 1 / sum of w^2, for weights that sum up to 1: this many particles of equal weight would be as good. Between 1 and
/// the number of weights.
double effectiveSampleSize(const std::vector<double>& weights);

/// Systematic resampling by weights that sum up to 1. Returns as many indices as there are weights, ascending, each
/// index on average in proportion to its weight. One random number serves for all, so that of n particles one of weight
/// w is taken floor(n w) or ceil(n w) times. A particle of at least average weight is never lost.
std::vector<std::size_t> resampled(const std::vector<double>& weights, RandomStream& random);

}  // namespace swiftlet::common
