#include "planning/search/goal_map.hpp"

#include <algorithm>
#include <utility>

#include "planning/search/planner.hpp"

namespace swiftlet::planning {
namespace {

struct KeptGoalMap {
  explicit KeptGoalMap(std::shared_ptr<const CostMap> kept) : map(std::move(kept)), view(*map) {}
  std::shared_ptr<const CostMap> map;
  CostGoalMap view;
};

bool mayBeAt(const CostMap& map, common::CellIndex cell, double clearance_m) {
  if (!map.rect().contains(cell)) return false;
  const int index = map.indexOf(cell);
  if (map.isKeptOut(index)) return false;
  const bool lethal = map.isLethal(index) && !map.isLethalByDisc(index);
  const Footprint& own = map.footprint();
  if (clearance_m == own.clearance_m) return !lethal;
  const double radius_m = std::min(own.hull_radius_m + clearance_m, map.reach_m());
  const bool near = map.clearance().at_m(cell, Against::kObstacles) < radius_m;
  const bool larger = clearance_m > own.clearance_m;
  return !near && (!lethal || (!larger && map.states().at(cell) == CellState::kFree));
}

}  // namespace

common::PlaceState CostGoalMap::stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const {
  const common::CellIndex cell = map_.cellAt(place_map_m);
  if (!map_.rect().contains(cell)) return common::PlaceState::kOutsideMap;
  if (mayBeAt(map_, cell, clearance_m)) return common::PlaceState::kFree;
  if (map_.isKeptOut(map_.indexOf(cell))) return common::PlaceState::kKeptOut;
  switch (map_.states().at(cell)) {
    case CellState::kOccupied:
      return common::PlaceState::kObstacle;
    case CellState::kUnknown:
      return common::PlaceState::kUnseen;
    case CellState::kFree:
      break;
  }
  return common::PlaceState::kTooClose;
}

std::optional<Eigen::Vector2d> CostGoalMap::nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                                        double clearance_m) const {
  return nearestPlace(map_, place_map_m, reach_m,
                      [&](common::CellIndex cell) { return mayBeAt(map_, cell, clearance_m); });
}

std::shared_ptr<const common::GoalMap> goalMapOf(std::shared_ptr<const CostMap> map) {
  if (!map) return nullptr;
  auto kept = std::make_shared<const KeptGoalMap>(std::move(map));
  return {kept, &kept->view};
}

}  // namespace swiftlet::planning
