#include "autonomy/planning_jobs/planning_worker.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "autonomy/planning_jobs/seen_volume.hpp"
#include "common/segment.hpp"
#include "planning/exploration/held_path.hpp"
#include "planning/search/admission.hpp"
#include "planning/search/goal_map.hpp"

namespace swiftlet::autonomy {
namespace {

/// Two cells of the shipped map. The trail passes through every cell between two points (CostMap::applyFlown).
constexpr double kFlownSpacing_m = 0.1;
/// Greatest detour in the plane that is flown instead of changing the height, in metres of path
/// (docs/decisions/planning.md#133); and where paths in space are preferred, what one must save.
constexpr double kPlaneDetour_m = 10.0, kSpaceSaves_m = 1.0;
/// Area that must be expected behind something that never moved, and has only the size of a person, to wait for it.
constexpr double kWorthWaiting_m2 = 1.0;
/// And length of the frontiers behind it, if the next viewpoint is one that looks past it: more than in its shadow.
constexpr double kWorthWaiting_m = 1.5;
/// As much farther off people keep the planner (DynamicObstacles::kKeepOut_m), with a cell.
constexpr double kKeptOff_m = 0.30;
/// A place this near to a frontier from which it is approached: the hull keeps off what is unknown.
constexpr double kBeforeFrontier_m = 1.0;
/// Paths that meet the same person from two sides are blocked this near to each other: the width of the disc around
/// him.
constexpr double kSamePerson_m = 1.0;

/// The first place of the path where the vehicle cannot be.
std::optional<Eigen::Vector2d> firstLethal(const planning::CostMap& map, const planning::Path& path) {
  const double step_m = 0.5 * map.resolution_m();
  for (std::size_t i = std::max<std::size_t>(1, path.escape_points + 1); i < path.points_map_m.size(); ++i) {
    const Eigen::Vector2d &from = path.points_map_m[i - 1], &to = path.points_map_m[i];
    const int steps = std::max(1, static_cast<int>((to - from).norm() / step_m));
    for (int k = 1; k <= steps; ++k)
      if (const Eigen::Vector2d at = from + (to - from) * k / steps; isLethalAt(map, at)) return at;
  }
  return std::nullopt;
}

bool isOpen(const common::Frontier& frontier) { return frontier.reason == common::FrontierReason::kOpen; }

/// Whether what stands there was not there before; somebody who is tracked was not.
bool cameThere(const std::vector<MayGo>& things, const Eigen::Vector2d& place_map_m) {
  const auto thing = std::find_if(things.begin(), things.end(),
                                  [&](const MayGo& one) { return one.disc.center_map_m == place_map_m; });
  return thing == things.end() || thing->came;
}

bool shareCells(const common::Frontier& a, const common::Frontier& b) {
  return std::any_of(a.cells.begin(), a.cells.end(),
                     [&](common::CellIndex cell) { return std::count(b.cells.begin(), b.cells.end(), cell) > 0; });
}

/// Whether what stands at the second place can be looked at from the first one, not only past an edge.
bool sees(const planning::CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) {
  constexpr double kOutline_m = 0.3, kBeside_m = 0.15;  // What stands there has an outline of its own.
  const Eigen::Vector2d aside = kBeside_m * (to_map_m - from_map_m).unitOrthogonal();
  for (const Eigen::Vector2d& end_map_m :
       {to_map_m, Eigen::Vector2d(to_map_m + aside), Eigen::Vector2d(to_map_m - aside)}) {
    const Eigen::Vector2d line = end_map_m - from_map_m;
    const double before_m = line.norm() - kOutline_m;
    if (before_m > 0.0 && !map.clearance().isOpen(from_map_m, from_map_m + before_m * line.normalized())) return false;
  }
  return true;
}

/// Whether beams from the first place that pass the second one go on, and so show that nothing is there any more.
bool goesOn(const planning::CostMap& map, const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& past_map_m) {
  constexpr double kBehind_m = 0.5, kOn_m = 1.0;
  const Eigen::Vector2d along = (past_map_m - from_map_m).normalized();
  return map.clearance().isOpen(past_map_m + kBehind_m * along, past_map_m + kOn_m * along);
}

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
  who_may_go_.remember(request.people, map_);

