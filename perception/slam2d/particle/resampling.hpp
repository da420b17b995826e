// The resampling of particles (Grisetti 2007, section III.B, and Doucet 2000).
#pragma once

#include <cstddef>
#include <vector>

#include "common/random.hpp"

namespace swiftlet::perception {

/// Weights that sum up to 1, from their logarithms. There must be at least one; all must be finite, of any size.
std::vector<double> normalizedWeights(const std::vector<double>& log_weights);

/// 1 / sum of w^2, for weights that sum up to 1: this many particles of equal weight would be as good. Between 1 and
/// the number of weights.
double effectiveSampleSize(const std::vector<double>& weights);

/// Systematic resampling by weights that sum up to 1. Returns as many indices as there are weights, ascending, each
/// index on average in proportion to its weight. One random number serves for all, so that of n particles one of weight
/// w is taken floor(n w) or ceil(n w) times. A particle of at least average weight is never lost.
std::vector<std::size_t> resampled(const std::vector<double>& weights, common::RandomStream& random);

}  // namespace swiftlet::perception
