// The order in which to visit a few stops: an open travelling-salesman problem from a start, with the cost of going on
// from the last stop, such as the way home. Exact for few stops (Held and Karp 1962, "A dynamic programming approach to
// sequencing problems"); else nearest insertion (Rosenkrantz 1977), improved by 2-opt (Croes 1958) and Or-opt (Or
// 1976).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace swiftlet::planning {

/// Node 0 is the start, the stops are 1 to stops(). Costs are finite, not negative, and need not be symmetric.
class TourCosts {
 public:
  explicit TourCosts(std::size_t stops) : nodes_(stops + 1), cost_(nodes_ * nodes_, 0.0), end_(nodes_, 0.0) {}

  std::size_t stops() const { return nodes_ - 1; }
  double& between(std::size_t from, std::size_t to) { return cost_[from * nodes_ + to]; }
  double between(std::size_t from, std::size_t to) const { return cost_[from * nodes_ + to]; }
  /// From a last stop on to the end; 0 where the tour may end anywhere.
  double& toEnd(std::size_t from) { return end_[from]; }
  double toEnd(std::size_t from) const { return end_[from]; }

 private:
  std::size_t nodes_;
  std::vector<double> cost_;
  std::vector<double> end_;
};

/// Stops up to which the shortest tour is found exactly.
inline constexpr std::size_t kMostExactStops = 9;

/// The cost of visiting these stops in this order and of going on from the last one.
double tourCost(const TourCosts& costs, const std::vector<std::size_t>& order);

/// All stops in the order of least cost: exact for at most kMostExactStops, and no worse than 2-opt and Or-opt beyond.
/// `first` is the stop that it begins with, if given. The same costs give the same order.
std::vector<std::size_t> shortestTour(const TourCosts& costs, std::optional<std::size_t> first = std::nullopt);

}  // namespace swiftlet::planning