  PlanningAnswer answer;
  answer.intent_id = request.intent_id;
  answer.cost_map = std::make_shared<const planning::CostMap>(map_);
  answer.opened = std::any_of(edge_.begin(), edge_.end(),
                              [&](common::CellIndex cell) { return map_.costAt(cell) != planning::CostMap::kLethal; });
  if (const auto* goal = std::get_if<GoalRequest>(&request.question)) {
    if (!goal->height.isOff() || !request.map3d) answer.path = goTo(*goal, request.T_map_body.position_m());
    goInSpace(request, *goal, layers, answer);
    if (answer.path && !*answer.path) findBlockage(request, *goal, layers, answer);
  } else if (const auto* blocked = std::get_if<DetourRequest>(&request.question)) {
    answer.detour = detour(*blocked, request.T_map_body.position_m());
  } else if (const auto* explore_request = std::get_if<ExploreRequest>(&request.question)) {
    explore(request, *explore_request, layers, answer);
  }
  answer.home_m = pathHome_m(here);
  answer.use = use_;
  return answer;
}

/// The path to the origin of the map, where the vehicle took off, or to the free place nearest to it, as going home
/// plans it. It is planned at every kEach-th answer: with the period of PlanningDesk that is at least every 2 s, in
/// which the vehicle flies less than 1.5 m. A person in a door blocks it for a while: for kBelieved plans
/// the length stays the last one, plus what has been flown since.
std::optional<double> PlanningWorker::pathHome_m(const Eigen::Vector2d& position_map_m) {
  constexpr int kEach = 8, kBelieved = 10;
  if (answers_++ % kEach != 0) return home_m_;
  const auto place = goalPlace(map_, {Eigen::Vector2d::Zero(), 0.0, common::kHomeShift_m});
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

void PlanningWorker::explore(const PlanningRequest& request, const ExploreRequest& question,
                             const planning::CostLayers& layers, PlanningAnswer& answer) {
  planning::ExplorationInput input;
  input.cost_map = answer.cost_map;
  input.pose_map = request.T_map_body;
  input.current = question.current;
  input.attempts = question.attempts;
  input.bounds = question.bounds;
  input.lost_map_m = question.lost_map_m;
  input.leave_building = question.leave_building;
  input.home_map_m = Eigen::Vector2d::Zero();  // As pathHome_m(): where it took off.
  if (request.map3d && explorer_.kind == planning::ExplorerKind::kCameraTour)
    input.volume = {seenVolume(*request.map3d), request.map3d->T_map_camera.position_m.z()};
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
  if (result.next && !result.kept_current) ++use_.viewpoints;
  if (result.next && !*answer.path) {
    result.reason = "no path to the viewpoint: " + answer.path->error().text;
    result.next.reset();
  }
  const bool done = result.done;
  answer.exploration = std::move(result);
  if (done) findBlockage(request, std::move(input), layers, answer);
}

/// Brings the map up to date in which all that may go has gone, and walls need `spared_m` less clearance. Returns what
/// that is; nobody is tracked in that map.
std::vector<MayGo> PlanningWorker::clear(const PlanningRequest& request, const planning::CostLayers& layers,
                                         double spared_m) {
  std::vector<MayGo> things = who_may_go_.in(map_, flown_map_m_);
  // A goal beside a crate is not waited for: only what came may go from it.
  if (!std::holds_alternative<ExploreRequest>(request.question))
    std::erase_if(things, [](const MayGo& thing) { return !thing.came; });
  planning::CostLayers alone = layers;
  alone.discs = {};
  planning::Footprint footprint = map_.footprint();
  footprint.clearance_m = std::max(0.0, footprint.clearance_m - spared_m);
  cleared_.update(gridWithout(things, *request.grid), footprint, alone);
  return things;
}

/// What is in the way of the path that there would be; nullopt if there would be none either.
std::optional<Blockage> PlanningWorker::blockageTo(const Eigen::Vector2d& goal_map_m,
                                                   const Eigen::Vector2d& position_map_m,
                                                   const std::vector<MayGo>& things) {
  const auto path = planning::Wavefront().plan(cleared_, position_map_m, goal_map_m);
  if (!path) return std::nullopt;
  const auto place_map_m = firstLethal(map_, *path);
  if (!place_map_m) return std::nullopt;
  const auto off_m = [&](const MayGo& thing) { return (thing.disc.center_map_m - *place_map_m).norm(); };
  const auto nearest = std::min_element(things.begin(), things.end(), [&](const MayGo& a, const MayGo& b) {
    return off_m(a) - a.disc.radius_m < off_m(b) - b.disc.radius_m;
  });
  const bool stands =
      nearest != things.end() && off_m(*nearest) <= nearest->disc.radius_m + map_.footprint().radius_m() + kKeptOff_m;
  if (!stands && cleared_.footprint().clearance_m < map_.footprint().clearance_m) return std::nullopt;
  // Otherwise the discs of someone who is tracked are in the way.
  const Eigen::Vector2d at_map_m = stands ? nearest->disc.center_map_m : *place_map_m;
  return Blockage{at_map_m, named(stands ? *nearest : MayGo{{at_map_m, 0.0}, "a person"}), 0};
}

/// "a person at (4.00, 2.00)".
std::string PlanningWorker::named(const MayGo& thing) const {
  return std::string(thing.who) + " at " + map_.names().of(thing.disc.center_map_m);
}

void PlanningWorker::findBlockage(const PlanningRequest& request, const GoalRequest& goal,
                                  const planning::CostLayers& layers, PlanningAnswer& answer) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  (void)rememberEdge(here);
  const std::vector<MayGo> things = clear(request, layers);
  if (const auto place = goalPlace(cleared_, goal)) answer.blockage = blockageTo(*place, here, things);
}

/// Explores the map as if all that may go had gone: what is open there, and only there, is behind it. Beams that end
/// partly on somebody in a door and partly on its post draw a cell of it into the opening.
void PlanningWorker::findBlockage(const PlanningRequest& request, planning::ExplorationInput input,
                                  const planning::CostLayers& layers, PlanningAnswer& answer) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  const planning::CostField reached = rememberEdge(here);
  input.current.reset();
  for (const double spared_m : {0.0, map_.resolution_m()}) {
    if (answer.blockage) break;
    const std::vector<MayGo> things = clear(request, layers, spared_m);
    if (things.empty() && spared_m > 0.0) break;
    std::erase_if(input.attempts, [&](const planning::ExplorationAttempt& attempt) {
      return std::any_of(things.begin(), things.end(),
                         [&](const MayGo& thing) { return isLookPast(attempt, thing.disc.center_map_m); });
    });
    input.cost_map = std::make_shared<const planning::CostMap>(cleared_);
    planning::ExplorationResult behind = planning::explore(input, explorer_);
    std::erase_if(behind.frontiers, std::not_fn(isOpen));
    double open_m = 0.0;
    for (const common::Frontier& frontier : behind.frontiers) open_m += frontier.length_m;
    if (behind.next) answer.blockage = blockageOf(*behind.next, open_m, here, things);
    tellBlocked(std::move(behind.frontiers), here, things, answer);
  }
  if (!answer.blockage) answer.gap_map_m = gapBefore(reached);
}

