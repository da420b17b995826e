#include "common/goal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/polygon.hpp"

namespace swiftlet::common {
namespace {

using Reason = GoalRefusal::Reason;

constexpr double kReach_m = 3.0;  ///< A free place farther away is another goal, not the next best.

GoalRefusal refusal(PlaceState state, const Goal& goal, const std::optional<Eigen::Vector2d>& nearest) {
  const std::string place = "goal " + goal.names.of(goal.place_map_m);
  const std::string instead =
      nearest ? ", the nearest free place is " + goal.names.coordinatesOf(*nearest) : std::string();
  if (state == PlaceState::kOutsideMap) return {Reason::kOutsideMap, place + " is outside the map", nearest};
  if (state == PlaceState::kKeptOut)
    return {Reason::kKeptOut, fmt::format("{} is in a keep-out zone{}", place, instead), nearest};
  const auto [reason, why] = state == PlaceState::kObstacle ? std::pair(Reason::kObstacle, "is in an obstacle")
                             : state == PlaceState::kUnseen
                                 ? std::pair(Reason::kUnseen, "is in space never seen")
                                 : std::pair(Reason::kTooClose, "is too close to an obstacle or to unknown space");
  return {reason, fmt::format("{} {} at clearance {:.2f} m{}", place, why, goal.clearance_m, instead), nearest};
}

}  // namespace

Goal goalOf(const GoToIntent& intent) {
  return {intent.goal_map_m, intent.height_m, intent.tolerance_m, intent.clearance_m, 0.0, {}};
}

Goal tappedGoalOf(const GoToIntent& intent, const PlaceNames& names) {
  constexpr double kFingertip_m = 0.25;
  Goal goal = goalOf(intent);
  goal.names = names;
  // A place in the given map moves with the localization and stays as it is.
  if (!intent.goal_given_m) goal.shift_m = kFingertip_m;
  return goal;
}

tl::expected<Eigen::Vector2d, GoalRefusal> judgeGoal(const Goal& goal, const GoalLimits& limits, const GoalMap* map) {
  const Eigen::Vector2d& place = goal.place_map_m;
  if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kGreatestCoordinate_m)
    return tl::unexpected(GoalRefusal{Reason::kNoPlace, "the goal is not a point of the map", std::nullopt});
  if (goal.height_m && !(*goal.height_m <= limits.greatest_height_m))
    return tl::unexpected(GoalRefusal{
        Reason::kHeight,
        fmt::format("{:.4g} m is above the greatest height, {:.4g} m", *goal.height_m, limits.greatest_height_m),
        std::nullopt});
  if (goal.height_m && !(*goal.height_m >= limits.least_height_m))
    return tl::unexpected(
        GoalRefusal{Reason::kHeight,
                    fmt::format("{:.4g} m is below the least height, {:.4g} m", *goal.height_m, limits.least_height_m),
                    std::nullopt});
  if (map == nullptr) return place;
  const PlaceState state = map->stateAt(place, goal.clearance_m);
  if (state == PlaceState::kFree) return place;
  const auto nearest = map->nearestFree(place, kReach_m, goal.clearance_m);
  const double reach_m = std::max(kShareOfTolerance * goal.tolerance_m, goal.shift_m);
  if (state != PlaceState::kKeptOut && nearest && (*nearest - place).norm() <= reach_m) return *nearest;
  return tl::unexpected(refusal(state, goal, nearest));
}

}  // namespace swiftlet::common
