// Tours are permutations, exact where they promise it, and never worse than other orders nearby beyond.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/random.hpp"
#include "grid_builder.hpp"
#include "planning/exploration/coarse_costs.hpp"
#include "planning/exploration/tour.hpp"

namespace swiftlet::planning {
namespace {

/// Stops drawn in a square; with an end, home is at the start.
TourCosts drawnCosts(std::size_t stops, std::uint64_t seed, bool ends_at_home) {
  common::RandomStream random(seed, "tour");
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i <= stops; ++i) places.emplace_back(random.uniform(0.0, 10.0), random.uniform(0.0, 10.0));
  TourCosts costs(stops);
  for (std::size_t i = 0; i <= stops; ++i) {
    for (std::size_t j = 0; j <= stops; ++j) costs.between(i, j) = (places[i] - places[j]).norm();
    if (ends_at_home) costs.toEnd(i) = costs.between(i, 0);
  }
  return costs;
}

double leastOfAll(const TourCosts& costs, std::optional<std::size_t> first) {
  std::vector<std::size_t> order(costs.stops());
  std::iota(order.begin(), order.end(), 1U);
  double least = 1e9;
  do {
    if (!first || order.front() == *first) least = std::min(least, tourCost(costs, order));
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

void expectPermutation(const std::vector<std::size_t>& order, std::size_t stops) {
  std::vector<std::size_t> sorted = order, all(stops);
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 1U);
  EXPECT_EQ(sorted, all);
}

RC_GTEST_PROP(Tour, IsTheShortestOfAllOrders, ()) {
  const auto stops = *rc::gen::inRange<std::size_t>(1, 7);
  const TourCosts costs = drawnCosts(stops, *rc::gen::arbitrary<std::uint16_t>(), *rc::gen::arbitrary<bool>());
  const auto first = *rc::gen::arbitrary<bool>() ? std::optional(*rc::gen::inRange<std::size_t>(1, stops + 1))
                                                 : std::optional<std::size_t>();
  const auto order = shortestTour(costs, first);
  expectPermutation(order, stops);
  RC_ASSERT(!first || order.front() == *first);
  RC_ASSERT(std::abs(tourCost(costs, order) - leastOfAll(costs, first)) < 1e-9);
}

TEST(Tour, OfManyStopsNoReversalAndNoMoveSavesAnything) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TourCosts costs = drawnCosts(24, seed, seed % 2 == 0);
    const auto order = shortestTour(costs);
    expectPermutation(order, 24);
    const double cost = tourCost(costs, order);
    EXPECT_EQ(order, shortestTour(costs)) << "the same each time";
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        auto other = order;
        std::reverse(other.begin() + static_cast<std::ptrdiff_t>(i),
                     other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        EXPECT_GE(tourCost(costs, other), cost - 1e-6);
        other = order;
        std::rotate(other.begin() + static_cast<std::ptrdiff_t>(i), other.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                    other.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        EXPECT_GE(tourCost(costs, other), cost - 1e-6);
      }
  }
}

TEST(Tour, OfManyStopsBeginsWhereItIsAsked) {
  const TourCosts costs = drawnCosts(15, 3, true);
  const auto order = shortestTour(costs, 7);
  expectPermutation(order, 15);
  EXPECT_EQ(order.front(), 7u);
  EXPECT_TRUE(shortestTour(TourCosts(0)).empty());
}

/// A room that a wall with a door at one end divides.
TEST(CoarseCosts, LeadAroundWallsAndAreNearTheFineOnes) {
  common::OccupancyGrid grid = test::room(200, 120);
  test::fill(grid, {{100, 0}, {102, 90}}, test::kWallCell);
  const CostMap map = test::mapOf(grid);
  CostField field;
  const common::CellIndex from{40, 20};
  field.spread(map, from);
  CoarseCosts coarse(map, field);
  const std::vector<common::CellIndex> places{{60, 20}, {160, 20}, {40, 100}, {102, 105}};
  const std::vector<double> costs_m = coarse.between_m(from, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double fine_m = field.cost_m(map.indexOf(places[i]), map.resolution_m());
    EXPECT_NEAR(costs_m[i], fine_m, 0.15 * fine_m + 0.3) << i;
  }
  EXPECT_GT(costs_m[1], 9.0) << "around the wall, not through it";
  test::fill(grid, {{100, 0}, {102, 120}}, test::kWallCell);
  const CostMap closed = test::mapOf(grid);
  field.spread(closed, from);
  EXPECT_TRUE(std::isinf(CoarseCosts(closed, field).between_m(from, places)[1]));
}

}  // namespace
}  // namespace swiftlet::planning
