#include "planning/exploration/tour.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using Order = std::vector<std::size_t>;

constexpr double kNever = std::numeric_limits<double>::infinity();
/// What an exchange must save at least: less is rounding.
constexpr double kLeastSaving = 1e-9;

/// Held and Karp: the least cost of visiting a set of stops and being at one of them.
Order exactTour(const TourCosts& costs, std::optional<std::size_t> first) {
  const std::size_t stops = costs.stops(), sets = std::size_t{1} << stops;
  std::vector<double> least(sets * stops, kNever);
  std::vector<std::uint8_t> before(sets * stops, 0);
  for (std::size_t s = 0; s < stops; ++s)
    if (!first || *first == s + 1) least[(std::size_t{1} << s) * stops + s] = costs.between(0, s + 1);
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t at = 0; at < stops; ++at) {
      const double here = least[set * stops + at];
      if (here == kNever) continue;
      for (std::size_t next = 0; next < stops; ++next) {
        if ((set >> next & 1U) != 0) continue;
        const std::size_t after = (set | std::size_t{1} << next) * stops + next;
        const double cost = here + costs.between(at + 1, next + 1);
        if (cost >= least[after]) continue;
        least[after] = cost;
        before[after] = static_cast<std::uint8_t>(at);
      }
    }
  std::size_t last = 0;
  const auto whole = [&](std::size_t s) { return least[(sets - 1) * stops + s] + costs.toEnd(s + 1); };
  for (std::size_t s = 1; s < stops; ++s)
    if (whole(s) < whole(last)) last = s;
  Order order;
  for (std::size_t set = sets - 1, at = last; set != 0;) {
    order.push_back(at + 1);
    const std::size_t came = before[set * stops + at];
    set &= ~(std::size_t{1} << at);
    at = came;
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Takes the stop nearest to the tour so far, and puts it where it costs least. Stops before `fixed` are not moved.
Order insertedTour(const TourCosts& costs, std::optional<std::size_t> first) {
  Order order;
  std::vector<double> nearest(costs.stops() + 1, kNever);
  std::vector<bool> is_in(costs.stops() + 1, false);
  const auto take = [&](std::size_t stop) {
    is_in[stop] = true;
    for (std::size_t s = 1; s <= costs.stops(); ++s) nearest[s] = std::min(nearest[s], costs.between(stop, s));
  };
  take(0);
  if (first) {
    order.push_back(*first);
    take(*first);
  }
  const std::size_t fixed = order.size();
  while (order.size() < costs.stops()) {
    std::size_t next = 0;
    for (std::size_t s = 1; s <= costs.stops(); ++s)
      if (!is_in[s] && (next == 0 || nearest[s] < nearest[next])) next = s;
    std::size_t place = fixed;
    double least = kNever;
    for (std::size_t i = fixed; i <= order.size(); ++i) {
      Order with = order;
      with.insert(with.begin() + static_cast<std::ptrdiff_t>(i), next);
      const double cost = tourCost(costs, with);
      if (cost >= least) continue;
      least = cost;
      place = i;
    }
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(place), next);
    take(next);
  }
  return order;
}

/// Turns a stretch of the tour round wherever that saves something. True if it did.
bool improveByTwoOpt(const TourCosts& costs, std::size_t fixed, Order& order) {
  bool improved = false;
  double cost = tourCost(costs, order);
  for (std::size_t i = fixed; i + 1 < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const auto begin = order.begin() + static_cast<std::ptrdiff_t>(i),
                 end = order.begin() + static_cast<std::ptrdiff_t>(j) + 1;
      std::reverse(begin, end);
      const double turned = tourCost(costs, order);
      if (turned < cost - kLeastSaving) {
        cost = turned;
        improved = true;
      } else {
        std::reverse(begin, end);
      }
    }
  return improved;
}

/// Moves one to three stops in a row to elsewhere wherever that saves something. True if it did.
bool improveByOrOpt(const TourCosts& costs, std::size_t fixed, Order& order) {
  constexpr std::size_t kLongest = 3;
  double cost = tourCost(costs, order);
  for (std::size_t length = 1; length <= kLongest; ++length)
    for (std::size_t from = fixed; from + length <= order.size(); ++from) {
      Order rest = order;
      const auto begin = rest.begin() + static_cast<std::ptrdiff_t>(from);
      const Order moved(begin, begin + static_cast<std::ptrdiff_t>(length));
      rest.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
      for (std::size_t to = fixed; to <= rest.size(); ++to) {
        Order other = rest;
        other.insert(other.begin() + static_cast<std::ptrdiff_t>(to), moved.begin(), moved.end());
        if (tourCost(costs, other) >= cost - kLeastSaving) continue;
        order = std::move(other);
        return true;
      }
    }
  return false;
}

}  // namespace

double tourCost(const TourCosts& costs, const Order& order) {
  double cost = 0.0;
  std::size_t at = 0;
  for (const std::size_t stop : order) {
    cost += costs.between(at, stop);
    at = stop;
  }
  return cost + costs.toEnd(at);
}

Order shortestTour(const TourCosts& costs, std::optional<std::size_t> first) {
  SWIFTLET_CHECK(!first || (*first >= 1 && *first <= costs.stops()), first.value_or(0), costs.stops());
  if (costs.stops() == 0) return {};
  if (costs.stops() <= kMostExactStops) return exactTour(costs, first);
  Order order = insertedTour(costs, first);
  const std::size_t fixed = first ? 1 : 0;
  // Each pass saves something, so that no order comes twice; the bound is for the time.
  constexpr int kMostPasses = 200;
  for (int pass = 0; pass < kMostPasses; ++pass)
    if (!improveByTwoOpt(costs, fixed, order) && !improveByOrOpt(costs, fixed, order)) break;
  return order;
}

}  // namespace swiftlet::planning
