// Follow: keeps a distance from a walking person, with the nose on the person, along the trail that the person walked;
// gives way where the person comes too near.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/geometry.hpp"
#include "common/hysteresis.hpp"
#include "common/segment.hpp"
#include "perception/people/dynamic_obstacles.hpp"
#include "perception/people/person_watch.hpp"
#include "planning/pursuit/pursuit_path.hpp"
#include "planning/pursuit/trail_path.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

/// A person without a track may stand where last seen for this long: while the vehicle tilts to accelerate or to brake,
/// beams pass above and below the heights in which people are tracked.
constexpr double kMayStand_s = 1.5;
/// Time between two paths.
constexpr double kReplan_s = 0.2;
/// A place to fly to that moved by less counts as unchanged.
constexpr double kReplan_m = 0.4;
/// A person who was not seen for longer is reported as out of sight.
constexpr double kLost_s = 3.0;
/// Tolerance of the place where a person is expected.
constexpr double kPersonTolerance_m = 0.5;
/// The vehicle has returned to a person when it was near for this long.
constexpr double kNear_s = 1.0;
/// The vehicle waits ahead for a person for this long; then it turns around at this yaw rate.
constexpr double kLooksAhead_s = 8.0, kLooksAround_deg_s = 25.0;
/// The vehicle gives way to a person who comes too near within this time.
constexpr double kGivesWay_s = 1.0;

// Constant time headway. The values are measured in flights (docs/decisions/following.md).
/// Behind a person who stands the distance is smaller than the wanted one by this, as the person may set off faster
/// than the vehicle.
constexpr double kStandsNearer_m = 0.3;
/// Behind a person who walks the distance is larger by the path that the person walks in this time, as the person may
/// stop faster than the vehicle.
constexpr double kHeadway_s = 0.6;
/// Speed over that of the person by the error of the distance.
constexpr double kGain_1_s = 1.8;

/// One thread.
///
///   looks for a walking person ----> follows --> lost: flies to where the person may be --> failed
///                                       ^----------- seen again -----------+
///   To return it first flies to where the last person was, and is done when it is near a person.
class Follow final : public PathManeuver {
 public:
  Follow(const common::FollowIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState& state) const override;

 private:
  void watch(const ManeuverInput& input) override;
  Progress fly(const ManeuverInput& input) override;
  void begin(common::Time now);
  double missed_s(const ManeuverInput& input, double distance_m);
  Progress search(const ManeuverInput& input);
  Progress progress(const ManeuverInput& input);
  /// Flies behind the person, or gives way.
  void pursue(const ManeuverInput& input);
  bool comesTooNear(const ManeuverInput& input) const;
  void giveWay(const ManeuverInput& input, const planning::CostMap& costs);
  void flyOrStay(const planning::Path& path, const ManeuverInput& input);
  bool flyAlongTrail(const ManeuverInput& input, const planning::CostMap& costs);
  double pace_m_s(const ManeuverInput& input) const;
  Eigen::Vector2d placeBehind() const;
  void flyTo(const ManeuverInput& input, const Eigen::Vector2d& target_map_m);

  common::FollowIntent intent_;
  std::shared_ptr<perception::PersonWatch> person_;  ///< Never null after the first watch().
  std::optional<Eigen::Vector2d> target_map_m_;
  std::optional<common::Time> since_;
  std::optional<double> since_yaw_rad_;   ///< The heading in `map` when it began to wait for a person.
  std::optional<common::Time> last_far_;  ///< When it was last too far from the person to see anybody there.
  common::Time asked_;
  bool on_trail_ = false;  ///< The plan leads along the trail.
  common::Hysteresis lost_, near_{kNear_s};
};

Follow::Follow(const common::FollowIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "follow a person", intent.mode), intent_(intent) {}

/// A person who was followed a moment ago is kept. To return, the last place of that person counts, or of the nearest
/// who was seen walking if nobody was followed.
void Follow::begin(Time now) {
  since_ = now;
  FlightMemory& memory = setup_.memory;
  const bool recent = memory.person && (now - memory.person_watched).seconds() <= intent_.lost_s;
  if (!recent || intent_.until_near) memory.person = std::make_shared<perception::PersonWatch>();
  person_ = memory.person;
  if (memory.person_map_m && intent_.until_near) person_->remember(*memory.person_map_m, now);
}

Aim Follow::aim(const common::VehicleState& state) const {
  Aim aim = PathManeuver::aim(state);
  aim.goal_map_m = target_map_m_;
  aim.person_map_m = setup_.memory.person_map_m;
  if (person_ && person_->known()) aim.left_out = person_.get();
  return aim;
}

void Follow::watch(const ManeuverInput& input) {
  if (!since_) begin(input.now);
  person_->choose(input.people, input.position_map_m());
  person_->update(input.people, {input.grid, input.seen}, input.now);
  setup_.memory.person_watched = input.now;
}

Progress Follow::fly(const ManeuverInput& input) {
  if (!person_->known()) return search(input);
  const Eigen::Vector2d place_map_m = person_->place_map_m(input.now);
  setup_.memory.person_map_m = place_map_m;
  setup_.controller.lookAt(place_map_m);
  (void)flight_.keep(input);
  if ((input.now - asked_).seconds() >= kReplan_s) pursue(input);
  if (on_trail_) flight_.setPace(pace_m_s(input));
  return progress(input);
}

