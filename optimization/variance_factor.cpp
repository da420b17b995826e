#include "optimization/variance_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace swiftlet::optimization {
namespace {

constexpr double kLeastFactor = 1e-12;  ///< Where the edges agree but for rounding.

/// The chi-squared distribution's median (Wilson and Hilferty 1931).
double median(int degrees_of_freedom) {
  return degrees_of_freedom * std::pow(1.0 - 2.0 / (9.0 * degrees_of_freedom), 3);
}

}  // namespace

double varianceFactor(std::vector<double> squared, int degrees_of_freedom) {
  if (squared.empty()) return 1.0;
  std::sort(squared.begin(), squared.end());
  const std::size_t most = (squared.size() * 9 + 9) / 10;
  const double mean = std::accumulate(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(most), 0.0) /
                      static_cast<double>(most);
  return std::max({kLeastFactor, mean / degrees_of_freedom, squared[squared.size() / 2] / median(degrees_of_freedom)});
}

double gateOf(std::vector<double> squared, int degrees_of_freedom) {
  const double greatest = 100.0 * degrees_of_freedom * varianceFactor(squared, degrees_of_freedom);
  if (squared.empty()) return greatest;
  const auto at = squared.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(squared.size() - 1));
  std::nth_element(squared.begin(), at, squared.end());
  return std::clamp(kTailRatio * *at, 0.1 * greatest, greatest);
}

}  // namespace swiftlet::optimization
