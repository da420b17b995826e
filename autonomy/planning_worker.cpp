#include "autonomy/planning_worker.hpp"

#include <algorithm>

#include "planning/wavefront.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr double kFlownSpacing_m = 0.1;

}  // namespace

PlanningAnswer PlanningWorker::answer(const PlanningRequest& request) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  if (flown_map_m_.empty() || (here - flown_map_m_.back()).norm() > kFlownSpacing_m) flown_map_m_.push_back(here);
  planning::CostLayers layers;
  layers.flown_map_m = flown_map_m_;
  layers.discs = request.discs;
  layers.levels = request.levels.get();
  map_.update(*request.grid, request.footprint, layers);

  PlanningAnswer answer;
  answer.intent_id = request.intent_id;
  answer.cost_map = std::make_shared<const planning::CostMap>(map_);
  if (const auto* goal = std::get_if<GoalRequest>(&request.question)) {
    answer.path = goTo(*goal, request.T_map_body.position_m());
  } else if (std::holds_alternative<MakeRoomRequest>(request.question)) {
    answer.path = makeRoom(request.T_map_body.position_m());
    answer.makes_room = true;
  } else if (const auto* explore_request = std::get_if<ExploreRequest>(&request.question)) {
    planning::ExplorationInput input;
    input.cost_map = answer.cost_map;
    input.pose_map = request.T_map_body;
    input.current = explore_request->current;
    input.attempts = explore_request->attempts;
    input.bounds = explore_request->bounds;
    answer.exploration = planning::explore(input, exploration_);
  }
  return answer;
}

tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::goTo(const GoalRequest& goal,
                                                                         const Eigen::Vector2d& position_map_m) {
  auto path = planner_.plan(map_, position_map_m, goal.goal_map_m);
  if (path || !path.error().nearest_free_map_m) return path;
  // Some of the tolerance is left to the controller.
  constexpr double kShareOfTolerance = 0.8;
  const Eigen::Vector2d& nearest = *path.error().nearest_free_map_m;
  if ((nearest - goal.goal_map_m).norm() > kShareOfTolerance * goal.tolerance_m) return path;
  return planner_.plan(map_, position_map_m, nearest);
}

/// The cheapest-to-reach field decides what is near; of what is within reach the widest and farthest place wins.
tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::makeRoom(const Eigen::Vector2d& position_map_m) {
  constexpr double kReach_m = 6.0, kPerMetreOfWidth = 3.0;
  const common::CellIndex here = map_.cellAt(position_map_m);
  if (map_.costAt(here) == planning::CostMap::kLethal)
    return tl::unexpected(planning::PlanFailure{planning::PlanFailure::Reason::kStartBlocked, "no room to move", {}});
  planning::CostField field;
  field.spread(map_, here);
  int best = map_.indexOf(here);
  double best_score = 0.0;
  for (int i = 0; i < static_cast<int>(map_.size()); ++i) {
    if (!field.reached(i)) continue;
    const double away_m = std::min(field.cost_m(i, map_.resolution_m()), kReach_m);
    const double score = away_m + kPerMetreOfWidth * map_.obstacleDistance_m(map_.cellOf(i));
    if (score > best_score) {
      best_score = score;
      best = i;
    }
  }
  return planner_.plan(map_, position_map_m, map_.centerOf(map_.cellOf(best)));
}

}  // namespace swiftlet::autonomy