Progress Follow::search(const ManeuverInput& input) {
  if (intent_.until_near) return Progress::failed("no person was followed or seen walking before");
  if ((input.now - *since_).seconds() > intent_.lost_s)
    return Progress::failed(fmt::format("no walking person within {:.0f} m for {:.0f} s",
                                        perception::DynamicObstacles::kMaxRange_m, intent_.lost_s));
  const double turned_rad = common::kRadPerDeg * kLooksAround_deg_s * ((input.now - *since_).seconds() - kLooksAhead_s);
  if (!since_yaw_rad_) since_yaw_rad_ = input.state.T_map_body_planar().yaw_rad;
  if (turned_rad > 0.0) {
    const double yaw_rad = *since_yaw_rad_ + turned_rad;
    setup_.controller.lookAt(input.position_map_m() + perception::DynamicObstacles::kMaxRange_m *
                                                          Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)));
  }
  return Progress::running("waits for a walking person");
}

/// How long the person was not seen although the vehicle was near enough: a return may begin far away.
double Follow::missed_s(const ManeuverInput& input, double distance_m) {
  const double unseen_s = person_->unseen_s(input.now);
  if (!intent_.until_near) return unseen_s;
  if (!last_far_ || distance_m > perception::DynamicObstacles::kMaxRange_m) last_far_ = input.now;
  return std::min(unseen_s, (input.now - *last_far_).seconds());
}

Progress Follow::progress(const ManeuverInput& input) {
  const double distance_m = (person_->place_map_m(input.now) - input.position_map_m()).norm();
  const double unseen_s = missed_s(input, distance_m);
  const common::Edge edge = lost_.update(unseen_s > kLost_s, input.now);
  if (edge == common::Edge::kEntered) setup_.memory.log.warn(input.now, kFlightSource, "the person is out of sight");
  if (edge == common::Edge::kLeft) setup_.memory.log.info(input.now, kFlightSource, "the person is seen again");
  if (intent_.until_near) {
    const bool near =
        distance_m < intent_.distance_m + kPersonTolerance_m && input.state.velocity_odom_m_s.norm() < 0.2;
    near_.update(near, input.now);
    if (near_.active()) return Progress::done(fmt::format("{:.1f} m from the person", distance_m));
  }
  if (unseen_s > intent_.lost_s) return Progress::failed(fmt::format("the person was not seen for {:.0f} s", unseen_s));
  if (lost_.active()) return Progress::running("looking for the person");
  return Progress::running(fmt::format("{}, {:.1f} m", intent_.until_near ? "returning" : "following", distance_m));
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
  return distance_m - kGivesWay_s * closing_m_s < intent_.distance_m - planning::kPursuitNearer_m;
}

void Follow::giveWay(const ManeuverInput& input, const planning::CostMap& costs) {
  on_trail_ = false;
  const std::vector<common::PossibleWalk> walks = person_->walks(input.now);
  const planning::PursuitPath pursuit =
      planning::pursuitPath({costs, *input.grid, input.position_map_m(), walks, person_->trail_map_m(),
                             intent_.distance_m, setup_.controller.follower().speed_m_s(intent_.mode)});
  flyOrStay(pursuit.path, input);
}

/// From the reference on, so that the path grows where the person walks and stays where it was behind the vehicle.
bool Follow::flyAlongTrail(const ManeuverInput& input, const planning::CostMap& costs) {
  const Eigen::Vector2d reference_odom_m = setup_.controller.follower().reference().position_odom_m.head<2>();
  const Eigen::Vector2d person_map_m = person_->place_map_m(input.now);
  const planning::Path path =
      planning::trailPath(costs, input.state.T_map_odom * reference_odom_m, person_map_m, person_->trail_map_m());
  if (path.points_map_m.size() == 1) {
    const double distance_m = (person_map_m - input.position_map_m()).norm();
    if (person_->hidden() || distance_m > intent_.distance_m + planning::kPursuitFarther_m) return false;
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
  const double along_m_s = person_->velocity_map_m_s().dot(to_person_m.normalized());
  const double standing_m = intent_.distance_m - kStandsNearer_m;
  if (!person_->hidden()) return along_m_s + kGain_1_s * (gap_m - standing_m - kHeadway_s * std::max(0.0, along_m_s));
  const double nearer_m_s = along_m_s + kGain_1_s * (gap_m - planning::kTrailEndsAt_m);
  if (person_->unseen_s(input.now) > kMayStand_s) return nearer_m_s;
  const double last_seen_m = (person_->trail_map_m().back() - input.position_map_m()).norm();
  return std::min(nearer_m_s, kGain_1_s * (last_seen_m - standing_m));
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
  const bool same = target_map_m_ && (target_map_m - *target_map_m_).norm() < kReplan_m;
  if ((under_way && same) || !flight_.mayAsk()) return;
  target_map_m_ = target_map_m;
  // Who has stood there since before the map was made is an obstacle in it.
  const double beside_m = intent_.until_near ? intent_.distance_m : 0.0;
  flight_.ask(input, GoalRequest{target_map_m, kPersonTolerance_m, beside_m}, person_.get());
}

Progress Follow::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || !*answer.path) return Progress::running();
  on_trail_ = false;
  flight_.release();
  flight_.offer(**answer.path, now, state);
  return Progress::running();
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::FollowIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Follow>(intent, setup);
}

}  // namespace swiftlet::autonomy
