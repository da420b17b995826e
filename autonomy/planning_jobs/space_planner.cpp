#include "autonomy/planning_jobs/space_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "common/geometry.hpp"
#include "planning/sampling/reachable_space.hpp"
#include "planning/sampling/sampling_planner.hpp"

namespace swiftlet::autonomy {
namespace {

using Eigen::Vector3d;
using planning::PlanFailure;

/// Iterations of RRT-Connect: a hundred times what a room with two windows takes; then the reachable cells are asked.
constexpr int kTreeIterations = 4000;
/// A hull that stands too near to something leaves it for a free place this near.
constexpr double kLeaves_m = 0.5;
/// Heights of the goal are tried in these steps, up to this far from the height of flight.
constexpr double kGoalStep_m = 0.05, kGoalReach_m = 1.5;
/// A path that ends elsewhere than at the height of flight is worth leaving for one that does not.
constexpr double kOtherEnd_m = 2.0;
/// A metre at another height costs half as much again: there the laser does not draw the map.
constexpr double kOtherHeightShare = 0.5;
/// Heights that differ by less are the same.
constexpr double kSameAsCruise_m = 0.03;
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

/// Half of the length for which a gap is passed along its axis: the hull is straight before it is in the gap.
constexpr double kAxisHalf_m = 0.6;

bool areFree(const planning::HullSpace& hull, const std::vector<Vector3d>& places) {
  for (std::size_t i = 1; i < places.size(); ++i)
    if (!hull.isFree(places[i - 1], places[i])) return false;
  return true;
}

/// A stretch of a path with less than the full clearance, by the lengths along the path.
struct Gap {
  double begin_m = 0.0, end_m = 0.0;
  Vector3d middle = Vector3d::Zero(), direction = Vector3d::Zero();
};

/// Those between the ends of the path.
std::vector<Gap> gapsOf(const planning::HullSpace& hull, const std::vector<Vector3d>& places, double full_m) {
  constexpr double kShifted_m = 0.025;
  std::vector<Gap> gaps;
  bool inside = true;  // Where the path begins in a gap, that one is left as it is.
  bool open = false;
  double passed_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vector3d line = places[i] - places[i - 1];
    const double length_m = line.norm();
    for (double at_m = 0.0; at_m < length_m; at_m += kShifted_m) {
      const Vector3d place = places[i - 1] + at_m / length_m * line;
      const bool narrow = hull.clearance.at_m(hull.middleOf(place)) < full_m;
      if (narrow && !inside && !open) {
        open = true;
        gaps.push_back({passed_m + at_m, passed_m + at_m, place, line / length_m});
      } else if (narrow && open) {
        gaps.back().end_m = passed_m + at_m;
      } else if (!narrow) {
        inside = open = false;
      }
    }
    passed_m += length_m;
  }
  if (open) gaps.pop_back();  // The path ends in it.
  return gaps;
}

Vector3d placeAlong(const std::vector<Vector3d>& places, double along_m) {
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double length_m = (places[i] - places[i - 1]).norm();
    if (along_m <= length_m && length_m > 0.0) return places[i - 1] + along_m / length_m * (places[i] - places[i - 1]);
    along_m -= length_m;
  }
  return places.back();
}

/// The line through a gap along which the hull has most room: its first and last place.
std::pair<Vector3d, Vector3d> axisOf(const planning::HullSpace& hull, const Gap& gap) {
  constexpr double kTurn_rad = 5.0 * common::kRadPerDeg, kAside_m = 0.025;
  constexpr int kTurns = 12, kAsides = 6, kSamples = 12;
  const double heading_rad = std::atan2(gap.direction.y(), gap.direction.x());
  std::pair<Vector3d, Vector3d> best;
  double most = -1.0;
  for (int turn = -kTurns; turn <= kTurns; ++turn)
    for (int aside = -kAsides; aside <= kAsides; ++aside) {
      const double yaw_rad = heading_rad + turn * kTurn_rad;
      const Vector3d along(std::cos(yaw_rad), std::sin(yaw_rad), 0.0), across(-along.y(), along.x(), 0.0);
      const Vector3d middle = gap.middle + aside * kAside_m * across;
      const Vector3d from = middle - kAxisHalf_m * along, to = middle + kAxisHalf_m * along;
      // The least room decides, and of equal ones the mean; voxels make both coarse.
      double least_m = hull.clearance.reach_m(), sum_m = 0.0;
      for (int i = 0; i <= kSamples; ++i) {
        const double room_m = hull.clearance.at_m(hull.middleOf(from + (to - from) * i / kSamples));
        least_m = std::min(least_m, room_m);
        sum_m += room_m;
      }
      const double score = least_m + 0.1 * sum_m / (kSamples + 1) - 1e-4 * (std::abs(turn) + std::abs(aside));
      if (score <= most) continue;
      most = score;
      best = {from, to};
    }
  return best;
}

