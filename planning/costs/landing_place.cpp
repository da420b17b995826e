#include "planning/costs/landing_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "common/geometry.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using Eigen::Vector2d;

constexpr double kUnseen_m = std::numeric_limits<double>::quiet_NaN();
/// Surfaces whose heights differ by less are one floor, for the noise of the heights.
constexpr double kStep_m = 0.06;
/// A raised surface is chosen only if the floor is farther away by this path length.
constexpr double kUpperCost_m = 1.5;
/// The end of the trail, beyond which nothing was seen, is chosen only if floor that was seen to both sides of the hull
/// is farther away by this path length (docs/decisions/fail_safes.md#090).
constexpr double kUnseenCost_m = 1.0;
/// A place whose margin holds only if no edge runs askew is chosen only if a clearer one is farther away by this
/// (docs/decisions/fail_safes.md#090).
constexpr double kAskewCost_m = 1.0;
/// Beyond the hull and its margin, cells within this distance must show that the surface continues.
constexpr double kBeyond_m = 0.2;
/// Where straight on is not free, as beside a wall, the vehicle looks past the obstacle.
constexpr std::array kLooks_deg = {0.0, 30.0, -30.0, 60.0, -60.0};
/// A cell counts from this much overlap on, far above the rounding of its place.
constexpr double kTouching_m = 1e-6;

/// The heights of the highest surfaces below, on the levels' own cells around a place.
class SurfaceWindow {
 public:
  SurfaceWindow(const common::LevelMap& levels, const Vector2d& center_map_m, double half_m)
      : resolution_m_(levels.resolution_m),
        begin_{static_cast<int>(std::floor((center_map_m.x() - half_m) / resolution_m_)),
               static_cast<int>(std::floor((center_map_m.y() - half_m) / resolution_m_))},
        side_(static_cast<int>(std::ceil(2.0 * half_m / resolution_m_)) + 1),
        heights_m_(static_cast<std::size_t>(side_) * side_, kUnseen_m) {
    for (const common::Level& level : levels.levels)
      for (const CellIndex cell : level.cells)
        if (contains(cell)) {
          double& height_m = heights_m_[indexOf(cell)];
          if (!(height_m >= level.height_m)) height_m = level.height_m;
        }
  }

  double heightAt(const Vector2d& place_map_m) const { return heightOf(cellAt(place_map_m)); }

  /// Whether a disc lies on one surface of that height, as far as it was seen.
  bool isLevel(const Vector2d& center_map_m, double radius_m, double height_m) const {
    bool level = true;
    eachSeen(center_map_m, radius_m, [&](const Vector2d& low, double seen_m) {
      // By the nearest point of the cell: a surface begins somewhere in it. A cell that the disc only touches is not in
      // it.
      const Vector2d high = low.array() + resolution_m_;
      if ((center_map_m.cwiseMax(low).cwiseMin(high) - center_map_m).norm() > radius_m - kTouching_m) return;
      if (std::abs(seen_m - height_m) > kStep_m) level = false;
    });
    return level;
  }

  /// How far from the center that surface was seen.
  struct Extent {
    Vector2d farthest_m = Vector2d::Zero();  ///< To its farthest cell within the radius.
    double opposite_m = 0.0;                 ///< In the opposite direction.
    double toBothSides_m() const { return std::min(farthest_m.norm(), opposite_m); }
  };
  Extent extentOf(const Vector2d& center_map_m, double radius_m, double height_m) const {
    std::vector<Vector2d> cells_m;
    Extent extent;
    eachSeen(center_map_m, radius_m, [&](const Vector2d& low, double seen_m) {
      const Vector2d at_m = low.array() + 0.5 * resolution_m_ - center_map_m.array();
      if (std::abs(seen_m - height_m) > kStep_m || at_m.norm() > radius_m) return;
      cells_m.push_back(at_m);
      if (at_m.norm() > extent.farthest_m.norm()) extent.farthest_m = at_m;
    });
    const Vector2d back = -extent.farthest_m.normalized();
    for (const Vector2d& at_m : cells_m) extent.opposite_m = std::max(extent.opposite_m, at_m.dot(back));
    return extent;
  }

 private:
  /// Visits the cells around a place that were seen, by their lower corners.
  template <typename Visit>
  void eachSeen(const Vector2d& center_map_m, double radius_m, const Visit& visit) const {
    const CellIndex center = cellAt(center_map_m);
    const int reach = static_cast<int>(std::ceil(radius_m / resolution_m_)) + 1;
    for (int y = center.y - reach; y <= center.y + reach; ++y)
      for (int x = center.x - reach; x <= center.x + reach; ++x)
        if (const double seen_m = heightOf({x, y}); !std::isnan(seen_m))
          visit(Vector2d(x * resolution_m_, y * resolution_m_), seen_m);
  }
  bool contains(CellIndex c) const {
    return c.x >= begin_.x && c.x < begin_.x + side_ && c.y >= begin_.y && c.y < begin_.y + side_;
  }
  std::size_t indexOf(CellIndex c) const {
    return static_cast<std::size_t>(c.y - begin_.y) * side_ + static_cast<std::size_t>(c.x - begin_.x);
  }
  double heightOf(CellIndex c) const { return contains(c) ? heights_m_[indexOf(c)] : kUnseen_m; }
  CellIndex cellAt(const Vector2d& p) const {
    return {static_cast<int>(std::floor(p.x() / resolution_m_)), static_cast<int>(std::floor(p.y() / resolution_m_))};
  }

