#include "autonomy/planning_jobs/planning_worker.hpp"

#include <algorithm>
#include <utility>

#include "planning/exploration/held_path.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::autonomy {
namespace {

/// Two cells of the shipped map. The trail passes through every cell between two points (CostMap::applyFlown).
constexpr double kFlownSpacing_m = 0.1;
/// Greatest detour that is flown instead of flying lower, in metres of path (docs/decisions/planning.md#082).
constexpr double kLowerDetour_m = 10.0;

}  // namespace

PlanningAnswer PlanningWorker::answer(const PlanningRequest& request) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  if (flown_map_m_.empty() || (here - flown_map_m_.back()).norm() > kFlownSpacing_m) flown_map_m_.push_back(here);
  planning::CostLayers layers;
  layers.flown_map_m = flown_map_m_;
  layers.discs = request.discs;
  layers.levels = request.levels.get();
  if (request.keep_out) layers.keep_out = *request.keep_out;
  map_.update(*request.grid, request.footprint, layers);
  map_.name(request.names);

  PlanningAnswer answer;
  answer.intent_id = request.intent_id;
  answer.cost_map = std::make_shared<const planning::CostMap>(map_);
  if (const auto* goal = std::get_if<GoalRequest>(&request.question)) {
    if (!goal->height.isLower() || !request.map3d) answer.path = goTo(*goal, request.T_map_body.position_m());
    goLower(request, *goal, layers, answer);
  } else if (const auto* blocked = std::get_if<DetourRequest>(&request.question)) {
    answer.detour = detour(*blocked, request.discs, request.T_map_body.position_m());
  } else if (const auto* explore_request = std::get_if<ExploreRequest>(&request.question)) {
    explore(request, *explore_request, answer);
  }
  answer.home_m = pathHome_m(here);
  answer.use = {planner_->name(), paths_, toString(explorer_.kind), viewpoints_};
  return answer;
}

/// The path to the origin of the map, where the vehicle took off, or to the free place nearest to it, as going home
/// plans it. It is planned at every kEach-th answer: with the period of PlanningDesk that is at least every 2 s, in
/// which the vehicle flies less than 1.5 m. A person in a door blocks it for a while: for kBelieved plans
/// the length stays the last one, plus what has been flown since.
std::optional<double> PlanningWorker::pathHome_m(const Eigen::Vector2d& position_map_m) {
  constexpr int kEach = 8, kBelieved = 10;
  if (answers_++ % kEach != 0) return home_m_;
  const auto place = goalPlace({Eigen::Vector2d::Zero(), 0.0, common::kHomeShift_m});
  std::optional<double> length_m;
  if (place)
    if (const auto path = home_planner_.plan(map_, position_map_m, *place)) length_m = path->length_m;
  home_failures_ = length_m ? 0 : home_failures_ + 1;
  if (length_m)
    home_m_ = length_m;
  else if (home_m_ && home_failures_ <= kBelieved)
    *home_m_ += (position_map_m - home_planned_at_m_).norm();
  else
    home_m_.reset();
  home_planned_at_m_ = position_map_m;
  return home_m_;
}

void PlanningWorker::explore(const PlanningRequest& request, const ExploreRequest& question, PlanningAnswer& answer) {
  planning::ExplorationInput input;
  input.cost_map = answer.cost_map;
  input.pose_map = request.T_map_body;
  input.current = question.current;
  input.attempts = question.attempts;
  input.bounds = question.bounds;
  input.lost_map_m = question.lost_map_m;
  input.leave_building = question.leave_building;
  // A viewpoint whose path leads through the open is left for another one.
  constexpr int kTries = 3;
  planning::ExplorationResult result;
  for (int i = 0; i < kTries; ++i) {
    result = planning::explore(input, explorer_);
    answer.path.reset();
    if (!result.next) break;
    answer.path = plan(input.pose_map.position_m(), result.next->pose_map.position_m());
    if (!*answer.path || input.leave_building || planning::staysHeld(map_, answer.path->value().points_map_m)) break;
    input.lost_map_m.push_back(result.next->target_map_m);
    input.current.reset();
  }
  if (result.next && !result.kept_current) ++viewpoints_;
  if (result.next && !*answer.path) {
    result.reason = "no path to the viewpoint: " + answer.path->error().text;
    result.next.reset();
  }
  answer.exploration = std::move(result);
}

tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::plan(const Eigen::Vector2d& from_map_m,
                                                                         const Eigen::Vector2d& to_map_m) {
  auto path = planner_->plan(map_, from_map_m, to_map_m);
  if (path) ++paths_;
  return path;
}

tl::expected<Eigen::Vector2d, planning::PlanFailure> PlanningWorker::goalPlace(const GoalRequest& goal) const {
  const planning::CostGoalMap goals(map_);
  const auto place = common::judgeGoal(
      {goal.goal_map_m, std::nullopt, goal.tolerance_m, map_.footprint().clearance_m, goal.shift_m, map_.names()}, {},
      &goals);
  if (!place) return tl::make_unexpected(planning::failureOf(place.error()));
  return *place;
}

tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::goTo(const GoalRequest& goal,
                                                                         const Eigen::Vector2d& position_map_m) {
  const auto place = goalPlace(goal);
  if (!place) return tl::make_unexpected(place.error());
  return plan(position_map_m, *place);
}

/// A path that is flown lower, where there is none at the height of flight, or only a great detour. A vehicle that is
/// lower already plans at both heights.
void PlanningWorker::goLower(const PlanningRequest& request, const GoalRequest& goal,
                             const planning::CostLayers& layers, PlanningAnswer& answer) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  const auto& direct = answer.path;
  const double straight_m = (goal.goal_map_m - here).norm();
  if (direct && *direct && (*direct)->cost_m < straight_m + kLowerDetour_m) return;
  if (direct && !*direct && direct->error().reason == planning::PlanFailure::Reason::kGoalKeptOut) return;
  if (!request.map3d) return;
  auto lower = lower_.plan(request, goal, layers);
  // Space that the laser has not seen is flown through only below something, and on the way up behind it.
  if (lower && !lower->anyLowered() && !goal.height.lowered_m) return;
  answer.heights = lower_.maps();
  if (lower && direct && *direct && lower->cost_m + kLowerDetour_m > (*direct)->cost_m) return;
  if (!lower && direct) return;
  if (lower) ++paths_;
  answer.path = std::move(lower);
}

std::optional<DetourPlan> PlanningWorker::detour(const DetourRequest& request, const std::vector<common::Disc>& people,
                                                 const Eigen::Vector2d& position_map_m) {
  // Nearer, the laser has seen the blockage as well as it can: flying there shows no more
  // (docs/decisions/planning.md#005).
  constexpr double kWorth_m = 1.5;
  const auto blocked = planning::blockedPath(map_, map_.cellAt(position_map_m), map_.cellAt(request.goal_map_m));
  // A keep-out zone stays, however near the vehicle looks at it.
  if (blocked && map_.isKeptOut(map_.indexOf(blocked->first_lethal))) return std::nullopt;
  const bool person_blocks = blocked && std::any_of(people.begin(), people.end(), [&](const common::Disc& disc) {
                               const double off_m = (map_.centerOf(blocked->first_lethal) - disc.center_map_m).norm();
                               return off_m <= disc.radius_m + map_.footprint().radius_m() + map_.resolution_m();
                             });
  DetourPlan result;
  std::optional<Eigen::Vector2d> place;
  if (blocked && !person_blocks) place = map_.centerOf(blocked->outlook);
  if (!place || (*place - position_map_m).norm() < kWorth_m) {
    place = roomyPlace(position_map_m);
    result.makes_room = true;
  }
  if (!place) return std::nullopt;
  auto path = plan(position_map_m, *place);
  if (!path) return std::nullopt;
  result.path = *std::move(path);
  return result;
}

/// The reachable place with the highest score among those where the laser knows the position: its path cost from here,
/// at most kReach_m, plus kPerMetreOfWidth times its distance to the nearest obstacle (docs/decisions/planning.md#005).
/// Beyond the length of a room a place is no better for being farther, and half a metre of width is worth 1.5 m of
/// path.
std::optional<Eigen::Vector2d> PlanningWorker::roomyPlace(const Eigen::Vector2d& position_map_m) const {
  constexpr double kReach_m = 6.0, kPerMetreOfWidth = 3.0;
  constexpr int kEvery = 10;  // Where the best place is not held, cells this far apart are compared.
  const auto escape = planning::escapeFrom(map_, map_.cellAt(position_map_m));
  if (!escape) return std::nullopt;
  planning::CostField field;
  field.spread(map_, escape->back());
  std::pair<double, int> best{0.0, map_.indexOf(escape->back())};
  std::vector<std::pair<double, int>> others;  // Score and cell.
  for (int i = 0; i < static_cast<int>(map_.costs().size()); ++i) {
    if (!field.reached(i)) continue;
    const common::CellIndex cell = map_.cellOf(i);
    // The cost of a path into a corner is high, and would count as far away.
    if (!hasRoomToStop(map_, cell)) continue;
    const double away_m = std::min(field.cost_m(i, map_.resolution_m()), kReach_m);
    const double score = away_m + kPerMetreOfWidth * map_.obstacleDistance_m(cell);
    if (score > best.first) best = {score, i};
    if (cell.x % kEvery == 0 && cell.y % kEvery == 0) others.emplace_back(score, i);
  }
  const auto placeOf = [&](int index) { return map_.centerOf(map_.cellOf(index)); };
  if (planning::isHeld(map_, placeOf(best.second))) return placeOf(best.second);
  std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [score, index] : others)
    if (planning::isHeld(map_, placeOf(index))) return placeOf(index);
  return std::nullopt;
}

}  // namespace swiftlet::autonomy