/// The frontiers that are open only without what may go replace those of the map that they are part of, each with who
/// is in the way; the blockage names them all. What is looked at past somebody may have to be reached through him.
void PlanningWorker::tellBlocked(std::vector<common::Frontier> behind, const Eigen::Vector2d& here,
                                 const std::vector<MayGo>& things, PlanningAnswer& answer) {
  std::vector<Blockage> told;
  if (answer.blockage) told.push_back(*answer.blockage);
  std::vector<common::Frontier> blocked;
  std::vector<common::Frontier>& frontiers = answer.exploration->frontiers;
  for (common::Frontier& frontier : behind) {
    const auto before = goalPlace(cleared_, {frontier.centroid_map_m, 0.0, kBeforeFrontier_m});
    const auto own = before ? blockageTo(*before, here, things) : std::nullopt;
    // A crate is waited for only where enough is expected behind it (blockageOf).
    if (told.empty() && (!own || !cameThere(things, own->place_map_m))) continue;
    const auto known = std::find_if(told.begin(), told.end(), [&](const Blockage& one) {
      return !own || (own->place_map_m - one.place_map_m).norm() < kSamePerson_m;
    });
    const std::string who = known == told.end() ? told.emplace_back(*own).who : known->who;
    frontier.reason = common::FrontierReason::kBlocked;
    frontier.explanation = fmt::format("{}: {} is in the way", toString(frontier.reason), who);
    std::erase_if(frontiers, [&](const common::Frontier& one) { return shareCells(one, frontier); });
    blocked.push_back(std::move(frontier));
  }
  if (told.empty()) return;
  answer.blockage = told.front();
  answer.blockage->frontiers = static_cast<int>(blocked.size());
  for (std::size_t i = 1; i < told.size(); ++i) answer.blockage->who += " and " + told[i].who;
  frontiers.insert(frontiers.begin(), std::make_move_iterator(blocked.begin()), std::make_move_iterator(blocked.end()));
}

