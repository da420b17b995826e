// Explore: flies from viewpoint to viewpoint until every remaining frontier has a reason why it is left. What is
// blocked only for a time, by a person in a door, is no such reason: it waits where it sees the blockage, as long as
// the charge allows, and fails as incomplete then.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "autonomy/maneuvers/detour.hpp"
#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/patience.hpp"
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
/// The last scans may not be in the map yet. Exploring is done only after this many equal answers while the vehicle
/// stands still.
constexpr int kDoneAnswers = 2;
/// The place behind a gap moves by a few cells as the map grows.
constexpr double kSameGap_m = 0.5;
/// Time for which it looks at what is behind a gap, from the first look on: who has left it has gone from the map then.
constexpr double kLookThrough_s = 20.0;

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
  Progress waitFor(const planning::ExplorationResult& result, const std::optional<Blockage>& blockage,
                   common::Time now);
  bool forgetLooksPast(const Blockage& gone);
  /// The first look at what is behind that gap, or now if it is the first.
  common::Time looksThroughSince(const Eigen::Vector2d& gap_map_m, common::Time now);
  Progress lookThrough(common::Time now);
  Progress explored(const planning::ExplorationResult& result, common::Time now);
  void tellLeft(common::Time now) const;

  common::ExploreIntent intent_;
  Detour detour_;
  std::string reason_;  ///< Reason of the last answer.
  std::optional<common::Time> asked_;
  std::optional<planning::Viewpoint> viewpoint_;
  common::Hysteresis looks_{kLook_s};  ///< From the viewpoint, with the right heading.
  Patience patience_;                  ///< It is shut in, or what is left is behind something that may go.
  int done_answers_ = 0;               ///< Those without an open frontier that came while the vehicle stood still.
  std::optional<Eigen::Vector2d> gap_map_m_;  ///< PlanningAnswer::gap_map_m of the last answer.
  struct Look {
    Eigen::Vector2d gap_map_m;
    common::Time since;
  };
  std::vector<Look> looks_through_;     ///< The first looks at what is behind gaps.
  std::vector<common::Frontier> left_;  ///< The frontiers of the last answer.
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
  const bool gives_up = patience_.over(input.now, input.spare_s);
  if (gives_up && !gap_map_m_) {
    tellLeft(input.now);
    return Progress::failed(reason_);
  }
  const bool replan = flight_.keep(input);
  const bool looked = look(input);
  detour_.endWhenOver(input);
  const auto& blockage = patience_.blockage();
  const auto looks_at = blockage ? std::optional(blockage->place_map_m) : gap_map_m_;
  setup_.controller.lookAt(patience_.waits() && !flight_.plan() ? looks_at : std::nullopt);
  const bool due =
      !asked_ || looked || gives_up ||
      (patience_.waits() ? patience_.due(input.now, setup_.desk.opened())
                         : (input.now - *asked_).seconds() >= reconsiderAfter_s() || (replan && !flight_.plan()));
  if (!flight_.mayAsk()) return Progress::running();
  if (looks_at && patience_.waits() && !gives_up && detour_.due(patience_.since(), input.now, looks_at)) {
    detour_.ask(input, *looks_at, looks_at);
  } else if (due) {
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
  if (const auto was = patience_.blockage(); was && (result.next || !answer.blockage)) {
    patience_.reset();
    if (forgetLooksPast(*was) && !result.next) {
      asked_.reset();
      return Progress::running(reason_);
    }
  }
  if (result.next) {
    goOn(answer, now, state);
  } else if (!detour_.active()) {
    viewpoint_.reset();
    flight_.abandon();
    gap_map_m_ = answer.gap_map_m;
    if (!result.done || answer.blockage) return waitFor(result, answer.blockage, now);
    if (gap_map_m_ && (now - looksThroughSince(*gap_map_m_, now)).seconds() < kLookThrough_s) return lookThrough(now);
    patience_.reset();
    if (setup_.controller.stopped() && ++done_answers_ >= kDoneAnswers) return explored(result, now);
  }
  return Progress::running(reason_);
}

void Explore::goOn(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  const planning::ExplorationResult& result = *answer.exploration;
  done_answers_ = 0;
  patience_.reset();
  gap_map_m_.reset();
  detour_.breakOff();
  if (!result.kept_current) {
    viewpoint_ = result.next;
    looks_.reset();
    flight_.setGoalYaw(result.next->pose_map.yaw_rad);
    flight_.release();
  }
  flight_.offer(**answer.path, now, state);
}

/// It is shut in, or what is left to explore is behind something that may go.
Progress Explore::waitFor(const planning::ExplorationResult& result, const std::optional<Blockage>& blockage,
                          Time now) {
  done_answers_ = 0;
  left_ = result.frontiers;
  if (blockage) {
    reason_ = fmt::format("incomplete, {} blocked by {}", blockage->frontiers, blockage->who);
    if (!patience_.waits()) setup_.memory.log.info(now, kFlightSource, "waits to explore on", reason_);
  }
  patience_.failed(now, blockage);
  return Progress::running("waiting: " + reason_);
}

/// What was looked at past somebody was not seen; he has gone. True if there were such looks.
bool Explore::forgetLooksPast(const Blockage& gone) {
  return std::erase_if(setup_.memory.attempts, [&](const planning::ExplorationAttempt& attempt) {
           return isLookPast(attempt, gone.place_map_m);
         }) > 0;
}

/// Each gap for a while: a look that opens something else to explore would be repeated after that for ever.
Time Explore::looksThroughSince(const Eigen::Vector2d& gap_map_m, Time now) {
  const auto look = std::find_if(looks_through_.begin(), looks_through_.end(),
                                 [&](const Look& one) { return (one.gap_map_m - gap_map_m).norm() < kSameGap_m; });
  if (look != looks_through_.end()) return look->since;
  looks_through_.push_back({gap_map_m, now});
  setup_.memory.log.info(now, kFlightSource, "looks once more at what is behind a gap",
                         setup_.desk.costMap()->names().of(gap_map_m));
  return now;
}

/// Somebody in a door leaves a gap beside him, and so does what is left in the map of who has gone.
Progress Explore::lookThrough(Time now) {
  patience_.reset();  // The look has an end of its own.
  patience_.failed(now, std::nullopt);
  return Progress::running("looks at what is behind a gap");
}

Progress Explore::explored(const planning::ExplorationResult& result, Time now) {
  left_ = result.frontiers;
  tellLeft(now);
  setup_.memory.attempts.clear();
  return Progress::done(fmt::format("explored {:.1f} m2, {} frontiers left, each with a reason",
                                    result.explored_area_m2, result.frontiers.size()));
}

void Explore::tellLeft(Time now) const {
  for (const common::Frontier& frontier : left_)
    setup_.memory.log.info(
        now, kFlightSource,
        fmt::format("frontier of {:.2f} m at {} left: {}", frontier.length_m,
                    setup_.desk.costMap()->names().of(frontier.centroid_map_m), toString(frontier.reason)),
        frontier.explanation);
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::ExploreIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Explore>(intent, setup);
}

}  // namespace swiftlet::autonomy