/// Moves a level line to the middle between what is above and below it.
void centreLine(const planning::HullSpace& hull, Vector3d& from, Vector3d& to) {
  constexpr double kShifted_m = 0.025, kShiftReach_m = 0.4;
  const auto roomTowards = [&](double sign) {
    double room_m = 0.0;
    while (room_m < kShiftReach_m) {
      const Vector3d off = sign * (room_m + kShifted_m) * Vector3d::UnitZ();
      if (!hull.isFree(from + off, to + off)) break;
      room_m += kShifted_m;
    }
    return room_m;
  };
  const double up_m = 0.5 * (roomTowards(1.0) - roomTowards(-1.0));
  from.z() += up_m;
  to.z() += up_m;
}

/// Where a path has less than the full clearance it grazes one side: gaps are passed in their middle and along their
/// axis, where that is free.
std::vector<Vector3d> alongAxes(const planning::HullSpace& hull, const std::vector<Vector3d>& places, double full_m) {
  std::vector<Vector3d> result = places;
  std::vector<Gap> gaps = gapsOf(hull, places, full_m);
  std::reverse(gaps.begin(), gaps.end());  // From the last one on the lengths before it stay.
  for (Gap& gap : gaps) {
    gap.middle = placeAlong(result, 0.5 * (gap.begin_m + gap.end_m));
    auto [from, to] = axisOf(hull, gap);
    if (!hull.isFree(from, to)) continue;
    centreLine(hull, from, to);
    std::vector<Vector3d> changed;
    double passed_m = 0.0;
    bool inserted = false;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (i > 0) passed_m += (result[i] - result[i - 1]).norm();
      const bool before = passed_m<gap.begin_m - kAxisHalf_m, after = passed_m> gap.end_m + kAxisHalf_m;
      if (!before && !inserted && (after || i + 1 == result.size())) {
        changed.insert(changed.end(), {from, to});
        inserted = true;
      }
      if (before || after || i == 0 || i + 1 == result.size()) changed.push_back(result[i]);
    }
    if (areFree(hull, changed)) result = std::move(changed);
  }
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
    return tl::make_unexpected(PlanFailure{
        PlanFailure::Reason::kGoalUnseen, "goal " + request.names.of(goal.goal_map_m) + " is free at no height", {}});
  const Eigen::Vector2d here_map_m = request.T_map_body.position_m();
  const Vector3d start(here_map_m.x(), here_map_m.y(), goal.height.reference_m);
  std::optional<Vector3d> left;
  if (!hull.isFree(start)) {
    left = planning::nearestFreePlace(hull.clearance, hull.middleOf(start), hull.radius_m, kLeaves_m);
    if (left) *left -= hull.middle_m * Vector3d::UnitZ();
  }
  planning::SpacePlanFailure failure;
  ++plans_;
  const auto planTo = [&](const Vector3d& end, double radius_m) -> std::optional<planning::Path> {
    const auto path = planning::planBySampling(hull.clearance, hull.middleOf(left.value_or(start)), hull.middleOf(end),
                                               radius_m, plans_, {kTreeIterations, true});
    if (!path) {
      failure = path.error();
      return std::nullopt;
    }
    std::vector<Vector3d> places = path->points_map_m;
    for (Vector3d& point : places) point.z() -= hull.middle_m;
    places.front() = left.value_or(start);  // Exactly, without the rounding of the middle.
    places.back() = end;
    places = alongAxes(hull, places, request.footprint.radius_m());
    if (left) places.insert(places.begin(), start);
    planning::Path flown = pathThrough(std::move(places), goal.height);
    flown.escape_points = left ? 1 : 0;
    return flown;
  };
  for (const double radius_m : {request.footprint.radius_m(), hull.radius_m})
    if (auto path = planTo(*place, radius_m)) return *std::move(path);
  // Another height of the goal may be reached: behind a window what is nearest to the height of flight may be seen, and
  // the way down to it not.
  const planning::ReachableSpace reachable(hull.clearance, hull.middleOf(left.value_or(start)), hull.radius_m);
  for (double off_m = 0.0; off_m <= kGoalReach_m; off_m += kGoalStep_m)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d end(place->x(), place->y(), goal.height.cruise_m + sign * off_m);
      if (end.z() > goal.height.highest_m || !hull.isFree(end) || !reachable.reaches(hull.middleOf(end))) continue;
      if (auto path = planTo(end, hull.radius_m)) return *std::move(path);
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
  const auto isOther = [&](const Vector3d& place) { return std::abs(place.z() - heights.cruise_m) > kSameAsCruise_m; };
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

/// Shortcuts graze what they pass: each stretch at another height goes to the middle between what is above and below
/// it.
std::vector<Vector3d> SpacePlanner::centred(std::vector<Vector3d> places, double cruise_m) const {
  constexpr double kShifted_m = 0.025, kShiftReach_m = 0.3;
  const planning::HullSpace& hull = maps_->hull;
  const auto isInner = [&](std::size_t i) {
    return i > 0 && i + 1 < places.size() && std::abs(places[i].z() - cruise_m) > kSameAsCruise_m;
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
      while (room_m < kShiftReach_m && isFree(room_m + kShifted_m)) room_m += kShifted_m;
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
  const auto isOther = [&](const Vector3d& place) { return std::abs(place.z() - cruise_m) > kSameAsCruise_m; };
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