std::optional<Blockage> PlanningWorker::blockageOf(const planning::Viewpoint& viewpoint, double open_m,
                                                   const Eigen::Vector2d& here, const std::vector<MayGo>& things) {
  const Eigen::Vector2d place_map_m = viewpoint.pose_map.position_m();
  auto blockage = blockageTo(place_map_m, here, things);
  // It may stand in the view from there, and not in the way.
  const auto thing = std::find_if(things.begin(), things.end(), [&](const MayGo& one) {
    const Eigen::Vector2d& at = one.disc.center_map_m;
    return blockage ? at == blockage->place_map_m
                    : common::segmentDistance(at, place_map_m, viewpoint.target_map_m) <= one.disc.radius_m;
  });
  if (!blockage && thing == things.end()) return std::nullopt;
  if (!blockage) blockage = Blockage{thing->disc.center_map_m, named(*thing), 0};
  const bool came = thing == things.end() || thing->came;
  const bool worth = viewpoint.gain_m2 >= kWorthWaiting_m2 || open_m >= kWorthWaiting_m;
  return came || worth ? blockage : std::nullopt;
}

/// Walks through free cells from those that can be reached on. The gap is where the way to the farthest of the others
/// leaves the former.
std::optional<Eigen::Vector2d> PlanningWorker::gapBefore(const planning::CostField& reached) const {
  constexpr double kBehind_m = 0.6, kArea_m2 = 0.2;  // More than the margin along a wall, and than pinholes in it.
  const int width = map_.rect().width();
  const auto count = static_cast<int>(map_.costs().size());
  std::vector<int> from(map_.costs().size(), -1), steps(map_.costs().size(), 0), open;
  for (int i = 0; i < count; ++i)
    if (reached.reached(i)) {
      from[static_cast<std::size_t>(i)] = i;
      open.push_back(i);
    }
  // Below a table or in a corner of the room all is seen: only what borders on the unknown may be more than it shows.
  constexpr double kUnseen_m = 0.3;
  int behind = 0, unseen = 0, farthest = -1;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const int at = open[k];
    const int step = steps[static_cast<std::size_t>(at)];
    if (step * map_.resolution_m() > kBehind_m) {
      ++behind;
      farthest = at;
    }
    for (const int next : {at - 1, at + 1, at - width, at + width}) {
      if (next < 0 || next >= count || from[static_cast<std::size_t>(next)] >= 0) continue;
      if (step * map_.resolution_m() > kBehind_m && map_.states()[next] == planning::CellState::kUnknown) ++unseen;
      if (map_.states()[next] != planning::CellState::kFree || map_.isKeptOut(next)) continue;
      from[static_cast<std::size_t>(next)] = at;
      steps[static_cast<std::size_t>(next)] = step + 1;
      open.push_back(next);
    }
  }
  if (behind * map_.resolution_m() * map_.resolution_m() < kArea_m2 || unseen * map_.resolution_m() < kUnseen_m)
    return std::nullopt;
  int gap = farthest;
  while (steps[static_cast<std::size_t>(gap)] > 0) gap = from[static_cast<std::size_t>(gap)];
  return map_.centerOf(map_.cellOf(gap));
}

