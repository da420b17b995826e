#include "autonomy/planning_worker.hpp"

namespace swiftlet::autonomy {

PlanningAnswer PlanningWorker::answer(const PlanningRequest& request) {
  planning::CostLayers layers;
  layers.discs = request.discs;
  layers.levels = request.levels.get();
  map_.update(*request.grid, request.footprint, layers);

  PlanningAnswer answer;
  answer.intent_id = request.intent_id;
  answer.cost_map = std::make_shared<const planning::CostMap>(map_);
  if (const auto* goal = std::get_if<GoalRequest>(&request.question)) {
    answer.path = planner_.plan(map_, request.T_map_body.position_m(), goal->goal_map_m);
  } else if (const auto* explore_request = std::get_if<ExploreRequest>(&request.question)) {
    planning::ExplorationInput input;
    input.cost_map = answer.cost_map;
    input.pose_map = request.T_map_body;
    input.current = explore_request->current;
    input.attempts = explore_request->attempts;
    answer.exploration = planning::explore(input, exploration_);
  }
  return answer;
}

}  // namespace swiftlet::autonomy
