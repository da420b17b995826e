// FlyThrough: through a recognized opening by visual servoing (Tomic 2012, "Perception to Cognition": the position of
// the window tracker is continuously sent to the controller, and the vehicle slowly flies through the middle while the
// window is visible).
//
//   approaches: a planned path to the place before the opening, on its normal; turns to it
//        |  it is seen there, open
//        v
//   passes: along the axis through the tracked middle, laid anew whenever that moves --behind it--> done
//        |  before the hull is in the opening: not seen where it should be, seen closed, something stays in the way
//        v
//   returns: back along the axis to the place before it --> failed
//
// Near the wall the frame of the opening is out of the camera's picture; there the last axis is flown, and only the
// reactive layer and the progress tell whether the opening is still free.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "autonomy/maneuvers/path_maneuver.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "common/geometry.hpp"
#include "common/hysteresis.hpp"
#include "common/line_of_sight.hpp"

namespace swiftlet::autonomy {
namespace {

using common::RecognizedObject;
using common::Time;

/// Flies straight at 0.3 m/s and tilts by 2 deg at most, so that the camera stays on the opening.
constexpr common::FlightMode kThroughMode = common::FlightMode::kAccurate;
/// Greatest speed through the opening, whatever the mode allows: a stop then takes less than 0.3 m.
constexpr double kThroughSpeed_m_s = 0.4;
/// The place before the opening is reached when it is this near: what is left is corrected on the axis.
constexpr double kBeforeTolerance_m = 0.12;
/// It faces the opening: three times the yaw's error in a hover.
constexpr double kFaces_rad = 3.0 * common::kRadPerDeg;
/// The opening counts as seen for this long after a look: recognition runs at a few frames a second, and single frames
/// miss it.
constexpr double kSeenFor_s = 2.0;
/// It waits this long before the opening to see it.
constexpr double kWaitsToSee_s = 8.0;
/// A map that does not reach the place before it may be about to grow.
constexpr double kWaitsForPath_s = 5.0;
/// A change of the axis by less than this is the noise of the tracker.
constexpr double kSameAxis_m = 0.01, kSameAxis_rad = 0.5 * common::kRadPerDeg;
/// Behind the plane that was seen the wall goes on: walls of houses are up to this thick.
constexpr double kWallThickness_m = 0.35;
/// Off the axis by more than this share of the room beside the hull it waits before the wall until it is back.
constexpr double kShareOfRoom = 0.5;
/// Before the wall, from the hull to its plane, where it waits for that.
constexpr double kWaitsBefore_m = 0.35;
/// Something stays in the way when it has not got on by kGotOn_m within this time.
constexpr double kStuck_s = 6.0, kGotOn_m = 0.10;
/// Distances beside the wanted one that will do before and behind the opening, where the wanted one is not free.
constexpr std::array kOtherDistances = {1.0, 1.25, 0.8};
/// A middle whose height is known worse than this says less than the present height.
constexpr double kHeightSigma_m = 0.15;
/// Far enough for a point to be faced from everywhere on the axis with one heading.
constexpr double kFarAhead_m = 100.0;
/// The opening is seen whole, with this much of the wall at its sides.
constexpr double kWallBeside_m = 0.15;

/// The nearest of that name in the same place; null without one.
const RecognizedObject* inPlace(const common::ObjectsLayer* layer, const std::string& what,
                                const Eigen::Vector2d& place_map_m) {
  constexpr double kOnePlace_m = 0.3;  // As for the tracker: two openings are farther apart.
  const RecognizedObject* nearest = nullptr;
  double least_m = kOnePlace_m;
  if (layer == nullptr) return nearest;
  for (const RecognizedObject& one : layer->objects) {
    const double away_m = (one.T_map_object.position_m.head<2>() - place_map_m).norm();
    if (one.what != what || away_m > least_m) continue;
    nearest = &one;
    least_m = away_m;
  }
  return nearest;
}

/// A line through the middle of the opening, along its normal, in the direction of the flight.
struct PassageAxis {
  Eigen::Vector2d middle_map_m = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;

  Eigen::Vector2d direction() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
  /// At that distance beyond the wall; negative: before it.
  Eigen::Vector2d at(double beyond_m) const { return middle_map_m + beyond_m * direction(); }
  double beyond_m(const Eigen::Vector2d& place_map_m) const { return direction().dot(place_map_m - middle_map_m); }
  double aside_m(const Eigen::Vector2d& place_map_m) const {
    const Eigen::Vector2d off = place_map_m - middle_map_m;
    return std::abs(direction().x() * off.y() - direction().y() * off.x());
  }
};

class FlyThrough final : public PathManeuver {
 public:
  FlyThrough(const common::FlyThroughIntent& intent, const ManeuverSetup& setup);
  Progress answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState& state) const override;

