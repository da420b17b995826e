#include "autonomy/maneuvers/follow.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "autonomy/maneuvers/pursuit_path.hpp"
#include "autonomy/maneuvers/trail_path.hpp"
#include "autonomy/maneuvers/world_without_person.hpp"
#include "common/geometry.hpp"
#include "common/segment.hpp"

namespace swiftlet::autonomy {

using common::Time;

namespace {

/// A person without a track may stand where last seen for this long: while the vehicle tilts to accelerate or to brake,
/// beams pass above and below the heights in which people are tracked.
constexpr double kMayStand_s = 1.5;

}  // namespace

Follow::Follow(const common::FollowIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "follow a person", intent.mode), config_(setup.config.follow), intent_(intent) {}

/// A person who was followed a moment ago is kept. To return, the last place of that person counts.
void Follow::begin(Time now) {
  since_ = now;
  FollowMemory& memory = setup_.memory.follow;
  const bool recent = memory.person && (now - memory.watched).seconds() <= intent_.lost_s;
  if (!recent || intent_.until_near) memory.person = std::make_shared<PersonWatch>(config_.watch);
  person_ = memory.person;
  if (setup_.memory.person_map_m && intent_.until_near) person_->remember(*setup_.memory.person_map_m, now);
}

ManeuverInput Follow::planningInput(const ManeuverInput& input) const {
  if (!person_ || !person_->known()) return input;
  return worldWithoutPerson(
      input, *person_,
      {config_.watch.walking.half_width_m + input.grid->resolution_m(), config_.pursuit.mapped_within_m});
}

void Follow::watch(const ManeuverInput& input) {
  if (!since_) begin(input.now);
  person_->choose(input.people, input.position_map_m());
  person_->update(input.people, {input.grid, input.seen}, input.now);
  setup_.memory.follow.watched = input.now;
}

Progress Follow::fly(const ManeuverInput& input) {
  if (!person_->known()) return search(input);
  const Eigen::Vector2d place_map_m = person_->place_map_m(input.now);
  setup_.memory.person_map_m = place_map_m;
  setup_.controller.lookAt(place_map_m);
  (void)flight_.keep(input);
  if ((input.now - asked_).seconds() >= config_.replan_s) pursue(input);
  if (on_trail_) flight_.setPace(pace_m_s(input));
  return progress(input);
}

Progress Follow::search(const ManeuverInput& input) {
  if (intent_.until_near) return Progress::failed("nobody was followed before");
  if ((input.now - *since_).seconds() > intent_.lost_s)
    return Progress::failed(
        fmt::format("nobody walks within {:.0f} m for {:.0f} s", config_.watch.tracked_m, intent_.lost_s));
  const double turned_rad =
      common::kRadPerDeg * config_.looks_around_deg_s * ((input.now - *since_).seconds() - config_.looks_ahead_s);
  if (!since_yaw_rad_) since_yaw_rad_ = input.state.T_map_body_planar().yaw_rad;
  if (turned_rad > 0.0) {
    const double yaw_rad = *since_yaw_rad_ + turned_rad;
    setup_.controller.lookAt(input.position_map_m() +
                             config_.watch.tracked_m * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)));
  }
  return Progress::running("waits for somebody who walks");
}

Progress Follow::progress(const ManeuverInput& input) {
  const double unseen_s = person_->unseen_s(input.now);
  const double distance_m = (person_->place_map_m(input.now) - input.position_map_m()).norm();
  if (unseen_s > config_.lost_s && !lost_)
    setup_.memory.say(input.now, common::Severity::kWarning, "the person is out of sight");
  if (unseen_s <= config_.lost_s && lost_)
    setup_.memory.say(input.now, common::Severity::kInfo, "the person is seen again");
  lost_ = unseen_s > config_.lost_s;
  if (intent_.until_near) {
    const bool near =
        distance_m < intent_.distance_m + config_.tolerance_m && input.state.velocity_odom_m_s.norm() < 0.2;
    if (!near) near_since_.reset();
    if (near && !near_since_) near_since_ = input.now;
    if (near && (input.now - *near_since_).seconds() >= config_.near_s)
      return Progress::done(fmt::format("{:.1f} m from the person", distance_m));
  }
  if (unseen_s > intent_.lost_s) return Progress::failed(fmt::format("the person was not seen for {:.0f} s", unseen_s));
  return Progress::running(lost_ ? "looking for the person" : fmt::format("following, {:.1f} m", distance_m));
}

void Follow::pursue(const ManeuverInput& input) {
  const auto map = setup_.desk.costMap();
  if (!map) return;
  asked_ = input.now;
  if (comesTooNear(input)) return giveWay(input, *map);
  if (flyAlongTrail(input, *map)) return;
  flyTo(input, person_->hidden() ? person_->place_map_m(input.now) : placeBehind());
}

