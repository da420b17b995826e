#include "autonomy/maneuvers/follow.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/geometry.hpp"
#include "common/line_of_sight.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {
namespace {

/// Between two paths, and by how much the place to fly to moves meanwhile: each new path costs speed.
constexpr double kReplan_s = 0.3, kReplan_m = 0.4;
/// The place to fly to is that behind the person after this time: a path takes as long to begin and to end.
constexpr double kLead_s = 0.6;
/// Nearer to the wanted distance than this it stays where it is.
constexpr double kSlack_m = 0.2;
/// Unseen for longer he is lost, also if he is believed to stand still where he was; the vehicle goes to look.
constexpr double kLost_s = 3.0;
constexpr double kNear_s = 1.0;
/// Somebody who is to be followed stands in front. After this time the vehicle turns, for lasers do not see behind
/// themselves.
constexpr double kLooksAhead_s = 8.0, kLooksAround_rad_s = 25.0 * common::kRadPerDeg;
constexpr double kPersonTolerance_m = 0.5;
/// It flies behind him before a corner hides him: the place where he is after this time stays in sight.
constexpr double kInSight_s = 1.5;
/// What the map shows so near to him may be himself.
constexpr double kHimself_m = 0.4;

}  // namespace

using common::Time;

Follow::Follow(const common::FollowIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "follow a person", intent.mode), intent_(intent) {}

Progress Follow::fly(const ManeuverInput& input) {
  if (!since_) since_ = input.now;
  if (!person_.known() && setup_.memory.person_map_m && intent_.until_near)
    person_.remember(*setup_.memory.person_map_m, *since_);
  person_.choose(input.people, input.position_map_m(), HiddenPerson::kTracked_m);
  person_.update(input.people, {input.grid, input.seen}, input.now);
  if (!person_.known()) return search(input);
  const Eigen::Vector2d place_map_m = person_.place_map_m(input.now);
  setup_.memory.person_map_m = place_map_m;
  setup_.controller.lookAt(place_map_m);
  (void)flight_.keep(input);
  const auto target = wanted(input);
  const bool under_way = flight_.plan() != nullptr && !setup_.controller.pathFinished();
  const bool elsewhere = target && target_map_m_ && (*target - *target_map_m_).norm() > kReplan_m;
  if (target && (!under_way || elsewhere) && (input.now - asked_).seconds() >= kReplan_s) flyTo(input, *target);
  return progress(input);
}

Progress Follow::search(const ManeuverInput& input) {
  if (intent_.until_near) return Progress::failed("nobody was followed before");
  if ((input.now - *since_).seconds() > intent_.lost_s)
    return Progress::failed(
        fmt::format("nobody walks within {:.0f} m for {:.0f} s", HiddenPerson::kTracked_m, intent_.lost_s));
  const double turned_rad = kLooksAround_rad_s * ((input.now - *since_).seconds() - kLooksAhead_s);
  if (!since_yaw_rad_) since_yaw_rad_ = input.state.T_map_body_planar().yaw_rad;
  if (turned_rad > 0.0) {
    const double yaw_rad = *since_yaw_rad_ + turned_rad;
    setup_.controller.lookAt(input.position_map_m() +
                             HiddenPerson::kTracked_m * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)));
  }
  return Progress::running("waits for somebody who walks");
}

Progress Follow::progress(const ManeuverInput& input) {
  const double unseen_s = person_.unseen_s(input.now);
  const double distance_m = (person_.place_map_m(input.now) - input.position_map_m()).norm();
  if (unseen_s > kLost_s && !lost_)
    setup_.memory.say(input.now, common::Severity::kWarning, "the person is out of sight");
  if (unseen_s <= kLost_s && lost_) setup_.memory.say(input.now, common::Severity::kInfo, "the person is seen again");
  lost_ = unseen_s > kLost_s;
  if (intent_.until_near) {
    const bool near =
        distance_m < intent_.distance_m + kPersonTolerance_m && input.state.velocity_odom_m_s.norm() < 0.2;
    if (!near) near_since_.reset();
    if (near && !near_since_) near_since_ = input.now;
    if (near && (input.now - *near_since_).seconds() >= kNear_s)
      return Progress::done(fmt::format("{:.1f} m from the person", distance_m));
  }
  if (unseen_s > intent_.lost_s) return Progress::failed(fmt::format("the person was not seen for {:.0f} s", unseen_s));
  return Progress::running(lost_ ? "looking for the person" : fmt::format("following, {:.1f} m", distance_m));
}

std::optional<Eigen::Vector2d> Follow::wanted(const ManeuverInput& input) const {
  const Eigen::Vector2d here = input.position_map_m();
  const Eigen::Vector2d place = person_.place_map_m(input.now) + kLead_s * person_.velocity_map_m_s();
  const Eigen::Vector2d away = here - place;
  const auto map = setup_.desk.costMap();
  if (!map || away.norm() < 1e-3) return std::nullopt;
  // Flying to where he may be, the vehicle comes to see whether he is there.
  if (person_.hidden())
    return away.norm() > intent_.distance_m || segmentCost(*map, here, place).lethal ? std::optional(place)
                                                                                     : std::nullopt;
  const bool soon_hidden = !common::isInSight(
      *input.grid, here, person_.place_map_m(input.now) + kInSight_s * person_.velocity_map_m_s(), kHimself_m);
  if (!soon_hidden && std::abs(away.norm() - intent_.distance_m) < kSlack_m) return std::nullopt;
  const Eigen::Vector2d straight = place + intent_.distance_m * away.normalized();
  if (!soon_hidden && (!segmentCost(*map, here, straight).lethal || away.norm() < intent_.distance_m)) return straight;
  // The place on his way that is as far behind him along it.
  const auto& trail = person_.trail_map_m();
  double behind_m = 0.0;
  for (std::size_t i = trail.size(); i-- > 1;) {
    behind_m += (trail[i] - trail[i - 1]).norm();
    if (behind_m >= intent_.distance_m) return trail[i - 1];
  }
  return trail.front();
}

void Follow::flyTo(const ManeuverInput& input, const Eigen::Vector2d& target_map_m) {
  const auto map = setup_.desk.costMap();
  const Eigen::Vector2d here = input.position_map_m();
  const planning::SegmentCost leg = segmentCost(*map, here, target_map_m);
  if (!leg.lethal) {
    target_map_m_ = target_map_m;
    asked_ = input.now;
    flight_.release();
    flight_.offer({{here, target_map_m}, (target_map_m - here).norm(), leg.cost_m}, input.now, input.state);
  } else if (flight_.mayAsk()) {
    target_map_m_ = target_map_m;
    asked_ = input.now;
    flight_.ask(input, GoalRequest{target_map_m, kPersonTolerance_m});
  }
}

Progress Follow::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || !*answer.path) return Progress::running();
  flight_.release();
  flight_.offer(**answer.path, now, state);
  return Progress::running();
}

}  // namespace swiftlet::autonomy
