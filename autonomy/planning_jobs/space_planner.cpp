#include "autonomy/planning_jobs/space_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "planning/sampling/reachable_space.hpp"
#include "planning/sampling/sampling_planner.hpp"

namespace swiftlet::autonomy {
namespace {

using Eigen::Vector3d;
using planning::PlanFailure;

/// Iterations of RRT-Connect: a hundred times what a room with two windows takes; then the reachable cells are asked.
constexpr int kIterations = 4000;
/// A hull that stands too near to something leaves it for a free place this near.
constexpr double kLeaves_m = 0.5;
/// Heights of the goal are tried in these steps, up to this far from the height of flight.
constexpr double kGoalStep_m = 0.05, kGoalReach_m = 1.5;
/// A path that ends elsewhere than at the height of flight is worth leaving for one that does not.
constexpr double kOtherEnd_m = 2.0;
/// A metre at another height costs half as much again: there the laser does not draw the map.
constexpr double kOtherHeightShare = 0.5;
/// Heights that differ by less are the same.
constexpr double kSameHeight_m = 0.03;
/// A change of height is made at the least of these distances before the place that needs it: on the spot, or on a
/// slope where the camera saw no more.
constexpr std::array kBeforeNeed_m{0.0, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0};

PlanFailure failureOf(const planning::SpacePlanFailure& failure) {
  using From = planning::SpacePlanFailure::Reason;
  using To = PlanFailure::Reason;
  PlanFailure result;
  result.text = failure.text;
  switch (failure.reason) {
    case From::kOutsideMap:
      result.reason = To::kOutsideMap;
      break;
    case From::kStartBlocked:
      result.reason = To::kStartBlocked;
      break;
    case From::kGoalBlocked:
      result.reason = To::kGoalBlocked;
      break;
    case From::kUnreachable:
      result.reason = To::kUnreachable;
      break;
  }
  if (failure.nearest_map_m) result.nearest_free_map_m = failure.nearest_map_m->head<2>();
  return result;
}

}  // namespace

tl::expected<planning::Path, PlanFailure> SpacePlanner::plan(const PlanningRequest& request, const GoalRequest& goal,
                                                             const planning::CellStates& grid,
                                                             const planning::CostLayers& layers) {
  if (!enabled_ || !space_.update(request, goal.goal_map_m, goal.height, grid))
    return tl::make_unexpected(PlanFailure{PlanFailure::Reason::kUnreachable, "no 3D map of the way to the goal", {}});
  publish(request, goal.height, layers);
  const planning::HullSpace& hull = maps_->hull;
  const auto place = goalPlace(goal);
  if (!place)
    return tl::make_unexpected(PlanFailure{PlanFailure::Reason::kGoalUnseen,
                                           "goal " + request.names.of(goal.goal_map_m) + " is free at no height", {}});
  const Eigen::Vector2d here_map_m = request.T_map_body.position_m();
  const Vector3d start(here_map_m.x(), here_map_m.y(), goal.height.reference_m);
  std::optional<Vector3d> left;
  if (!hull.isFree(start)) {
    left = planning::nearestFreePlace(hull.clearance, hull.middleOf(start), hull.radius_m, kLeaves_m);
    if (left) *left -= hull.middle_m * Vector3d::UnitZ();
  }
  planning::SpacePlanFailure failure;
  ++plans_;
  for (const double radius_m : {request.footprint.radius_m(), hull.radius_m}) {
    const auto path = planning::planBySampling(hull.clearance, hull.middleOf(left.value_or(start)),
                                               hull.middleOf(*place), radius_m, plans_, {kIterations, true});
    if (!path) {
      failure = path.error();
      continue;
    }
    std::vector<Vector3d> places = path->points_map_m;
    for (Vector3d& point : places) point.z() -= hull.middle_m;
    places.front() = left.value_or(start);  // Exactly, without the rounding of the middle.
    places.back() = *place;
    if (left) places.insert(places.begin(), start);
    planning::Path flown = pathThrough(std::move(places), goal.height);
    flown.escape_points = left ? 1 : 0;
    return flown;
  }
  return tl::make_unexpected(failureOf(failure));
}

void SpacePlanner::publish(const PlanningRequest& request, const FlightHeights& heights,
                           const planning::CostLayers& layers) {
  auto maps = std::make_shared<SpaceMaps>(SpaceMaps{space_.hull(request.footprint), std::nullopt, 0.0});
  if (heights.isOff()) {
    maps->here.emplace(costs_, resolution_m_);
    maps->here->update(space_.gridAt(heights.reference_m, request.T_map_body.position_m(), resolution_m_),
                       request.footprint, layers);
    maps->here->name(request.names);
    maps->here_height_m = heights.reference_m;
  }
  maps_ = std::move(maps);
}

/// The goal at the height of flight, or else as near to that as the hull may be; beside it as far as the goal allows.
std::optional<Vector3d> SpacePlanner::goalPlace(const GoalRequest& goal) const {
  const planning::HullSpace& hull = maps_->hull;
  const Vector3d wanted(goal.goal_map_m.x(), goal.goal_map_m.y(), goal.height.cruise_m);
  for (double off_m = 0.0; off_m <= kGoalReach_m; off_m += kGoalStep_m)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d place = wanted + sign * off_m * Vector3d::UnitZ();
      if (place.z() <= goal.height.highest_m && hull.isFree(place)) return place;
    }
  const double beside_m = std::max(goal.shift_m, 0.8 * goal.tolerance_m);
  auto beside = planning::nearestFreePlace(hull.clearance, hull.middleOf(wanted), hull.radius_m, beside_m);
  if (beside) *beside -= hull.middle_m * Vector3d::UnitZ();
  return beside;
}

