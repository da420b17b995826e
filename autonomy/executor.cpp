#include "autonomy/executor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {
namespace {

/// A map that does not reach the goal may just be about to grow.
constexpr double kGrowing_s = 2.0;
/// How often the way is asked for on a detour.
constexpr double kAskAgain_s = 1.0;
constexpr double kLook_s = 0.5;  // At a viewpoint, until its scans are in the map and were thought over.
/// Who was about so lately may stand in the way of what could not be reached, or have stood there when it was mapped;
/// that is looked into, but not for ever.
constexpr double kLately_s = 30.0, kLookInto_s = 30.0;

/// Whoever stands in the way may go; a goal in space never seen is not seen by waiting.
bool mayPass(const planning::PlanFailure& failure) {
  using Reason = planning::PlanFailure::Reason;
  return failure.reason != Reason::kGoalUnseen && failure.reason != Reason::kOutsideMap;
}

}  // namespace

using common::FlightState;
using common::IntentState;
using common::Severity;
using common::Time;

Executor::Executor(const ExecutorConfig& config, const common::VehicleConfig& vehicle, double grid_resolution_m,
                   control::FlightController& controller, common::JobRunner& jobs)
    : config_(config),
      vehicle_(vehicle),
      controller_(controller),
      jobs_(jobs),
      worker_(std::make_shared<PlanningWorker>(config.cost_map, config.exploration, grid_resolution_m)),
      keeper_(config.plan_keeper),
      frontiers_(std::make_shared<std::vector<common::Frontier>>()) {}

void Executor::want(const common::Intent& intent) {
  if (intent.id == intent_.id && started_) return;
  intent_ = intent;
  started_ = false;
  status_ = {intent.id, IntentState::kRunning, toString(intent), false};
}

void Executor::tick(const ExecutorInput& input) {
  now_ = input.now;
  state_ = input.state;
  if (input.anybody_walks) last_people_ = now_;
  if (!started_) start();
  if (status_.state == IntentState::kRunning)
    std::visit([&](const auto& kind) { carryOut(input, kind); }, intent_.kind);
  const bool due = !last_request_ || (now_ - *last_request_).seconds() >= config_.planning_period_s;
  if (due && jobs_.idle("planning")) requestPlan(input, {});
  status_.released = controller_.stopped() && !retreating_;
}

void Executor::react(const planning::AvoidanceDecision& decision, const common::VehicleState& state) {
  state_ = state;
  controller_.setSpeedLimit(decision.speed_limit_m_s);
  if (controller_.state() != FlightState::kFlying) {
    retreating_ = false;
    return;
  }
  const common::Pose2 T_map_body = state.T_map_body_planar();
  if (!retreating_ || decision.turn_rad != 0.0) retreat_yaw_map_rad_ = T_map_body.yaw_rad + decision.turn_rad;
  if (decision.retreat_velocity_level_m_s) {
    (void)controller_.followVelocity(Eigen::Rotation2Dd(T_map_body.yaw_rad) * *decision.retreat_velocity_level_m_s,
                                     decision.retreat_acceleration_m_s2, retreat_yaw_map_rad_);
    keeper_.clear();
    retreating_ = true;
  } else if (retreating_) {
    controller_.hold();
    retreating_ = false;
  }
}

Eigen::Vector2d Executor::wishedVelocity_map_m_s() const {
  const auto points = keeper_.remaining();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d step = points[i] - points.front();
    if (step.norm() > 0.05) return controller_.speed_m_s(control::FlightMode::kFast) * step.normalized();
  }
  return Eigen::Vector2d::Zero();
}

std::optional<Eigen::Vector2d> Executor::goal_map_m() const {
  if (const auto* go_to = std::get_if<common::GoToIntent>(&intent_.kind)) return go_to->goal_map_m;
  if (std::holds_alternative<common::ExploreIntent>(intent_.kind) && viewpoint_)
    return viewpoint_->pose_map.position_m();
  return std::nullopt;
}

std::optional<std::string> Executor::refusalOfGoal(const Eigen::Vector2d& goal_map_m) const {
  if (!goal_map_m.allFinite()) return "the goal is not a place";
  if (!cost_map_) return "there is no map yet";
  const common::CellIndex cell = cost_map_->cellAt(goal_map_m);
  const auto place = fmt::format("({:.2f}, {:.2f})", goal_map_m.x(), goal_map_m.y());
  if (!cost_map_->contains(cell)) return place + " is outside the map";
  switch (cost_map_->stateAt(cell)) {
    case planning::CellState::kUnknown:
      return place + " is not explored yet";
    case planning::CellState::kOccupied:
      return place + " is in an obstacle";
    case planning::CellState::kFree:
      break;
  }
  if (cost_map_->costAt(cell) == planning::CostMap::kLethal)
    return fmt::format("{} is nearer to an obstacle than the hull and {:.2f} m", place,
                       cost_map_->footprint().clearance_m);
  return std::nullopt;
}