 private:
  enum class Phase { kApproaches, kPasses, kReturns };

  Progress fly(const ManeuverInput& input) override;
  bool track(const RecognizedObject& opening, const ManeuverInput& input);
  bool isInside(const ManeuverInput& input) const;
  bool isSeen(const ManeuverInput& input) const { return (input.now - last_seen_).seconds() <= kSeenFor_s; }
  Progress approach(const ManeuverInput& input);
  Progress begin(const ManeuverInput& input);
  Progress pass(const ManeuverInput& input, bool moved);
  Progress goBack(const ManeuverInput& input);
  Progress turnBack(const ManeuverInput& input, std::string why);
  std::string whyBack(const ManeuverInput& input, double beyond_m);
  std::optional<double> freeDistance_m(const ManeuverInput& input, double wanted_m, double side) const;
  bool isKeptOut(const ManeuverInput& input) const;
  double blind_m() const;
  void lay(double from_m, double to_m);
  bool isStuck(const ManeuverInput& input);

  common::FlyThroughIntent intent_;
  Phase phase_ = Phase::kApproaches;
  PassageAxis axis_;
  double width_m_ = 0.0, height_m_ = 0.0;  ///< Of the opening; of the flight, over the take-off floor.
  double before_m_, behind_m_;             ///< Those of the intent, or others that are free.
  Time last_seen_;
  bool closed_ = false;
  std::string why_back_;
  std::optional<Time> no_path_since_, there_since_;  ///< To, and at, the place before the opening.
  struct GotOn {
    Time at;
    Eigen::Vector2d from_map_m;
  };
  std::optional<GotOn> got_on_;  ///< Where it last got on.
};

FlyThrough::FlyThrough(const common::FlyThroughIntent& intent, const ManeuverSetup& setup)
    : PathManeuver(setup, "fly through an opening", common::FlightMode::kCareful),
      intent_(intent),
      before_m_(intent.before_m),
      behind_m_(intent.behind_m) {}

/// True if the axis has moved.
bool FlyThrough::track(const RecognizedObject& opening, const ManeuverInput& input) {
  PassageAxis seen;
  seen.middle_map_m = opening.T_map_object.position_m.head<2>();
  const double normal_rad = common::yawOf(opening.T_map_object.rotation);
  // The normal points to where it was seen from, which is the side that the vehicle comes from or the other one.
  const bool along = std::cos(normal_rad - intent_.heading_rad) > 0.0;
  seen.heading_rad = common::wrapAngle(along ? normal_rad : normal_rad + std::numbers::pi);
  const bool first = width_m_ == 0.0;
  const bool moved = first || (seen.middle_map_m - axis_.middle_map_m).norm() > kSameAxis_m ||
                     std::abs(common::wrapAngle(seen.heading_rad - axis_.heading_rad)) > kSameAxis_rad;
  const bool knows_height = opening.covariance_m2(2, 2) < kHeightSigma_m * kHeightSigma_m;
  if (first || knows_height) {
    const double wanted_m =
        knows_height ? opening.T_map_object.position_m.z() : input.state.T_map_body().position_m.z();
    const double greatest_m = setup_.controller.maxHeight_m();
    height_m_ = std::clamp(wanted_m, std::min(common::kLeastFlightHeight_m, greatest_m), greatest_m);
  }
  if (moved) axis_ = seen;
  width_m_ = opening.size_m.x();
  last_seen_ = opening.last_seen;
  closed_ = opening.passage == common::Passage::kClosed;
  return moved;
}

Progress FlyThrough::fly(const ManeuverInput& input) {
  const RecognizedObject* opening = input.objects ? input.objects->withId(intent_.object_id) : nullptr;
  // Two tracks of one window are merged, and only one of their numbers is left.
  if (opening == nullptr && width_m_ > 0.0) opening = inPlace(input.objects.get(), intent_.what, axis_.middle_map_m);
  if (opening == nullptr && width_m_ == 0.0)
    return Progress::failed(fmt::format("no {} {} is known", intent_.what, intent_.object_id));
  const bool first = width_m_ == 0.0;
  const bool moved = opening != nullptr && track(*opening, input);
  if (first && isInside(input)) phase_ = Phase::kPasses;
  setup_.memory.cruise_height_m = height_m_;
  setup_.controller.lookAt(axis_.at(kFarAhead_m));
  switch (phase_) {
    case Phase::kApproaches:
      return approach(input);
    case Phase::kPasses:
      return pass(input, moved);
    case Phase::kReturns:
      return goBack(input);
  }
  return Progress::running();
}

/// In the opening, or between it and the place behind it: the flight through it was interrupted there.
bool FlyThrough::isInside(const ManeuverInput& input) const {
  const Eigen::Vector2d here = input.position_map_m();
  return axis_.beyond_m(here) > -setup_.desk.hullRadius_m() && axis_.beyond_m(here) < behind_m_ &&
         axis_.aside_m(here) < 0.5 * width_m_;
}

// ------------------------------------------------------------------------------------------------------------ approach

/// A free place on the axis near the wanted distance; `side` is 1 behind the wall and -1 before it.
std::optional<double> FlyThrough::freeDistance_m(const ManeuverInput& input, double wanted_m, double side) const {
  const auto cost_map = setup_.desk.costMap();
  if (!cost_map) return std::nullopt;
  const double least_m = setup_.desk.hullRadius_m() + intent_.clearance_m + (side > 0.0 ? kWallThickness_m : 0.0);
  for (const double share : kOtherDistances) {
    const double distance_m = std::max(least_m, share * wanted_m);
    const Eigen::Vector2d place_map_m = axis_.at(side * distance_m);
    if (!isLethalAt(*cost_map, place_map_m) && common::isInSight(*input.grid, axis_.middle_map_m, place_map_m, 0.0))
      return distance_m;
  }
  return std::nullopt;
}

Progress FlyThrough::approach(const ManeuverInput& input) {
  if (closed_) return Progress::failed("it is closed");
  if (const auto free_m = freeDistance_m(input, intent_.before_m, -1.0)) before_m_ = *free_m;
  const Eigen::Vector2d before_map_m = axis_.at(-before_m_);
  const bool replan = flight_.keep(input);
  const double off_rad = std::abs(common::wrapAngle(input.state.T_map_body_planar().yaw_rad - axis_.heading_rad));
  if (flight_.arrived(input, before_map_m, kBeforeTolerance_m) && off_rad < kFaces_rad) return begin(input);
  if (no_path_since_ && (input.now - *no_path_since_).seconds() > kWaitsForPath_s)
    return Progress::failed("no path to the place before it");
  if (replan && flight_.mayAsk()) {
    flight_.setGoalYaw(axis_.heading_rad);
    flight_.ask(input, GoalRequest{before_map_m, kBeforeTolerance_m, 0.0});
  }
  return Progress::running(fmt::format("flying to the place before {} {}", intent_.what, intent_.object_id));
}

Progress FlyThrough::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || phase_ != Phase::kApproaches) return Progress::running();
  if (!*answer.path) {
    if (!no_path_since_) no_path_since_ = now;
    return Progress::running("waiting: " + answer.path->error().text);
  }
  no_path_since_.reset();
  flight_.offer(**answer.path, now, state);
  return Progress::running();
}

