#include "evaluation/exploration/known_tour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <numbers>
#include <utility>

#include "planning/exploration/tour.hpp"
#include "planning/search/planner.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::evaluation {
namespace {

using common::CellIndex;
using planning::CostField;
using planning::CostMap;
using Point = Eigen::Vector2d;

/// Between two candidates for a viewpoint, and between two places along the tour from which something is seen.
constexpr double kLattice_m = 1.0, kAlong_m = 0.5;
constexpr int kRays = 720;
/// Between the places that are to be seen.
constexpr double kTarget_m = 0.2;
/// The share of the reachable places that the tour may leave unseen, as explorations may.
constexpr double kMostUnseen = 0.01;

class TourFinder {
 public:
  TourFinder(const FlatBuilding& building, const CostMap& map, const Point& start_m, double range_m)
      : building_(building), map_(map), start_m_(start_m), range_m_(range_m) {
    field_.spread(map, map.cellAt(start_m));
    counted_.assign(static_cast<std::size_t>(building.rect().width()) * building.rect().height(), 0);
    const int step = cellsOf(kTarget_m);
    for (int i = 0; i < static_cast<int>(map.costs().size()); ++i) {
      const CellIndex cell = map.cellOf(i);
      if (!field_.reached(i) || cell.x % step != 0 || cell.y % step != 0) continue;
      counted_[building.indexOf(cell)] = 1;
      ++targets_;
    }
  }

  KnownTour find() {
    cover();
    order(places_m_);
    while (leaveOneOut()) continue;
    return measured();
  }

 private:
  int cellsOf(double length_m) const {
    return std::max(1, static_cast<int>(std::lround(length_m / map_.resolution_m())));
  }

  const std::vector<std::uint32_t>& seenFrom(CellIndex place) {
    const auto [entry, is_new] = seen_from_.try_emplace(map_.indexOf(place));
    std::vector<std::uint32_t>& cells = entry->second;
    if (!is_new) return cells;
    const auto note = [&](CellIndex cell, bool is_wall) {
      if (is_wall) return;
      const std::size_t index = building_.indexOf(cell);
      if (counted_[index] != 0) cells.push_back(static_cast<std::uint32_t>(index));
    };
    for (int i = 0; i < kRays; ++i)
      building_.cast(map_.centerOf(place), 2.0 * std::numbers::pi * i / kRays, range_m_, note);
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
  }

  bool isEnough(std::size_t seen) const {
    return static_cast<double>(targets_ - seen) <= kMostUnseen * static_cast<double>(targets_);
  }

  /// Again and again the place that sees most of what is left.
  void cover() {
    std::vector<CellIndex> candidates;
    for (int i = 0; i < static_cast<int>(map_.costs().size()); ++i) {
      const CellIndex cell = map_.cellOf(i);
      const int step = cellsOf(kLattice_m);
      if (field_.reached(i) && cell.x % step == 0 && cell.y % step == 0) candidates.push_back(cell);
    }
    std::vector<std::uint8_t> seen(counted_.size(), 0);
    std::size_t count = look(map_.cellAt(start_m_), seen);
    // The count of a candidate only falls: the one that leads with a fresh count is the best.
    std::vector<std::size_t> counts(candidates.size(), targets_);
    while (!isEnough(count) && !candidates.empty()) {
      std::size_t best = 0;
      for (bool is_fresh = false; !is_fresh;) {
        best = static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
        const std::vector<std::uint32_t>& cells = seenFrom(candidates[best]);
        const auto fresh = static_cast<std::size_t>(
            std::count_if(cells.begin(), cells.end(), [&](std::uint32_t cell) { return seen[cell] == 0; }));
        is_fresh = fresh == counts[best];
        counts[best] = fresh;
      }
      if (counts[best] == 0) break;
      places_m_.push_back(map_.centerOf(candidates[best]));
      count += look(candidates[best], seen);
    }
  }

  /// Marks what is seen from there, and returns how much of it is new.
  std::size_t look(CellIndex from, std::vector<std::uint8_t>& seen) {
    std::size_t count = 0;
    for (const std::uint32_t cell : seenFrom(from)) {
      count += seen[cell] == 0 ? 1 : 0;
      seen[cell] = 1;
    }
    return count;
  }

