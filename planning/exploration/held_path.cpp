#include "planning/exploration/held_path.hpp"

#include "planning/costs/localizability.hpp"
#include "planning/costs/sight.hpp"

namespace swiftlet::planning {
namespace {

/// Longest stretch of a path without walls around it; a viewpoint behind a longer one is not chosen
/// (docs/decisions/planning.md#088).
constexpr double kMaxUnheld_m = 4.0;
constexpr int kRays = 36;  ///< Every 10 degrees: a wall of a metre is met within 5 m.
/// Places along the path that are judged. The walls around change little within it.
constexpr double kSpacing_m = 1.0;

}  // namespace

bool isHeld(const CostMap& map, const Eigen::Vector2d& place_map_m) {
  static const Directions kDirections(kRays);
  const common::CellIndex place = map.cellAt(place_map_m);
  return !map.rect().contains(place) || hasWallsToMatch(map, place, kDirections);
}

bool staysHeld(const CostMap& map, std::span<const Eigen::Vector2d> path_map_m) {
  if (path_map_m.size() > 1 && !isHeld(map, path_map_m.back())) return false;
  double unheld_m = 0.0, to_judge_m = kSpacing_m;  // Up to the next place that is judged.
  bool left_start = false;
  for (std::size_t i = 1; i < path_map_m.size(); ++i) {
    const Eigen::Vector2d leg = path_map_m[i] - path_map_m[i - 1];
    const double leg_m = leg.norm();
    for (; to_judge_m <= leg_m; to_judge_m += kSpacing_m) {
      const bool held = isHeld(map, path_map_m[i - 1] + leg * (to_judge_m / leg_m));
      left_start |= held;
      unheld_m = held ? 0.0 : unheld_m + kSpacing_m;
      if (left_start && unheld_m > kMaxUnheld_m) return false;
    }
    to_judge_m -= leg_m;
  }
  return true;
}

}  // namespace swiftlet::planning
