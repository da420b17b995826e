#include "autonomy/maneuvers/explore.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

constexpr double kLook_s = 0.5;  // Time at a viewpoint, until its scans are in the map and were processed.
/// A person seen within this time may block what could not be reached, or may have been mapped there. Then a detour is
/// made, but not forever.
constexpr double kLately_s = 30.0, kLookInto_s = 30.0;
/// The last scans may not be in the map yet. Exploring is done only after this many equal answers while the vehicle
/// stands still.
constexpr int kDoneAnswers = 2;

}  // namespace

using common::Time;

Explore::Explore(const common::ExploreIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "explore", intent.mode), intent_(intent), detour_(setup, flight_) {}

std::optional<Eigen::Vector2d> Explore::goal_map_m() const {
  return viewpoint_ ? std::optional(viewpoint_->pose_map.position_m()) : std::nullopt;
}

std::optional<Eigen::Vector2d> Explore::wantsToSee_map_m() const {
  return viewpoint_ ? std::optional(viewpoint_->target_map_m) : std::nullopt;
}

Progress Explore::fly(const ManeuverInput& input) {
  if (shut_in_since_ && (input.now - *shut_in_since_).seconds() > setup_.config.give_up_s)
    return Progress::failed(reason_);
  const bool replan = flight_.keep(input);
  const bool looked = look(input);
  detour_.endWhenOver(input);
  const double period_s = detour_.active() ? Detour::kAskAgain_s : reconsiderAfter_s();
  const bool due = !asked_ || (input.now - *asked_).seconds() >= period_s || looked || (replan && !flight_.plan());
  if (!due || !flight_.mayAsk()) return Progress::running();
  if (blocked_frontier_map_m_ && detour_.due(*done_since_, input.now)) {
    detour_.ask(input, *blocked_frontier_map_m_);
  } else {
    asked_ = input.now;
    flight_.ask(input, ExploreRequest{viewpoint_, setup_.memory.exploration.attempts, intent_.bounds,
                                      setup_.memory.exploration.lost_map_m, intent_.leave_building});
  }
  return Progress::running();
}

/// A choice on a large map takes long, and a viewpoint far away seldom changes: it is chosen again after a share of the
/// time that its path takes.
double Explore::reconsiderAfter_s() const {
  const double rest_m = common::polylineLength(flight_.remaining_map_m());
  return std::max(setup_.config.explore_period_s,
                  setup_.config.explore_period_share * rest_m / setup_.controller.follower().speed_m_s(intent_.mode));
}

bool Explore::look(const ManeuverInput& input) {
  if (!viewpoint_) return false;
  const common::Pose2 pose = input.state.T_map_body_planar();
  const double turn_rad = std::abs(common::wrapAngle(pose.yaw_rad - viewpoint_->pose_map.yaw_rad));
  const bool near =
      (pose.position_m() - viewpoint_->pose_map.position_m()).norm() < setup_.config.viewpoint_tolerance_m;
  const bool turned = turn_rad < setup_.config.viewpoint_tolerance_deg * std::numbers::pi / 180.0;
  if (!near || !turned) {
    looks_since_.reset();
    return false;
  }
  if (!looks_since_) looks_since_ = input.now;
  if ((input.now - *looks_since_).seconds() < kLook_s) return false;
  setup_.memory.exploration.attempts.push_back(planning::attemptFrom(*viewpoint_));
  viewpoint_.reset();
  flight_.release();
  return true;
}

Progress Explore::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (answer.detour) return detour_.begin(*answer.detour, reason_, now, state);
  if (!answer.exploration) return Progress::running();
  const planning::ExplorationResult& result = *answer.exploration;
  reason_ = result.reason;
  if (result.next || result.done) shut_in_since_.reset();
  if (result.next) {
    goOn(answer, now, state);
  } else if (!detour_.active()) {
    viewpoint_.reset();
    flight_.abandon();
    if (result.done) return nothingOpen(result, now);
    if (!shut_in_since_) shut_in_since_ = now;
  }
  return Progress::running(reason_);
}

void Explore::goOn(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  const planning::ExplorationResult& result = *answer.exploration;
  done_answers_ = 0;
  done_since_.reset();
  blocked_frontier_map_m_.reset();
  detour_.breakOff();
  if (!result.kept_current) {
    viewpoint_ = result.next;
    looks_since_.reset();
    flight_.setGoalYaw(result.next->pose_map.yaw_rad);
    flight_.release();
  }
  flight_.offer(**answer.path, now, state);
}

Progress Explore::nothingOpen(const planning::ExplorationResult& result, Time now) {
  if (!done_since_) done_since_ = now;
  blocked_frontier_map_m_ = blockedFrontier(result, now);
  if (blocked_frontier_map_m_)
    reason_ = "a person may block the path";
  else if (setup_.controller.stopped() && ++done_answers_ >= kDoneAnswers)
    return explored(result, now);
  return Progress::running(reason_);
}

std::optional<Eigen::Vector2d> Explore::blockedFrontier(const planning::ExplorationResult& result, Time now) const {
  const auto& people_seen = setup_.memory.exploration.people_seen;
  const bool people = people_seen && (now - *people_seen).seconds() < kLately_s;
  if (!people || (now - *done_since_).seconds() >= kLookInto_s) return std::nullopt;
  const common::Frontier* longest = nullptr;
  for (const common::Frontier& f : result.frontiers)
    if (f.reason == common::FrontierReason::kUnreachable && (!longest || f.length_m > longest->length_m)) longest = &f;
  return longest ? std::optional(longest->centroid_map_m) : std::nullopt;
}

Progress Explore::explored(const planning::ExplorationResult& result, Time now) {
  for (const common::Frontier& frontier : result.frontiers)
    setup_.memory.say(
        now, common::Severity::kInfo,
        fmt::format("frontier of {:.2f} m at {} left: {}", frontier.length_m,
                    setup_.desk.costMap()->names().of(frontier.centroid_map_m), toString(frontier.reason)),
        frontier.explanation);
  setup_.memory.exploration.attempts.clear();
  return Progress::done(fmt::format("explored {:.1f} m2, {} frontiers left, each with a reason",
                                    result.explored_area_m2, result.frontiers.size()));
}

}  // namespace swiftlet::autonomy