/// After the first line, which may leave a place that is not free.
bool SpacePlanner::isFree(const std::vector<Vector3d>& places) const {
  for (std::size_t i = 2; i < places.size(); ++i)
    if (!maps_->hull.isFree(places[i - 1], places[i])) return false;
  return true;
}

planning::Path SpacePlanner::pathThrough(std::vector<Vector3d> places, const FlightHeights& heights) const {
  const auto isOther = [&](const Vector3d& place) { return std::abs(place.z() - heights.cruise_m) > kSameHeight_m; };
  for (std::size_t i = 1; i < places.size(); ++i)
    if (!isOther(places[i])) places[i].z() = heights.cruise_m;
  std::vector<Vector3d> flown = withLateChanges(centred(places, heights.cruise_m), heights.cruise_m);
  places = isFree(flown) ? std::move(flown) : withLateChanges(places, heights.cruise_m);
  planning::Path path;
  for (const Vector3d& place : places) {
    path.points_map_m.emplace_back(place.head<2>());
    path.heights_m.push_back(place.z());
  }
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double length_m = (places[i] - places[i - 1]).norm();
    path.length_m += length_m;
    path.cost_m += length_m * (isOther(places[i - 1]) || isOther(places[i]) ? 1.0 + kOtherHeightShare : 1.0);
  }
  if (isOther(places.back())) path.cost_m += kOtherEnd_m;
  return path;
}

/// Shortcuts graze what they pass: each stretch at another height goes to the middle between what is above and below it.
std::vector<Vector3d> SpacePlanner::centred(std::vector<Vector3d> places, double cruise_m) const {
  constexpr double kStep_m = 0.025, kReach_m = 0.3;
  const planning::HullSpace& hull = maps_->hull;
  const auto isInner = [&](std::size_t i) {
    return i > 0 && i + 1 < places.size() && std::abs(places[i].z() - cruise_m) > kSameHeight_m;
  };
  for (std::size_t begin = 1, end = 1; begin + 1 < places.size(); begin = std::max(begin + 1, end)) {
    for (end = begin; isInner(end);) ++end;
    if (end == begin) continue;
    const auto roomTowards = [&](double sign) {
      double room_m = 0.0;
      const auto isFree = [&](double off_m) {
        const Vector3d off = sign * off_m * Vector3d::UnitZ();
        if (!hull.isFree(places[begin] + off)) return false;
        for (std::size_t i = begin + 1; i < end; ++i)
          if (!hull.isFree(places[i - 1] + off, places[i] + off)) return false;
        return true;
      };
      while (room_m < kReach_m && isFree(room_m + kStep_m)) room_m += kStep_m;
      return room_m;
    };
    const double up_m = 0.5 * (roomTowards(1.0) - roomTowards(-1.0));
    for (std::size_t i = begin; i < end; ++i) places[i].z() += up_m;
  }
  return places;
}

/// Between a place at the height of flight and one at another height, the path stays at the height of flight as long as
/// it may, and changes its height on the spot, so that it is level where there is little room; on a slope where the
/// camera has not seen enough for that.
std::vector<Vector3d> SpacePlanner::withLateChanges(const std::vector<Vector3d>& places, double cruise_m) const {
  const planning::HullSpace& hull = maps_->hull;
  const auto isOther = [&](const Vector3d& place) { return std::abs(place.z() - cruise_m) > kSameHeight_m; };
  /// The places between `cruise` and `other` where the height changes; none to change it along all of the line.
  const auto change = [&](const Vector3d& cruise, const Vector3d& other) -> std::vector<Vector3d> {
    const double planar_m = (other - cruise).head<2>().norm();
    for (const bool on_the_spot : {true, false})
      for (const double before_m : kBeforeNeed_m) {
        if (before_m >= planar_m) break;
        Vector3d at = other + before_m / planar_m * (cruise - other);
        const Vector3d level(at.x(), at.y(), other.z());
        at.z() = cruise_m;
        if (!hull.isFree(cruise, at)) continue;
        if (on_the_spot && before_m == 0.0 && hull.isFree(at, other)) return {at};
        if (on_the_spot && hull.isFree(at, level) && hull.isFree(level, other)) return {at, level};
        if (!on_the_spot && hull.isFree(at, other)) return {at};
      }
    return {};
  };
  std::vector<Vector3d> result{places.front()};
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vector3d &from = places[i - 1], &to = places[i];
    if (isOther(from) != isOther(to)) {
      std::vector<Vector3d> between = isOther(to) ? change(from, to) : change(to, from);
      if (isOther(from)) std::reverse(between.begin(), between.end());
      result.insert(result.end(), between.begin(), between.end());
    }
    result.push_back(to);
  }
  return result;
}

}  // namespace swiftlet::autonomy
