// Which particles live on (Grisetti 2007, section III.B and Doucet 2000).
#pragma once

#include <cstddef>
#include <vector>

#include "common/random.hpp"

namespace swiftlet::perception {

/// Weights that sum up to 1 from their logarithms. Finite, at least one; the logarithms may be of any size.
std::vector<double> normalizedWeights(const std::vector<double>& log_weights);

/// 1 / sum of w^2 of weights that sum up to 1: as many equal ones would be as good. Between 1 and their number.
double effectiveSampleSize(const std::vector<double>& weights);

/// Systematic resampling of weights that sum up to 1: so many indices, ascending, each on average in proportion to its
/// weight. One random number for all, so that a particle of weight w is taken floor(n w) or ceil(n w) times: one of at
/// least average weight is never lost.
std::vector<std::size_t> resampled(const std::vector<double>& weights, common::RandomStream& random);

}  // namespace swiftlet::perception