std::vector<common::Event> Executor::takeEvents() { return std::exchange(events_, {}); }

// ------------------------------------------------------------------------------------------------------ the intents

void Executor::start() {
  started_ = true;
  keeper_.clear();
  viewpoint_.reset();
  within_since_.reset();
  no_way_since_.reset();
  detour_since_.reset();
  on_detour_ = false;
  goal_yaw_map_rad_.reset();
  last_exploration_.reset();
  done_answers_ = 0;
  done_since_.reset();
  blocked_frontier_map_m_.reset();
  if (controller_.state() == FlightState::kFlying && !retreating_) controller_.hold();
  if (const auto* go_to = std::get_if<common::GoToIntent>(&intent_.kind)) {
    if (go_to->height_m) cruise_height_m_ = *go_to->height_m;
    goal_yaw_map_rad_ = go_to->yaw_map_rad;
  } else if (const auto* take_off = std::get_if<common::TakeOffIntent>(&intent_.kind)) {
    if (controller_.state() == FlightState::kFlying || controller_.state() == FlightState::kTakingOff) return;
    cruise_height_m_ = take_off->height_m;
    const auto commanded = controller_.command(control::TakeOff{take_off->height_m});
    if (!commanded) fail(commanded.error());
  } else if (std::holds_alternative<common::LandIntent>(intent_.kind)) {
    if (!control::isAirborne(controller_.state())) return;
    const auto commanded = controller_.command(control::Land{});
    if (!commanded) fail(commanded.error());
  }
}

void Executor::carryOut(const ExecutorInput&, const common::HoldIntent&) { status_.reason = "holding"; }

void Executor::carryOut(const ExecutorInput& input, const common::AvoidIntent&) {
  status_.reason = input.avoidance.status.reason;
}

void Executor::carryOut(const ExecutorInput&, const common::TakeOffIntent&) {
  if (controller_.state() == FlightState::kFlying) return succeed("at the take-off height");
  if (controller_.state() == FlightState::kTakingOff) return;
  if (controller_.state() == FlightState::kLanded) return;
  fail(fmt::format("cannot take off while {}", toString(controller_.state())));
}

void Executor::carryOut(const ExecutorInput&, const common::LandIntent&) {
  if (!control::isAirborne(controller_.state())) succeed("on the ground");
}

void Executor::carryOut(const ExecutorInput& input, const common::GoToIntent& go_to) {
  if (controller_.state() != FlightState::kFlying)
    return fail(fmt::format("cannot fly to a goal while {}", toString(controller_.state())));
  if (retreating_) return;
  if (arrived(input, go_to.goal_map_m, go_to.tolerance_m)) {
    return succeed(fmt::format("reached ({:.2f}, {:.2f})", go_to.goal_map_m.x(), go_to.goal_map_m.y()));
  }
  const bool replan = keepPlan(input);
  const double patience_s = mayPass(no_way_) ? config_.give_up_s : kGrowing_s;
  if (no_way_since_ && (now_ - *no_way_since_).seconds() > patience_s) return fail(no_way_.text);
  endDetourWhenOver(input);
  if (!jobs_.idle("planning")) return;
  if (mayPass(no_way_) && detourIsDue(no_way_since_)) return takeDetour(input, go_to.goal_map_m);
  if (on_detour_ ? (now_ - *asked_for_way_).seconds() < kAskAgain_s : !replan) return;
  asked_for_way_ = now_;
  PlanningRequest request;
  request.question = GoalRequest{go_to.goal_map_m, go_to.tolerance_m};
  requestPlan(input, std::move(request));
}

void Executor::endDetourWhenOver(const ExecutorInput& input) {
  if (!on_detour_) return;
  if (keeper_.plan() && (now_ - *detour_since_).seconds() <= config_.detour_s) {
    const Eigen::Vector2d left = keeper_.plan()->points_map_m.back() - input.state.T_map_body_planar().position_m();
    if (left.norm() > config_.viewpoint_tolerance_m) return;
  }
  on_detour_ = false;
  detour_since_ = now_;
  abandonPlan();
}

bool Executor::detourIsDue(std::optional<Time> stuck_since) const {
  if (!stuck_since || keeper_.plan()) return false;
  return (now_ - std::max(*stuck_since, detour_since_.value_or(*stuck_since))).seconds() >= config_.detour_after_s;
}

void Executor::takeDetour(const ExecutorInput& input, const Eigen::Vector2d& goal_map_m) {
  detour_since_ = now_;
  PlanningRequest request;
  request.question = DetourRequest{goal_map_m};
  requestPlan(input, std::move(request));
}

