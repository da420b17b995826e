// GoTo: flies to a place of the map; done on arrival. Where that place is not free, it waits, and then flies to a free
// place beside it as far as the intent's `shift_m` allows, which may be beyond the tolerance. Without a path it waits
// where it sees what is in the way, as long as the charge allows, and fails with the planner's reason. Going home is a
// GoTo with the home pose.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "autonomy/maneuvers/detour.hpp"
#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/patience.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/geometry.hpp"
#include "common/goal.hpp"
#include "common/hysteresis.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

/// A map that does not reach the goal may be about to grow.
constexpr double kGrowing_s = 2.0;

/// A person who blocks the path may go away, so waiting helps. It does not help for a goal in unknown space or in a
/// keep-out zone.
bool mayPass(const planning::PlanFailure& failure) {
  using Reason = planning::PlanFailure::Reason;
  return failure.reason != Reason::kGoalUnseen && failure.reason != Reason::kOutsideMap &&
         failure.reason != Reason::kGoalKeptOut;
}

/// The goal itself is not free, and a place beside it may be.
bool isGoalTaken(const planning::PlanFailure& failure) {
  using Reason = planning::PlanFailure::Reason;
  return failure.reason == Reason::kGoalBlocked || failure.reason == Reason::kGoalUnseen ||
         failure.reason == Reason::kOutsideMap;
}

/// A point of the path where an obstacle may block it.
std::optional<Eigen::Vector2d> pointAhead(const std::vector<Eigen::Vector2d>& path_map_m) {
  constexpr double kAhead_m = 1.5;  // Farther than the vehicle brakes, near enough to be in sight.
  if (path_map_m.empty()) return std::nullopt;
  for (const Eigen::Vector2d& point : path_map_m)
    if ((point - path_map_m.front()).norm() > kAhead_m) return point;
  return path_map_m.back();
}

class GoTo final : public PathManeuver {
 public:
  GoTo(const common::GoToIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState& state) const override {
    Aim aim = PathManeuver::aim(state);
    aim.goal_map_m = intent_.goal_map_m;
    return aim;
  }

 private:
  /// Since when there has been no path, with the planner's last reason.
  struct NoPath {
    common::Time since;
    planning::PlanFailure failure;
  };

  std::string reached(const common::PlaceNames& names) const;
  bool looksAsAsked(const common::VehicleState& state) const;
  Progress fly(const ManeuverInput& input) override;
  void lookAlongBlockedPath();
  void tellLaserAlone(common::Time now, const planning::PlanFailure& failure);
  Progress waitFor(const planning::PlanFailure& failure, const std::optional<Blockage>& blockage, common::Time now);
  bool shiftsAtOnce() const { return intent_.shift_after_s <= 0.0; }
  /// After the goal has not been free for long enough, a free place beside it is accepted.
  void shiftWhenDue(common::Time now);
  bool isDue(common::Time now) const;
  bool givesUp(const ManeuverInput& input) const;
  /// Why there is no path, and who is in the way.
  std::string whyNot() const;

  common::GoToIntent intent_;
  Detour detour_;
  std::optional<NoPath> no_path_;
  Patience patience_;
  common::Hysteresis goal_taken_;               ///< The goal itself is not free.
  bool asked_shifted_ = false;                  ///< `shifted_` at the last request.
  bool shifted_;                                ///< Whether a free place beside the goal is accepted.
  bool sees_heights_ = false;                   ///< Whether there is a 3D map.
  Time asked_;                                  ///< When a path was last requested.
  Eigen::Vector2d place_map_m_;                 ///< The goal, or the free place that is flown to instead.
  std::optional<Eigen::Vector2d> ahead_map_m_;  ///< Of the last path to the goal, a little ahead of the vehicle.
};

GoTo::GoTo(const common::GoToIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "fly to a goal", intent.mode),
      intent_(intent),
      detour_(setup, flight_),
      shifted_(shiftsAtOnce()),
      place_map_m_(intent.goal_map_m) {
  if (intent.height_m) setup.memory.cruise_height_m = *intent.height_m;
  flight_.setGoalYaw(intent.yaw_map_rad);
}

bool GoTo::looksAsAsked(const common::VehicleState& state) const {
  // Three times the yaw's error in a hover, so that the wait for it ends.
  constexpr double kNear_rad = 3.0 * common::kRadPerDeg;
  if (!intent_.yaw_map_rad) return true;
  return std::abs(common::wrapAngle(state.T_map_body_planar().yaw_rad - *intent_.yaw_map_rad)) < kNear_rad;
}

std::string GoTo::reached(const common::PlaceNames& names) const {
  const double off_m = (place_map_m_ - intent_.goal_map_m).norm();
  if (intent_.goal_given_m && off_m > 0.0)
    return fmt::format("reached a place {:.2f} m beside {}, which is not free", off_m, placeOf(intent_));
  if (intent_.goal_given_m) return "reached " + placeOf(intent_);
  return "reached " + names.of(place_map_m_) +
         (off_m > 0.0 ? fmt::format(", {:.2f} m beside the goal, which is not free", off_m) : "");
}