  /// Orders these places, and returns the length of the tour through them.
  double order(const std::vector<Point>& places_m) {
    places_m_ = places_m;
    costs_ = planning::TourCosts(places_m.size());
    for (std::size_t i = 0; i <= places_m.size(); ++i) {
      const CostField& field = fieldFrom(i == 0 ? start_m_ : places_m[i - 1]);
      const auto to = [&](const Point& place_m) {
        return field.cost_m(map_.indexOf(map_.cellAt(place_m)), map_.resolution_m());
      };
      costs_.toEnd(i) = to(start_m_);
      for (std::size_t j = 0; j < places_m.size(); ++j) costs_.between(i, j + 1) = to(places_m[j]);
    }
    order_ = planning::shortestTour(costs_);
    return planning::tourCost(costs_, order_);
  }

  /// Leaves out the place that costs most of those without which the tour still sees enough. False if there is none.
  bool leaveOneOut() {
    const std::vector<Point> places_m = places_m_;
    const double whole_m = planning::tourCost(costs_, order_);
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::size_t before = i == 0 ? 0 : order_[i - 1];
      const bool is_last = i + 1 == order_.size();
      const double through = costs_.between(before, order_[i]) +
                             (is_last ? costs_.toEnd(order_[i]) : costs_.between(order_[i], order_[i + 1]));
      costs.emplace_back((is_last ? costs_.toEnd(before) : costs_.between(before, order_[i + 1])) - through,
                         order_[i] - 1);
    }
    std::sort(costs.begin(), costs.end());
    for (const auto& [cost, place] : costs) {
      std::vector<Point> fewer = places_m;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(place));
      if (order(fewer) <= whole_m + 1e-9 && seesEnough()) return true;
    }
    order(places_m);
    return false;
  }

  bool seesEnough() {
    std::vector<std::uint8_t> seen(counted_.size(), 0);
    std::size_t count = look(map_.cellAt(start_m_), seen);
    Point at_m = start_m_;
    const auto flyTo = [&](const Point& to_m) {
      const planning::CellPath cells = fieldFrom(at_m).pathTo(map_, map_.cellAt(to_m));
      const auto step = static_cast<std::size_t>(cellsOf(kAlong_m));
      for (std::size_t i = 0; i < cells.size(); i += step) count += look(cells[i], seen);
      count += look(cells.back(), seen);
      at_m = to_m;
    };
    for (const std::size_t stop : order_) flyTo(places_m_[stop - 1]);
    flyTo(start_m_);
    return isEnough(count);
  }

  /// Along straight lines instead of from cell to cell.
  KnownTour measured() {
    KnownTour tour;
    tour.points_map_m.push_back(start_m_);
    for (const std::size_t stop : order_) tour.points_map_m.push_back(places_m_[stop - 1]);
    tour.points_map_m.push_back(start_m_);
    planning::Wavefront planner;
    for (std::size_t i = 1; i < tour.points_map_m.size(); ++i)
      if (const auto path = planner.plan(map_, tour.points_map_m[i - 1], tour.points_map_m[i]))
        tour.length_m += path->length_m;
    return tour;
  }

  const CostField& fieldFrom(const Point& place_m) {
    const int index = map_.indexOf(map_.cellAt(place_m));
    for (auto& [from, field] : fields_)
      if (from == index) return field;
    fields_.emplace_back(index, CostField());
    fields_.back().second.spread(map_, map_.cellOf(index));
    return fields_.back().second;
  }

  const FlatBuilding& building_;
  const CostMap& map_;
  Point start_m_;
  double range_m_;
  CostField field_;
  std::vector<std::uint8_t> counted_;  ///< 1 for the places that are to be seen.
  std::size_t targets_ = 0;
  std::map<int, std::vector<std::uint32_t>> seen_from_;
  std::deque<std::pair<int, CostField>> fields_;  ///< Of the places so far; references into it stay valid.
  std::vector<Point> places_m_;
  planning::TourCosts costs_{0};
  std::vector<std::size_t> order_;
};

}  // namespace

KnownTour knownTour(const FlatBuilding& building, const CostMap& building_map, const Point& start_m,
                    double laser_range_m) {
  return TourFinder(building, building_map, start_m, laser_range_m).find();
}

}  // namespace swiftlet::evaluation