void Executor::carryOut(const ExecutorInput& input, const common::ExploreIntent& explore) {
  if (controller_.state() != FlightState::kFlying)
    return fail(fmt::format("cannot explore while {}", toString(controller_.state())));
  if (retreating_) return;
  if (no_way_since_ && (now_ - *no_way_since_).seconds() > config_.give_up_s) return fail(status_.reason);
  const bool replan = keepPlan(input);
  bool reached = false;
  if (viewpoint_) {
    const common::Pose2 pose = state_.T_map_body_planar();
    const double turn_rad = std::abs(common::wrapAngle(pose.yaw_rad - viewpoint_->pose_map.yaw_rad));
    const bool near = (pose.position_m() - viewpoint_->pose_map.position_m()).norm() < config_.viewpoint_tolerance_m;
    const bool turned = turn_rad < config_.viewpoint_tolerance_deg * std::numbers::pi / 180.0;
    if (!near || !turned) {
      looks_since_.reset();
    } else if (!looks_since_) {
      looks_since_ = now_;
    } else if ((now_ - *looks_since_).seconds() >= kLook_s) {
      attempts_.push_back(planning::attemptFrom(*viewpoint_));
      viewpoint_.reset();
      keeper_.clear();
      reached = true;
    }
  }
  endDetourWhenOver(input);
  const double period_s = on_detour_ ? kAskAgain_s : config_.explore_period_s;
  const bool due =
      !last_exploration_ || (now_ - *last_exploration_).seconds() >= period_s || reached || (replan && !keeper_.plan());
  if (!due || !jobs_.idle("planning")) return;
  if (blocked_frontier_map_m_ && detourIsDue(done_since_)) return takeDetour(input, *blocked_frontier_map_m_);
  PlanningRequest request;
  request.question = ExploreRequest{viewpoint_, attempts_, explore.bounds};
  last_exploration_ = now_;
  requestPlan(input, std::move(request));
}

// --------------------------------------------------------------------------------------------------------- planning

void Executor::requestPlan(const ExecutorInput& input, PlanningRequest request) {
  request.intent_id = intent_.id;
  request.grid = input.grid;
  request.levels = input.levels;
  request.discs = input.discs;
  request.footprint = {vehicle_.hullRadius_m(), clearance_m()};
  request.T_map_body = input.state.T_map_body_planar();
  last_request_ = now_;
  jobs_.submit("planning", now_, common::Duration::fromSeconds(config_.planning_latency_s),
               [this, worker = worker_, request = std::move(request)]() -> common::JobRunner::Deliver {
                 return [this, answer = worker->answer(request)](Time delivered) { receive(answer, delivered); };
               });
}

void Executor::receive(const PlanningAnswer& answer, Time now) {
  now_ = now;
  cost_map_ = answer.cost_map;
  if (answer.exploration) {
    frontiers_ = std::make_shared<std::vector<common::Frontier>>(answer.exploration->frontiers);
    explored_area_m2_ = answer.exploration->explored_area_m2;
  }
  if (answer.intent_id != intent_.id || status_.state != IntentState::kRunning || retreating_) return;
  if (answer.detour) receiveDetour(*answer.detour);
  if (answer.path) receivePath(*answer.path);
  if (answer.exploration) receiveExploration(*answer.exploration);
}

void Executor::receivePath(const tl::expected<planning::Path, planning::PlanFailure>& path) {
  if (path) {
    no_way_since_.reset();
    if (std::exchange(on_detour_, false)) keeper_.clear();
    offer(*path);
    return;
  }
  if (!no_way_since_) {
    no_way_since_ = now_;
    say(Severity::kWarning, "no way to the goal at present", path.error().text);
  }
  no_way_ = path.error();
  status_.reason = "waiting: " + no_way_.text;
}

void Executor::receiveDetour(const Detour& detour) {
  on_detour_ = true;
  say(Severity::kInfo, detour.makes_room ? "goes aside to make room" : "goes nearer to look", status_.reason);
  offer(detour.path);
}

/// The longest of those that could not be reached.
std::optional<Eigen::Vector2d> Executor::blockedFrontier(const std::vector<common::Frontier>& frontiers) {
  const common::Frontier* longest = nullptr;
  for (const common::Frontier& f : frontiers)
    if (f.reason == common::FrontierReason::kUnreachable && (!longest || f.length_m > longest->length_m)) longest = &f;
  return longest ? std::optional(longest->centroid_map_m) : std::nullopt;
}