  double resolution_m_;
  CellIndex begin_;
  int side_;
  std::vector<double> heights_m_;
};

/// The length of the flight to a place, with what a raised surface adds; nullopt where the vehicle cannot stand.
std::optional<double> costOf(const SurfaceWindow& surfaces, const Vector2d& place_map_m, double length_m,
                             const LandingNeeds& needs) {
  const double height_m = surfaces.heightAt(place_map_m);
  if (std::isnan(height_m)) return std::nullopt;
  if (!surfaces.isLevel(place_map_m, needs.aside_m(), height_m)) return std::nullopt;
  const double seen_to_m = surfaces.extentOf(place_map_m, needs.aside_m() + kBeyond_m, height_m).toBothSides_m();
  const bool raised = height_m >= kStep_m, unseen = seen_to_m < needs.aside_m();
  if (raised && seen_to_m < needs.hull_radius_m) return std::nullopt;
  const bool clear = surfaces.isLevel(place_map_m, needs.asideAskew_m(), height_m);
  return length_m + (raised ? kUpperCost_m : 0.0) + (unseen ? kUnseenCost_m : 0.0) + (clear ? 0.0 : kAskewCost_m);
}

}  // namespace

std::optional<Vector2d> landingPlace(const CostMap& map, const common::LevelMap& levels, const Vector2d& from_map_m,
                                     const LandingNeeds& needs) {
  const CellIndex start = map.cellAt(from_map_m);
  if (!map.rect().contains(start) || levels.levels.empty()) return std::nullopt;
  const SurfaceWindow surfaces(levels, from_map_m,
                               needs.reach_m + std::max(needs.aside_m() + kBeyond_m, needs.asideAskew_m()));

  // Dijkstra by length. Where the vehicle is already it may be nearer to an obstacle than a plan would go.
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<double> length_m(map.costs().size(), std::numeric_limits<double>::infinity());
  std::vector<bool> closed(map.costs().size(), false);
  const auto reach = [&](CellIndex cell, double to_m) {
    if (!map.rect().contains(cell)) return;
    const int index = map.indexOf(cell);
    const bool escapes = to_m <= needs.hull_radius_m && map.states()[index] == CellState::kFree;
    if ((map.isLethal(index) && !escapes && cell != start) || to_m > needs.reach_m) return;
    if (to_m >= length_m[static_cast<std::size_t>(index)]) return;
    length_m[static_cast<std::size_t>(index)] = to_m;
    open.emplace(to_m, index);
  };
  reach(start, 0.0);

  std::optional<Vector2d> best;
  double best_m = std::numeric_limits<double>::infinity();
  while (!open.empty()) {
    const auto [here_m, index] = open.top();
    open.pop();
    if (here_m >= best_m) break;
    if (closed[static_cast<std::size_t>(index)]) continue;
    closed[static_cast<std::size_t>(index)] = true;
    const CellIndex cell = map.cellOf(index);
    const Vector2d place = cell == start ? from_map_m : map.centerOf(cell);
    const auto cost_m = costOf(surfaces, place, here_m, needs);
    if (cost_m && *cost_m < best_m && (!map.isLethal(index) || cell == start)) {
      best = place;
      best_m = *cost_m;
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0) reach({cell.x + dx, cell.y + dy}, here_m + std::hypot(dx, dy) * map.resolution_m());
  }
  return best;
}

std::optional<Vector2d> placeToLookFrom(const CostMap& map, const common::LevelMap& levels, const Vector2d& from_map_m,
                                        const LandingNeeds& needs) {
  const double reach_m = needs.aside_m() + kBeyond_m;
  const SurfaceWindow surfaces(levels, from_map_m, reach_m);
  const double height_m = surfaces.heightAt(from_map_m);
  if (std::isnan(height_m) || !surfaces.isLevel(from_map_m, needs.aside_m(), height_m)) return std::nullopt;
  const auto extent = surfaces.extentOf(from_map_m, reach_m, height_m);
  if (extent.toBothSides_m() >= needs.aside_m() || extent.farthest_m.isZero()) return std::nullopt;
  const Vector2d ahead = -extent.farthest_m.normalized();
  for (const double turn_deg : kLooks_deg) {
    const Vector2d along = Eigen::Rotation2Dd(turn_deg * common::kRadPerDeg) * ahead;
    // Where the vehicle is already it may be nearer to an obstacle than a path would go.
    const Vector2d place = from_map_m + reach_m * along;
    if (isFree(map, from_map_m + map.resolution_m() * along, place)) return place;
  }
  return std::nullopt;
}

}  // namespace swiftlet::planning