Progress GoTo::fly(const ManeuverInput& input) {
  sees_heights_ = input.map3d != nullptr;
  if (flight_.arrived(input, place_map_m_, intent_.tolerance_m) && looksAsAsked(input.state)) {
    if (input.drift_m <= ManeuverInput::kKnown_m) return Progress::done(reached(input.names));
    return Progress::failed("whether it has reached " + input.names.of(place_map_m_) + " cannot be told");
  }
  if (!detour_.active() && flight_.plan()) ahead_map_m_ = pointAhead(flight_.remaining_map_m());
  const bool replan = flight_.keep(input);
  shiftWhenDue(input.now);
  if (no_path_ && givesUp(input)) return Progress::failed(whyNot());
  detour_.endWhenOver(input);
  lookAlongBlockedPath();
  if (!flight_.mayAsk()) return Progress::running();
  const auto& blockage = patience_.blockage();
  const auto blocked_map_m = blockage ? std::optional(blockage->place_map_m) : std::nullopt;
  if (no_path_ && mayPass(no_path_->failure) && detour_.due(no_path_->since, input.now, blocked_map_m)) {
    detour_.ask(input, intent_.goal_map_m, blocked_map_m);
  } else if (no_path_ ? isDue(input.now) : replan) {
    flight_.ask(input, GoalRequest{intent_.goal_map_m, intent_.tolerance_m, shifted_ ? intent_.shift_m : 0.0});
    asked_shifted_ = shifted_;
    asked_ = input.now;
  }
  return Progress::running();
}

void GoTo::shiftWhenDue(Time now) {
  if (shifted_ || !no_path_ || intent_.shift_m <= 0.0) return;
  const double after_s = mayPass(no_path_->failure) ? intent_.shift_after_s : kGrowing_s;
  shifted_ = goal_taken_.active_s(now) > after_s;
}

/// A map that does not reach the goal may be about to grow: that shows in no cell at the edge of what is reached, and
/// neither does what the camera sees at other heights.
bool GoTo::isDue(Time now) const {
  constexpr double kLooksEach_s = 0.5;
  const bool looks = sees_heights_ && (now - asked_).seconds() >= kLooksEach_s;
  return !mayPass(no_path_->failure) || looks || shifted_ != asked_shifted_ || patience_.due(now, setup_.desk.opened());
}

bool GoTo::givesUp(const ManeuverInput& input) const {
  if (mayPass(no_path_->failure)) return patience_.over(input.now, input.spare_s);
  // The second time for the answer about a place beside the goal.
  const double patience_s = shifted_ && !shiftsAtOnce() ? 2.0 * kGrowing_s : kGrowing_s;
  return (input.now - no_path_->since).seconds() > patience_s;
}

std::string GoTo::whyNot() const {
  const auto& blockage = patience_.blockage();
  return (blockage ? blockage->who + " is in the way: " : std::string()) + no_path_->failure.text;
}

/// A laser sees one plane: what blocks the path in it may be a beam with room for the hull below.
void GoTo::tellLaserAlone(Time now, const planning::PlanFailure& failure) {
  using Reason = planning::PlanFailure::Reason;
  const bool may_hang = failure.reason == Reason::kUnreachable || failure.reason == Reason::kGoalUnseen;
  if (sees_heights_ || !may_hang || std::exchange(setup_.memory.told_laser_alone, true)) return;
  setup_.memory.log.info(now, kFlightSource, "room below the obstacle on the path is unknown",
                         "without a camera there is no 3D map");
}

/// The laser does not see behind the vehicle: a vehicle that waits aside with its back to the blockage
/// would never see that the path is free.
void GoTo::lookAlongBlockedPath() {
  const bool waits = no_path_ && !flight_.plan();
  const auto& blockage = patience_.blockage();
  setup_.controller.lookAt(!waits ? std::nullopt : blockage ? std::optional(blockage->place_map_m) : ahead_map_m_);
}

Progress GoTo::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (answer.detour && no_path_) return detour_.begin(*answer.detour, "waiting: " + whyNot(), now, state);
  if (!answer.path) return Progress::running();
  if (!*answer.path) return waitFor(answer.path->error(), answer.blockage, now);
  no_path_.reset();
  patience_.reset();
  detour_.breakOff();
  const Eigen::Vector2d& end_map_m = (*answer.path)->points_map_m.back();
  // A place at the edge of the tolerance leaves the controller no tolerance: there the place is the goal.
  const bool beside = (end_map_m - intent_.goal_map_m).norm() > common::kShareOfTolerance * intent_.tolerance_m;
  place_map_m_ = beside ? end_map_m : intent_.goal_map_m;
  if (!beside) {
    goal_taken_.reset();
    shifted_ = shiftsAtOnce();
  }
  flight_.offer(**answer.path, now, state);
  return Progress::running("flying to " + placeOf(intent_, answer.cost_map->names()));
}

Progress GoTo::waitFor(const planning::PlanFailure& failure, const std::optional<Blockage>& blockage, Time now) {
  const bool begins = !no_path_;
  no_path_ = NoPath{begins ? now : no_path_->since, failure};
  patience_.failed(now, blockage);
  if (begins) {
    setup_.memory.log.warn(now, kFlightSource, "no path to the goal at present", whyNot());
    tellLaserAlone(now, failure);
  }
  // While a place beside the goal is accepted, another failure says nothing about the goal itself.
  if (const bool taken = isGoalTaken(failure); taken || !shifted_) goal_taken_.update(taken, now);
  return Progress::running("waiting: " + whyNot());
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::GoToIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<GoTo>(intent, setup);
}

}  // namespace swiftlet::autonomy