bool Follow::comesTooNear(const ManeuverInput& input) const {
  const Eigen::Vector2d offset_m = person_->place_map_m(input.now) - input.position_map_m();
  const double distance_m = offset_m.norm();
  if (distance_m < 1e-3) return true;
  const double closing_m_s = std::max(0.0, -person_->velocity_map_m_s().dot(offset_m) / distance_m);
  return distance_m - config_.pace.gives_way_s * closing_m_s < intent_.distance_m - config_.pursuit.nearer_m;
}

void Follow::giveWay(const ManeuverInput& input, const planning::CostMap& costs) {
  on_trail_ = false;
  const std::vector<PossibleWalk> walks = person_->walks(input.now);
  const PursuitPath pursuit = pursuitPath({costs, *input.grid, input.position_map_m(), walks, person_->trail_map_m(),
                                           intent_.distance_m, setup_.controller.follower().speed_m_s(intent_.mode),
                                           config_.pursuit, config_.watch.walking.half_width_m});
  flyOrStay(pursuit.path, input);
}

/// From the reference on, so that the path grows where the person walks and stays where it was behind the vehicle.
bool Follow::flyAlongTrail(const ManeuverInput& input, const planning::CostMap& costs) {
  const Eigen::Vector2d reference_odom_m = setup_.controller.follower().reference().position_odom_m.head<2>();
  const Eigen::Vector2d person_map_m = person_->place_map_m(input.now);
  const planning::Path path = trailPath({costs, input.state.T_map_odom * reference_odom_m, person_map_m,
                                         person_->trail_map_m(), config_.pace.ends_at_m, config_.pace.aside_m});
  if (path.points_map_m.size() == 1) {
    const double distance_m = (person_map_m - input.position_map_m()).norm();
    if (person_->hidden() || distance_m > intent_.distance_m + config_.pursuit.farther_m) return false;
  }
  on_trail_ = on_trail_ || path.points_map_m.size() > 1;
  flyOrStay(path, input);
  return true;
}

/// A path of one point is a hold.
void Follow::flyOrStay(const planning::Path& path, const ManeuverInput& input) {
  if (path.points_map_m.size() == 1) {
    if (flight_.plan() != nullptr && !setup_.controller.follower().finished()) flight_.abandon();
    target_map_m_.reset();
    return;
  }
  target_map_m_ = path.points_map_m.back();
  flight_.release();
  flight_.offer(path, input.now, input.state);
}

/// Constant time headway: the distance to be kept grows with the person's speed, by what it takes to stop behind a
/// person who stops.
double Follow::pace_m_s(const ManeuverInput& input) const {
  const std::vector<Eigen::Vector2d> rest_map_m = flight_.remaining_map_m();
  if (rest_map_m.empty()) return 0.0;
  const Eigen::Vector2d to_person_m = person_->place_map_m(input.now) - rest_map_m.back();
  const double gap_m = to_person_m.norm() + common::polylineLength(rest_map_m);
  const PaceConfig& pace = config_.pace;
  const double along_m_s = person_->velocity_map_m_s().dot(to_person_m.normalized());
  const double standing_m = intent_.distance_m - pace.stands_nearer_m;
  if (!person_->hidden())
    return along_m_s + pace.gain_1_s * (gap_m - standing_m - pace.headway_s * std::max(0.0, along_m_s));
  const double nearer_m_s = along_m_s + pace.gain_1_s * (gap_m - pace.ends_at_m);
  if (person_->unseen_s(input.now) > kMayStand_s) return nearer_m_s;
  const double last_seen_m = (person_->trail_map_m().back() - input.position_map_m()).norm();
  return std::min(nearer_m_s, pace.gain_1_s * (last_seen_m - standing_m));
}

/// The place on the person's trail that is the wanted distance behind the person, along the trail.
Eigen::Vector2d Follow::placeBehind() const {
  const auto& trail_map_m = person_->trail_map_m();
  double behind_m = 0.0;
  for (std::size_t i = trail_map_m.size(); i-- > 1;) {
    behind_m += (trail_map_m[i] - trail_map_m[i - 1]).norm();
    if (behind_m >= intent_.distance_m) return trail_map_m[i - 1];
  }
  return trail_map_m.front();
}

/// Along a planned path, unless one leads there.
void Follow::flyTo(const ManeuverInput& input, const Eigen::Vector2d& target_map_m) {
  const bool under_way = flight_.plan() != nullptr && !setup_.controller.follower().finished();
  const bool same = target_map_m_ && (target_map_m - *target_map_m_).norm() < config_.replan_m;
  if ((under_way && same) || !flight_.mayAsk()) return;
  target_map_m_ = target_map_m;
  flight_.ask(planningInput(input), GoalRequest{target_map_m, config_.tolerance_m});
}

Progress Follow::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || !*answer.path) return Progress::running();
  on_trail_ = false;
  flight_.release();
  flight_.offer(**answer.path, now, state);
  return Progress::running();
}

}  // namespace swiftlet::autonomy