/// The cells beside those that the vehicle can reach: only where one of them becomes free a path may appear.
planning::CostField PlanningWorker::rememberEdge(const Eigen::Vector2d& position_map_m) {
  edge_.clear();
  planning::CostField field;
  const auto escape = planning::escapeFrom(map_, map_.cellAt(position_map_m));
  field.spread(map_, escape ? escape->back() : map_.cellAt(position_map_m));
  if (!escape) return field;
  for (int i = 0; i < static_cast<int>(map_.costs().size()); ++i) {
    if (!field.reached(i)) continue;
    const common::CellIndex cell = map_.cellOf(i);
    for (const common::CellIndex next : {common::CellIndex{cell.x + 1, cell.y}, common::CellIndex{cell.x - 1, cell.y},
                                         common::CellIndex{cell.x, cell.y + 1}, common::CellIndex{cell.x, cell.y - 1}})
      if (map_.costAt(next) == planning::CostMap::kLethal) edge_.push_back(next);
  }
  return field;
}

tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::plan(const Eigen::Vector2d& from_map_m,
                                                                         const Eigen::Vector2d& to_map_m) {
  auto path = planner_->plan(map_, from_map_m, to_map_m);
  if (path) ++use_.paths;
  return path;
}

tl::expected<Eigen::Vector2d, planning::PlanFailure> PlanningWorker::goalPlace(const planning::CostMap& map,
                                                                               const GoalRequest& goal) {
  const planning::CostGoalMap goals(map);
  const auto place = common::judgeGoal(
      {goal.goal_map_m, std::nullopt, goal.tolerance_m, map.footprint().clearance_m, goal.shift_m, map.names()}, {},
      &goals);
  if (!place) return tl::make_unexpected(planning::failureOf(place.error()));
  return *place;
}

tl::expected<planning::Path, planning::PlanFailure> PlanningWorker::goTo(const GoalRequest& goal,
                                                                         const Eigen::Vector2d& position_map_m) {
  const auto place = goalPlace(map_, goal);
  if (!place) return tl::make_unexpected(place.error());
  return plan(position_map_m, *place);
}

/// A path that changes its height, where there is none at the height of flight, or only a great detour. A vehicle that
/// is at another height already plans in space.
void PlanningWorker::goInSpace(const PlanningRequest& request, const GoalRequest& goal,
                               const planning::CostLayers& layers, PlanningAnswer& answer) {
  const Eigen::Vector2d here = request.T_map_body.position_m();
  const auto& direct = answer.path;
  const double straight_m = (goal.goal_map_m - here).norm();
  const double detour_m = prefers_space_ ? kSpaceSaves_m : kPlaneDetour_m;
  if (direct && *direct && (*direct)->cost_m < straight_m + detour_m) return;
  if (direct && !*direct && direct->error().reason == planning::PlanFailure::Reason::kGoalKeptOut) return;
  if (!request.map3d) return;
  auto path = space_.plan(request, goal, map_.states(), layers);
  const auto changes = [&](double height_m) { return height_m != goal.height.cruise_m; };
  // Space that the laser has not seen is flown through only where the height changes.
  if (path && !goal.height.in_space && std::none_of(path->heights_m.begin(), path->heights_m.end(), changes)) return;
  answer.space = space_.maps();
  if (path && direct && *direct && path->cost_m + detour_m > (*direct)->cost_m) return;
  if (!path && direct) return;
  if (path) ++use_.paths;
  answer.path = std::move(path);
}