void Executor::receiveExploration(const planning::ExplorationResult& result) {
  status_.reason = result.reason;
  if (result.next || result.done) no_way_since_.reset();
  if (result.next) {
    done_answers_ = 0;
    done_since_.reset();
    blocked_frontier_map_m_.reset();
    if (std::exchange(on_detour_, false)) keeper_.clear();
    if (!result.kept_current) {
      viewpoint_ = result.next;
      looks_since_.reset();
      goal_yaw_map_rad_ = result.next->pose_map.yaw_rad;
      keeper_.clear();
    }
    offer(result.next->path);
    return;
  }
  if (on_detour_) return;
  viewpoint_.reset();
  abandonPlan();
  if (!result.done) {
    if (!no_way_since_) no_way_since_ = now_;
    return;
  }
  if (!done_since_) done_since_ = now_;
  blocked_frontier_map_m_.reset();
  const bool people = last_people_ && (now_ - *last_people_).seconds() < kLately_s;
  if (people && (now_ - *done_since_).seconds() < kLookInto_s)
    blocked_frontier_map_m_ = blockedFrontier(result.frontiers);
  if (blocked_frontier_map_m_) {
    status_.reason = "somebody may stand in the way";
    return;
  }
  // The last scans may still be on their way into the map: done is believed when it is said twice, standing still.
  if (controller_.stopped() && ++done_answers_ >= 2) {
    for (const common::Frontier& frontier : result.frontiers)
      say(Severity::kInfo,
          fmt::format("frontier of {:.2f} m at ({:.2f}, {:.2f}) left: {}", frontier.length_m,
                      frontier.centroid_map_m.x(), frontier.centroid_map_m.y(), toString(frontier.reason)),
          frontier.explanation);
    attempts_.clear();
    succeed(fmt::format("explored {:.1f} m2, {} frontiers left, each with a reason", result.explored_area_m2,
                        result.frontiers.size()));
  }
}

void Executor::abandonPlan() {
  controller_.hold();
  keeper_.clear();
}

/// Stops when the plan has become invalid; true when a new plan is wanted.
bool Executor::keepPlan(const ExecutorInput& input) {
  if (!cost_map_) return true;
  if (!controller_.followsPath()) keeper_.clear();  // A lost estimate or the pilot ended it.
  if (!keeper_.plan()) return true;
  const auto check = keeper_.check(now_, *cost_map_, input.state.T_map_body_planar().position_m());
  if (!check.valid) {
    say(Severity::kInfo, "plan given up", check.reason);
    abandonPlan();
  }
  return check.replan;
}

void Executor::offer(const planning::Path& path) {
  if (!cost_map_) return;
  if (keeper_.offer(path, now_, *cost_map_, state_.T_map_body_planar().position_m())) fly();
}

void Executor::fly() {
  control::FlightPath path;
  for (const Eigen::Vector2d& point : keeper_.plan()->points_map_m)
    path.points_map_m.emplace_back(point.x(), point.y(), cruise_height_m_);
  path.mode = control::FlightMode::kFast;
  path.goal_yaw_map_rad = goal_yaw_map_rad_;
  (void)controller_.follow(path);
}

bool Executor::arrived(const ExecutorInput& input, const Eigen::Vector2d& goal_map_m, double tolerance_m) {
  const Eigen::Vector3d position_map_m = input.state.T_map_body().position_m;
  const bool within = (position_map_m.head<2>() - goal_map_m).norm() < tolerance_m &&
                      std::abs(position_map_m.z() - cruise_height_m_) < std::max(0.10, tolerance_m) &&
                      input.state.velocity_odom_m_s.norm() < config_.arrival_speed_m_s;
  if (!within) {
    within_since_.reset();
    return false;
  }
  if (!within_since_) within_since_ = now_;
  return (now_ - *within_since_).seconds() >= config_.arrival_s;
}

double Executor::clearance_m() const {
  if (const auto* go_to = std::get_if<common::GoToIntent>(&intent_.kind)) return go_to->clearance_m;
  if (const auto* explore = std::get_if<common::ExploreIntent>(&intent_.kind)) return explore->clearance_m;
  return config_.clearance_m;
}

void Executor::succeed(std::string reason) {
  say(Severity::kInfo, toString(intent_) + ": done", reason);
  status_.state = IntentState::kSucceeded;
  status_.reason = std::move(reason);
  keeper_.clear();
}

void Executor::fail(std::string reason) {
  say(Severity::kWarning, toString(intent_) + ": failed", reason);
  if (controller_.state() == FlightState::kFlying) controller_.hold();
  status_.state = IntentState::kFailed;
  status_.reason = std::move(reason);
  keeper_.clear();
}

void Executor::say(Severity severity, std::string text, std::string reason) {
  events_.push_back({now_, severity, "flight", std::move(text), std::move(reason)});
}

}  // namespace swiftlet::autonomy