/// The hull would enter a keep-out zone on its way.
bool FlyThrough::isKeptOut(const ManeuverInput& input) const {
  constexpr double kStep_m = 0.05;  // The hull is wider by far.
  if (!input.keep_out) return false;
  for (double beyond_m = -before_m_; beyond_m <= behind_m_; beyond_m += kStep_m)
    for (const common::Polygon& zone : *input.keep_out)
      if (zone.signedDistance_m(axis_.at(beyond_m)) < setup_.desk.hullRadius_m()) return true;
  return false;
}

/// At the place before the opening.
Progress FlyThrough::begin(const ManeuverInput& input) {
  if (!there_since_) there_since_ = input.now;
  if (!isSeen(input)) {
    if ((input.now - *there_since_).seconds() < kWaitsToSee_s) return Progress::running("waiting to see it");
    return Progress::failed("it is not seen from before it");
  }
  const double room_m = 0.5 * width_m_ - setup_.desk.hullRadius_m();
  if (room_m < intent_.clearance_m)
    return Progress::failed(fmt::format("it is {:.2f} m wide, too narrow for the hull of {:.2f} m", width_m_,
                                        2.0 * setup_.desk.hullRadius_m()));
  const auto free_m = freeDistance_m(input, intent_.behind_m, 1.0);
  if (!free_m) return Progress::failed("no place behind it is known to be free");
  behind_m_ = *free_m;
  if (isKeptOut(input)) return Progress::failed("a keep-out zone is in the way");
  phase_ = Phase::kPasses;
  got_on_.reset();
  setup_.memory.log.info(input.now, kFlightSource, fmt::format("flying through {} {}", intent_.what, intent_.object_id),
                         fmt::format("{:.2f} m wide, its middle at {} and {:.2f} m", width_m_,
                                     input.names.of(axis_.middle_map_m), height_m_));
  lay(-before_m_, behind_m_);
  return Progress::running("flying through");
}

// ------------------------------------------------------------------------------------------------------------- passing