std::optional<DetourPlan> PlanningWorker::detour(const DetourRequest& request, const Eigen::Vector2d& position_map_m) {
  // Nearer, the laser has seen the blockage as well as it can: flying there shows no more
  // (docs/decisions/planning.md#005).
  constexpr double kWorth_m = 1.5;
  DetourPlan result;
  std::optional<Eigen::Vector2d> place;
  if (!request.blocked_map_m) {
    const auto blocked = planning::blockedPath(map_, map_.cellAt(position_map_m), map_.cellAt(request.goal_map_m));
    // A keep-out zone stays, however near the vehicle looks at it.
    if (blocked && map_.isKeptOut(map_.indexOf(blocked->first_lethal))) return std::nullopt;
    if (blocked) place = map_.centerOf(blocked->outlook);
  }
  if (!place || (*place - position_map_m).norm() < kWorth_m) {
    place = roomyPlace(position_map_m, request.blocked_map_m, request.moved_aside);
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
/// path. If what is in the way should be seen from there, so that the vehicle can stay until it has gone, a place is
/// the better the nearer its distance to it is to kLooksFrom_m, where the height of a beam is known to a slice of the
/// map, and if beams through it go on; if no place sees it, it counts as if it need not be seen. nullopt where the
/// vehicle sees it about as well from here.
std::optional<Eigen::Vector2d> PlanningWorker::roomyPlace(const Eigen::Vector2d& position_map_m,
                                                          const std::optional<Eigen::Vector2d>& seen_map_m,
                                                          bool only_if_much_better) const {
  constexpr double kReach_m = 6.0, kLooksFrom_m = 3.0, kGoesOn_m = 6.0, kPerMetreOfWidth = 3.0, kWorth_m = 1.5;
  constexpr int kEvery = 10;  // Where the best place is not held, cells this far apart are compared.
  const auto escape = planning::escapeFrom(map_, map_.cellAt(position_map_m));
  if (!escape) return std::nullopt;
  planning::CostField field;
  field.spread(map_, escape->back());
  const int here = map_.indexOf(map_.cellAt(position_map_m));
  std::pair<double, int> best{0.0, map_.indexOf(escape->back())};
  double score_here = -kReach_m;
  std::vector<std::pair<double, int>> others;  // Score and cell.
  for (int i = 0; i < static_cast<int>(map_.costs().size()); ++i) {
    if (!field.reached(i)) continue;
    const common::CellIndex cell = map_.cellOf(i);
    // The cost of a path into a corner is high, and would count as far away.
    if (!hasRoomToStop(map_, cell)) continue;
    double score = kPerMetreOfWidth * map_.clearance().at_m(cell, planning::Against::kObstacles);
    if (seen_map_m) {
      const Eigen::Vector2d place_map_m = map_.centerOf(cell);
      if (!sees(map_, place_map_m, *seen_map_m)) continue;
      score += kLooksFrom_m - std::abs((place_map_m - *seen_map_m).norm() - kLooksFrom_m);
      if (goesOn(map_, place_map_m, *seen_map_m)) score += kGoesOn_m;
    } else {
      score += std::min(field.cost_m(i, map_.resolution_m()), kReach_m);
    }
    if (i == here) score_here = score;
    if (score > best.first) best = {score, i};
    if (cell.x % kEvery == 0 && cell.y % kEvery == 0) others.emplace_back(score, i);
  }
  if (only_if_much_better && best.first - score_here < kWorth_m) return std::nullopt;
  const auto placeOf = [&](int index) { return map_.centerOf(map_.cellOf(index)); };
  if (best.first > 0.0 && planning::isHeld(map_, placeOf(best.second))) return placeOf(best.second);
  std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [score, index] : others)
    if (planning::isHeld(map_, placeOf(index))) return placeOf(index);
  return seen_map_m ? roomyPlace(position_map_m, std::nullopt, only_if_much_better) : std::nullopt;
}

}  // namespace swiftlet::autonomy
