// Explore: flies from viewpoint to viewpoint until every remaining frontier has a reason why it is left.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "autonomy/maneuvers/detour.hpp"
#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/hysteresis.hpp"
#include "common/segment.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

/// Time at a viewpoint, until its scans are in the map and were processed.
constexpr double kLook_s = 0.5;
/// Yaw error at which a viewpoint counts as reached.
constexpr double kViewpointTolerance_deg = 12.0;
/// Least time between choices of the next viewpoint, in seconds and as a share of the flight time to the present one.
constexpr double kExplorePeriod_s = 0.5, kExplorePeriodShare = 0.15;
/// A person seen within this time may block what could not be reached, or may have been mapped there. Then a detour is
/// made, but not forever (docs/decisions/planning.md#005).
constexpr double kLately_s = 30.0, kLookInto_s = 30.0;
/// The last scans may not be in the map yet. Exploring is done only after this many equal answers while the vehicle
/// stands still.
constexpr int kDoneAnswers = 2;

class Explore final : public PathManeuver {
 public:
  Explore(const common::ExploreIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState& state) const override;

 private:
  Progress fly(const ManeuverInput& input) override;
  double reconsiderAfter_s() const;
  /// True if it has looked long enough from the viewpoint, which is then finished.
  bool look(const ManeuverInput& input);
  void goOn(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state);
  Progress nothingOpen(const planning::ExplorationResult& result, common::Time now);
  Progress explored(const planning::ExplorationResult& result, common::Time now);
  /// The longest frontier that a recently seen person may hide.
  std::optional<Eigen::Vector2d> blockedFrontier(const planning::ExplorationResult& result, common::Time now) const;

  common::ExploreIntent intent_;
  Detour detour_;
  std::string reason_;  ///< Reason of the last answer.
  std::optional<common::Time> asked_;
  std::optional<planning::Viewpoint> viewpoint_;
  common::Hysteresis looks_{kLook_s};  ///< From the viewpoint, with the right heading.
  common::Hysteresis shut_in_;         ///< Frontiers are open, but there is no path to any.
  common::Hysteresis nothing_open_;    ///< The answers are without an open frontier.
  int done_answers_ = 0;               ///< Those of them that came while the vehicle stood still.
  std::optional<Eigen::Vector2d> blocked_frontier_map_m_;
};

Explore::Explore(const common::ExploreIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "explore", intent.mode), intent_(intent), detour_(setup, flight_) {}

Aim Explore::aim(const common::VehicleState& state) const {
  Aim aim = PathManeuver::aim(state);
  if (viewpoint_) {
    aim.goal_map_m = viewpoint_->pose_map.position_m();
    aim.wants_to_see_map_m = viewpoint_->target_map_m;
  }
  return aim;
}

Progress Explore::fly(const ManeuverInput& input) {
  if (shut_in_.active_s(input.now) > setup_.config.give_up_s) return Progress::failed(reason_);
  const bool replan = flight_.keep(input);
  const bool looked = look(input);
  detour_.endWhenOver(input);
  const double period_s = detour_.active() ? Detour::kAskAgain_s : reconsiderAfter_s();
  const bool due = !asked_ || (input.now - *asked_).seconds() >= period_s || looked || (replan && !flight_.plan());
  if (!due || !flight_.mayAsk()) return Progress::running();
  if (blocked_frontier_map_m_ && detour_.due(nothing_open_.since(), input.now)) {
    detour_.ask(input, *blocked_frontier_map_m_);
  } else {
    asked_ = input.now;
    flight_.ask(input, ExploreRequest{viewpoint_, setup_.memory.attempts, intent_.bounds, setup_.memory.lost_map_m,
                                      intent_.leave_building});
  }
  return Progress::running();
}

/// A choice on a large map takes long, and a viewpoint far away seldom changes: it is chosen again after a share of the
/// time that its path takes.
double Explore::reconsiderAfter_s() const {
  const double rest_m = common::polylineLength(flight_.remaining_map_m());
  return std::max(kExplorePeriod_s,
                  kExplorePeriodShare * rest_m / setup_.controller.follower().speed_m_s(intent_.mode));
}

bool Explore::look(const ManeuverInput& input) {
  if (!viewpoint_) return false;
  const common::Pose2 pose = input.state.T_map_body_planar();
  const double turn_rad = std::abs(common::wrapAngle(pose.yaw_rad - viewpoint_->pose_map.yaw_rad));
  const bool near = (pose.position_m() - viewpoint_->pose_map.position_m()).norm() < kViewpointTolerance_m;
  const bool turned = turn_rad < kViewpointTolerance_deg * std::numbers::pi / 180.0;
  looks_.update(near && turned, input.now);
  if (!looks_.active()) return false;
  setup_.memory.attempts.push_back(planning::attemptFrom(*viewpoint_));
  viewpoint_.reset();
  flight_.release();
  return true;
}

Progress Explore::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (answer.detour) return detour_.begin(*answer.detour, reason_, now, state);
  if (!answer.exploration) return Progress::running();
  const planning::ExplorationResult& result = *answer.exploration;
  reason_ = result.reason;
  if (result.next || result.done) shut_in_.reset();
  if (result.next) {
    goOn(answer, now, state);
  } else if (!detour_.active()) {
    viewpoint_.reset();
    flight_.abandon();
    if (result.done) return nothingOpen(result, now);
    shut_in_.update(true, now);
  }
  return Progress::running(reason_);
}

void Explore::goOn(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  const planning::ExplorationResult& result = *answer.exploration;
  done_answers_ = 0;
  nothing_open_.reset();
  blocked_frontier_map_m_.reset();
  detour_.breakOff();
  if (!result.kept_current) {
    viewpoint_ = result.next;
    looks_.reset();
    flight_.setGoalYaw(result.next->pose_map.yaw_rad);
    flight_.release();
  }
  flight_.offer(**answer.path, now, state);
}

Progress Explore::nothingOpen(const planning::ExplorationResult& result, Time now) {
  nothing_open_.update(true, now);
  blocked_frontier_map_m_ = blockedFrontier(result, now);
  if (blocked_frontier_map_m_)
    reason_ = "a person may block the path";
  else if (setup_.controller.stopped() && ++done_answers_ >= kDoneAnswers)
    return explored(result, now);
  return Progress::running(reason_);
}

std::optional<Eigen::Vector2d> Explore::blockedFrontier(const planning::ExplorationResult& result, Time now) const {
  const auto& people_seen = setup_.memory.people_seen;
  const bool people = people_seen && (now - *people_seen).seconds() < kLately_s;
  if (!people || nothing_open_.active_s(now) >= kLookInto_s) return std::nullopt;
  const common::Frontier* longest = nullptr;
  for (const common::Frontier& f : result.frontiers)
    if (f.reason == common::FrontierReason::kUnreachable && (!longest || f.length_m > longest->length_m)) longest = &f;
  return longest ? std::optional(longest->centroid_map_m) : std::nullopt;
}

Progress Explore::explored(const planning::ExplorationResult& result, Time now) {
  for (const common::Frontier& frontier : result.frontiers)
    setup_.memory.log.info(
        now, kFlightSource,
        fmt::format("frontier of {:.2f} m at {} left: {}", frontier.length_m,
                    setup_.desk.costMap()->names().of(frontier.centroid_map_m), toString(frontier.reason)),
        frontier.explanation);
  setup_.memory.attempts.clear();
  return Progress::done(fmt::format("explored {:.1f} m2, {} frontiers left, each with a reason",
                                    result.explored_area_m2, result.frontiers.size()));
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::ExploreIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Explore>(intent, setup);
}

}  // namespace swiftlet::autonomy