void FlyThrough::lay(double from_m, double to_m) {
  control::FlightPath path;
  for (const double beyond_m : {from_m, to_m}) {
    const Eigen::Vector2d place = axis_.at(beyond_m);
    path.points_map_m.emplace_back(place.x(), place.y(), height_m_);
  }
  path.mode = kThroughMode;
  path.goal_yaw_map_rad = axis_.heading_rad;
  (void)setup_.controller.follow(path);
}

/// Nearer to the wall than this the opening is not in the picture with its sides, or nearer than the camera sees.
double FlyThrough::blind_m() const {
  if (setup_.camera == nullptr) return 0.0;
  const double half_rad = 0.5 * setup_.camera->field_of_view_deg * common::kRadPerDeg;
  const double whole_m = (0.5 * width_m_ + kWallBeside_m) / std::tan(half_rad);
  return setup_.camera->mount.x_m + std::max(whole_m, setup_.camera->range_min_m);
}

bool FlyThrough::isStuck(const ManeuverInput& input) {
  const Eigen::Vector2d here = input.position_map_m();
  if (!got_on_ || (here - got_on_->from_map_m).norm() > kGotOn_m) got_on_ = GotOn{input.now, here};
  return (input.now - got_on_->at).seconds() > kStuck_s;
}

/// Why it must not go on, before the hull is in the opening; empty if it may.
std::string FlyThrough::whyBack(const ManeuverInput& input, double beyond_m) {
  // Until the next look is due where it can be seen, and from the last one on where it cannot.
  const double blind_for_s = std::max(0.0, blind_m() + beyond_m) / setup_.controller.follower().speed_m_s(kThroughMode);
  if ((input.now - last_seen_).seconds() > kSeenFor_s + 2.0 * blind_for_s) return "it is no longer seen";
  if (closed_) return "it is closed";
  if (isStuck(input)) return "something is in the way";
  return {};
}

Progress FlyThrough::pass(const ManeuverInput& input, bool moved) {
  const Eigen::Vector2d here = input.position_map_m();
  const double beyond_m = axis_.beyond_m(here), hull_m = setup_.desk.hullRadius_m();
  const bool is_in = beyond_m > -hull_m;
  if (const std::string why = is_in ? "" : whyBack(input, beyond_m); !why.empty()) return turnBack(input, why);
  if (flight_.arrived(input, axis_.at(behind_m_), kBeforeTolerance_m))
    return Progress::done(fmt::format("{:.2f} m behind {} {}", beyond_m, intent_.what, intent_.object_id));
  // In the opening the axis stays: a look from there shows parts of it.
  if ((moved && !is_in) || !setup_.controller.follower().followsPath()) lay(-before_m_, behind_m_);
  const double room_m = 0.5 * width_m_ - hull_m;
  const bool waits =
      !is_in && beyond_m > -hull_m - kWaitsBefore_m && axis_.aside_m(here) > kShareOfRoom * std::max(0.0, room_m);
  setup_.controller.setPace(waits ? 0.0 : kThroughSpeed_m_s);
  return Progress::running(waits ? "waiting before it until it is on the axis" : "flying through");
}

Progress FlyThrough::turnBack(const ManeuverInput& input, std::string why) {
  phase_ = Phase::kReturns;
  why_back_ = std::move(why);
  got_on_.reset();
  setup_.memory.log.warn(input.now, kFlightSource,
                         fmt::format("turning back before {} {}", intent_.what, intent_.object_id), why_back_);
  setup_.controller.hold();
  return Progress::running("turning back: " + why_back_);
}

/// The opening may not be seen any more, so it returns along the axis that it came on.
Progress FlyThrough::goBack(const ManeuverInput& input) {
  const Eigen::Vector2d before_map_m = axis_.at(-before_m_);
  if (flight_.arrived(input, before_map_m, kBeforeTolerance_m) || isStuck(input)) return Progress::failed(why_back_);
  if (!setup_.controller.follower().followsPath() && setup_.controller.stopped())
    lay(axis_.beyond_m(input.position_map_m()), -before_m_);
  return Progress::running("turning back: " + why_back_);
}

Aim FlyThrough::aim(const common::VehicleState& state) const {
  Aim aim = PathManeuver::aim(state);
  if (width_m_ == 0.0) return aim;
  aim.goal_map_m = axis_.at(phase_ == Phase::kPasses ? behind_m_ : -before_m_);
  if (phase_ == Phase::kApproaches || !setup_.controller.follower().followsPath()) return aim;
  const double speed_m_s = std::min(kThroughSpeed_m_s, setup_.controller.follower().speed_m_s(kThroughMode));
  aim.velocity_map_m_s = (phase_ == Phase::kPasses ? speed_m_s : -speed_m_s) * axis_.direction();
  return aim;
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::FlyThroughIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<FlyThrough>(intent, setup);
}

}  // namespace swiftlet::autonomy
