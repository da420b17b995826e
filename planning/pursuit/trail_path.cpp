#include "planning/pursuit/trail_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "planning/search/wavefront.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;
using Points = std::vector<Point>;

/// A place where the person walked too near to a wall is passed at most this far beside it.
constexpr double kAside_m = 0.5;
constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// The places of the path: the start, those of the trail where the hull may be, and the person's.
Points placesOf(const CostMap& costs, const Point& start, const Point& person, std::span<const Point> trail) {
  Points places{start};
  const auto add = [&](const Point& place) {
    if (!isLethalAt(costs, place))
      places.push_back(place);
    else if (const auto beside = nearestFree(costs, place, kAside_m))
      places.push_back(*beside);
  };
  for (const Point& place : trail) add(place);
  add(person);
  return places;
}

/// From the first place to the last one that can be reached, each after all earlier ones.
Points cheapestChain(const CostMap& costs, const Points& places) {
  std::vector<double> cost_m(places.size(), kUnreached);
  std::vector<std::size_t> came_from(places.size(), 0);
  cost_m[0] = 0.0;
  std::size_t last = 0;
  for (std::size_t to = 1; to < places.size(); ++to) {
    for (std::size_t from = 0; from < to; ++from) {
      if (cost_m[from] + (places[to] - places[from]).norm() >= cost_m[to]) continue;
      const SegmentCost leg = segmentCost(costs, places[from], places[to]);
      if (leg.lethal || cost_m[from] + leg.cost_m >= cost_m[to]) continue;
      cost_m[to] = cost_m[from] + leg.cost_m;
      came_from[to] = from;
    }
    if (cost_m[to] < kUnreached) last = to;
  }
  Points chain{places[last]};
  for (std::size_t at = last; at != 0; at = came_from[at]) chain.push_back(places[came_from[at]]);
  std::reverse(chain.begin(), chain.end());
  return chain;
}

/// As the planner leads to the last place, where no chain of straight lines does.
Points planned(const CostMap& costs, const Points& places, const Points& otherwise) {
  if (otherwise.back() == places.back() || places.size() < 2) return otherwise;
  const auto path = Wavefront().plan(costs, places.front(), places.back());
  return path ? path->points_map_m : otherwise;
}

/// The chain up to the circle around the person.
Points cut(const Points& chain, const Point& person, double radius_m) {
  Points kept;
  for (const Point& to : chain) {
    if ((to - person).norm() > radius_m) {
      kept.push_back(to);
      continue;
    }
    if (kept.empty()) return {chain.front()};
    const Point along = to - kept.back(), off = kept.back() - person;
    const double a = along.squaredNorm(), b = off.dot(along), c = off.squaredNorm() - radius_m * radius_m;
    kept.push_back(kept.back() + std::clamp((-b - std::sqrt(std::max(0.0, b * b - a * c))) / a, 0.0, 1.0) * along);
    break;
  }
  return kept;
}

}  // namespace

Path trailPath(const CostMap& costs, const Point& from_map_m, const Point& person_map_m,
               std::span<const Point> trail_map_m) {
  Points points = escapePoints_map_m(costs, from_map_m);
  const std::size_t escape_points = points.size() - 1;
  const Points places = placesOf(costs, points.back(), person_map_m, trail_map_m);
  const Points chain = cut(planned(costs, places, cheapestChain(costs, places)), person_map_m, kTrailEndsAt_m);
  points.insert(points.end(), chain.begin() + 1, chain.end());
  return pathThrough(costs, std::move(points), escape_points);
}

}  // namespace swiftlet::planning
