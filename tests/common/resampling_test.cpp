// Resampling: in proportion to the weights, without bias, and the best particle stays.
#include "common/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace swiftlet::common {
namespace {

TEST(Resampling, NormalizesWeightsOfAnySize) {
  for (const double shift : {0.0, -1e5, 1e5}) {
    const std::vector<double> weights = normalizedWeights({shift, shift + std::log(3.0), shift - 1e4});
    EXPECT_NEAR(weights[0], 0.25, 1e-9);
    EXPECT_NEAR(weights[1], 0.75, 1e-9);
    EXPECT_EQ(weights[2], 0.0);
  }
}

TEST(Resampling, TheEffectiveSampleSizeIsBetweenOneAndAll) {
  EXPECT_NEAR(effectiveSampleSize({0.25, 0.25, 0.25, 0.25}), 4.0, 1e-12);
  EXPECT_NEAR(effectiveSampleSize({1.0, 0.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(effectiveSampleSize({0.5, 0.5, 0.0, 0.0}), 2.0, 1e-12);
}

std::vector<double> randomWeights(std::size_t count, RandomStream& random) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < count; ++i) logs.push_back(random.gaussian(2.0));
  return normalizedWeights(logs);
}

TEST(Resampling, EachIsDrawnInProportionToItsWeight) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random(seed, "weights");
    const std::vector<double> weights = randomWeights(30, random);
    const std::vector<std::size_t> chosen = resampled(weights, random);
    ASSERT_EQ(chosen.size(), weights.size());
    EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const auto taken = static_cast<double>(std::count(chosen.begin(), chosen.end(), i));
      EXPECT_GE(taken, std::floor(30.0 * weights[i] - 1e-9)) << seed;
      EXPECT_LE(taken, std::ceil(30.0 * weights[i] + 1e-9)) << seed;
    }
  }
}

TEST(Resampling, KeepsTheBestParticle) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomStream random(seed, "weights");
    const std::vector<double> weights = randomWeights(20, random);
    const auto best = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    const std::vector<std::size_t> chosen = resampled(weights, random);
    EXPECT_NE(std::find(chosen.begin(), chosen.end(), best), chosen.end()) << seed;
  }
}

/// Over many draws the mean number of descendants is n w: no place in the list is favoured.
TEST(Resampling, IsUnbiased) {
  constexpr int kDraws = 20'000;
  const std::vector<double> weights{0.02, 0.41, 0.003, 0.067, 0.25, 0.15, 0.0, 0.1};
  std::vector<double> taken(weights.size(), 0.0);
  for (std::uint64_t seed = 0; seed < kDraws; ++seed) {
    RandomStream random(seed, "resampling");
    for (const std::size_t i : resampled(weights, random)) taken[i] += 1.0;
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = 8.0 * weights[i];
    // A number between floor and ceil of its mean has a variance of at most 1/4; five sigmas of the mean.
    EXPECT_NEAR(taken[i] / kDraws, expected, 5.0 * 0.5 / std::sqrt(kDraws)) << i;
  }
  EXPECT_EQ(taken[6], 0.0);
}

}  // namespace
}  // namespace swiftlet::common
