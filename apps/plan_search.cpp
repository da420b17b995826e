#include "apps/plan_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "flight/wall_clock.hpp"
#include "mapping3d/voxels/floor_plan.hpp"
#include "planning/clearance/clearance.hpp"
#include "planning/sampling/sampling_planner.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/goal_map.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::apps {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using planning::Clearance;
using planning::CostMap;

Vector3d raised(const Vector2d& place_m, double height_m) { return {place_m.x(), place_m.y(), height_m}; }

void setClearance(PlanAnswer& answer, const Clearance& clearance) {
  answer.clearance_m = clearance.reach_m();
  const auto& points = answer.points_map_m;
  for (std::size_t i = 0; i < points.size(); ++i)
    answer.clearance_m = std::min(answer.clearance_m, clearance.along_m(points[i == 0 ? 0 : i - 1], points[i]));
  answer.clearance_is_more = answer.clearance_m >= clearance.reach_m();
}

/// Of the places that the planners reach from the start, that nearest to the goal.
std::optional<Vector2d> nearestReachable(const CostMap& map, const Vector2d& start_m, const Vector2d& goal_m) {
  const auto escape = planning::escapeFrom(map, map.cellAt(start_m));
  if (!escape || map.costAt(escape->back()) == CostMap::kLethal) return std::nullopt;
  planning::CostField field;
  field.spread(map, escape->back());
  std::optional<Vector2d> nearest;
  for (int i = 0; i < static_cast<int>(map.costs().size()); ++i) {
    if (!field.reached(i)) continue;
    const Vector2d center_m = map.centerOf(map.cellOf(i));
    if (!nearest || (center_m - goal_m).squaredNorm() < (*nearest - goal_m).squaredNorm()) nearest = center_m;
  }
  return nearest;
}

void refuse(PlanAnswer& answer, const planning::PlanFailure& failure, const CostMap& map,
            const PlanQuestion& question) {
  answer.refusal = failure.text;
  std::optional<Vector2d> nearest =
      nearestReachable(map, question.start_map_m.head<2>(), question.goal_map_m.head<2>());
  if (!nearest) nearest = failure.nearest_free_map_m;
  if (nearest) answer.nearest_map_m = raised(*nearest, question.start_map_m.z());
}

/// A flight escapes from such a start; a question about a map is told that it is none.
bool isStartFree(PlanAnswer& answer, const CostMap& map, const PlanQuestion& question) {
  const Vector2d start_m = question.start_map_m.head<2>();
  const char* why = "";
  switch (planning::CostGoalMap(map).stateAt(start_m, question.clearance_m)) {
    case common::PlaceState::kFree:
    case common::PlaceState::kKeptOut:
      return true;
    case common::PlaceState::kOutsideMap:
      why = "is outside the map";
      break;
    case common::PlaceState::kUnseen:
      why = "is not known to be free";
      break;
    case common::PlaceState::kObstacle:
      why = "is in an obstacle";
      break;
    case common::PlaceState::kTooClose:
      why = "has no room for the hull and its clearance";
      break;
  }
  answer.refusal = fmt::format("start {} {}", map.names().of(start_m), why);
  if (const auto nearest = planning::nearestFree(map, start_m))
    answer.nearest_map_m = raised(*nearest, question.start_map_m.z());
  return false;
}

void searchPlane(PlanAnswer& answer, const PlanQuestion& question) {
  const auto begin = flight::Clock::now();
  CostMap map({}, answer.plane.resolution_m());
  map.update(answer.plane, {question.hull_radius_m, question.clearance_m});
  answer.map_s = flight::secondsSince(begin);
  if (!isStartFree(answer, map, question)) return;
  const auto searched = flight::Clock::now();
  planning::DStarLite dstar;
  planning::Wavefront wavefront;
  const bool by_dstar = question.planner == PlannerName::kDStar;
  planning::Planner& planner = by_dstar ? static_cast<planning::Planner&>(dstar) : wavefront;
  const auto path = planner.plan(map, question.start_map_m.head<2>(), question.goal_map_m.head<2>());
  answer.search_s = flight::secondsSince(searched);
  answer.nodes = by_dstar ? static_cast<std::size_t>(dstar.expansions()) : wavefront.settled();
  if (!path) return refuse(answer, path.error(), map, question);
  answer.length_m = path->length_m;
  for (const Vector2d& point_m : path->points_map_m)
    answer.points_map_m.push_back(raised(point_m, question.start_map_m.z()));
}

void searchSpace(PlanAnswer& answer, const PlanQuestion& question, const Clearance& clearance) {
  const auto begin = flight::Clock::now();
  auto path = planning::planBySampling(clearance, question.start_map_m, question.goal_map_m,
                                       question.hull_radius_m + question.clearance_m,
                                       static_cast<std::uint64_t>(question.seed));
  answer.search_s = flight::secondsSince(begin);
  if (!path) {
    answer.refusal = path.error().text;
    answer.nearest_map_m = path.error().nearest_map_m;
    return;
  }
  answer.points_map_m = std::move(path->points_map_m);
  answer.length_m = path->length_m;
  answer.nodes = path->states;
}

/// The heights that the hull meets along the path, or between its ends if there is none.
common::OccupancyGrid drawnPlane(const common::VoxelMap& space, const PlanQuestion& question,
                                 const std::vector<Vector3d>& points_map_m) {
  double low_m = std::min(question.start_map_m.z(), question.goal_map_m.z());
  double high_m = std::max(question.start_map_m.z(), question.goal_map_m.z());
  for (const Vector3d& point_m : points_map_m) {
    low_m = std::min(low_m, point_m.z());
    high_m = std::max(high_m, point_m.z());
  }
  return mapping3d::floorPlan(space, low_m - 0.5 * question.hull_height_m, high_m + 0.5 * question.hull_height_m);
}

}  // namespace

PlanAnswer answer(const PlanMap& map, const PlanQuestion& question) {
  PlanAnswer found;
  const bool sampling = question.planner == PlannerName::kSampling;
  const auto begin = flight::Clock::now();
  Clearance clearance = map.plane ? Clearance::ofPlane(map.plane->resolution_m())
                                  : Clearance::ofSpace(map.space->resolution_m(), question.hull_height_m);
  if (map.plane) {
    found.plane = *map.plane;
    clearance.update(found.plane);
  } else {
    clearance.update(*map.space);
    found.plane = drawnPlane(*map.space, question, {});
  }
  const double clearance_s = flight::secondsSince(begin);
  if (sampling)
    searchSpace(found, question, clearance);
  else
    searchPlane(found, question);
  found.map_s += clearance_s;
  if (found.refusal.empty()) setClearance(found, clearance);
  if (map.space && sampling) found.plane = drawnPlane(*map.space, question, found.points_map_m);
  return found;
}

}  // namespace swiftlet::apps
