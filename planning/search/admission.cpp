#include "planning/search/admission.hpp"

#include <utility>

#include <fmt/format.h>

#include "planning/search/goal_map.hpp"

namespace swiftlet::planning {
namespace {

using Point = Eigen::Vector2d;

}  // namespace

tl::expected<CellPath, PlanFailure> admit(const CostMap& map, const Point& start_map_m, const Point& goal_map_m) {
  using Reason = PlanFailure::Reason;
  const auto refuse = [](Reason reason, std::string text) {
    return tl::make_unexpected(PlanFailure{reason, std::move(text), std::nullopt});
  };
  if (!start_map_m.allFinite()) return refuse(Reason::kOutsideMap, "the start is not a point of the map");
  const CostGoalMap goals(map);
  const auto goal =
      common::judgeGoal({goal_map_m, std::nullopt, 0.0, map.footprint().clearance_m, 0.0, map.names()}, {}, &goals);
  if (!goal) return tl::make_unexpected(failureOf(goal.error()));
  const common::CellIndex start = map.cellAt(start_map_m);
  if (!map.rect().contains(start))
    return refuse(Reason::kOutsideMap, fmt::format("start {} is outside the map", map.names().of(start_map_m)));
  std::optional<CellPath> escape = escapeFrom(map, start);
  if (!escape)
    return refuse(Reason::kStartBlocked, fmt::format("start {} is shut in at clearance {:.2f} m",
                                                     map.names().of(start_map_m), map.footprint().clearance_m));
  return *std::move(escape);
}

PlanFailure failureOf(const common::GoalRefusal& refusal) {
  using Refused = common::GoalRefusal::Reason;
  const bool nowhere = refusal.reason == Refused::kNoPlace || refusal.reason == Refused::kOutsideMap;
  const auto reason = nowhere                               ? PlanFailure::Reason::kOutsideMap
                      : refusal.reason == Refused::kUnseen  ? PlanFailure::Reason::kGoalUnseen
                      : refusal.reason == Refused::kKeptOut ? PlanFailure::Reason::kGoalKeptOut
                                                            : PlanFailure::Reason::kGoalBlocked;
  return {reason, refusal.text, refusal.nearest_free_map_m};
}

PlanFailure unreachable(const CostMap& map, const Point& goal_map_m) {
  return {PlanFailure::Reason::kUnreachable,
          fmt::format("goal {} is unreachable at clearance {:.2f} m", map.names().of(goal_map_m),
                      map.footprint().clearance_m),
          std::nullopt};
}

}  // namespace swiftlet::planning
