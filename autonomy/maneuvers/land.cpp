// Land: done when the vehicle stands on the ground. In the air it cannot fail.
//
//   stop --> look beyond --> choose a place --> fly there --> descend
//    |                        |     ^               |      ^ or where it is, if it does not get there
//    |                        |     +---------------+      | in time
//    |                        |      an edge was seen      |
//    |                        |      on the way            |
//    |                        |  none, or no position      |
//    |                        +----------------------------+
//    +--> over a landing pattern that is seen: fly over its middle and down on it --^
//
// The place is the nearest one where the hull stands on one level, clear of the edges of tables and steps
// (planning/costs/landing_place.hpp). The beams that look down have seen only the trail: where it ends, the vehicle
// first flies a hull's width on to see whether the floor goes on there too.
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "autonomy/maneuvers/path_flight.hpp"
#include "autonomy/maneuvers/pattern_descent.hpp"
#include "autonomy/maneuvers/table.hpp"
#include "planning/costs/landing_place.hpp"

namespace swiftlet::autonomy {
namespace {

using common::FlightState;
using common::Time;

constexpr double kStopping_s = 1.5;  ///< From the greatest speed to a hover, with what then settles.
/// Nearer than this the place is reached: the margin of the place is larger.
constexpr double kTolerance_m = 0.08;
/// This near to where it took off the vehicle lands there: what it stood on carries it, level or not.
constexpr double kTakeOffPlace_m = 0.5;
/// Time for the flight of at most LandingNeeds::reach_m at careful speed, a plan and an arrival.
constexpr double kApproach_s = 15.0;

planning::LandingNeeds needsOf(const planning::CostMap& map) {
  planning::LandingNeeds needs;
  needs.hull_radius_m = map.footprint().hull_radius_m;
  return needs;
}

class Land final : public Maneuver {
 public:
  Land(const common::LandIntent& intent, const ManeuverSetup& setup);
  Progress step(const ManeuverInput& input) override;
  Progress answered(const PlanningAnswer& answer, common::Time now, const common::VehicleState& state) override;
  Aim aim(const common::VehicleState&) const override {
    Aim aim = flight_.aim();
    aim.goal_map_m = pattern_ ? pattern_->middle_map_m() : place_map_m_;
    return aim;
  }

 private:
  enum class Phase { kStops, kOverPattern, kLooksBeyond, kFliesThere, kDescends };

  Progress onGround(const ManeuverInput& input) const;
  void begin(const ManeuverInput& input);
  void choose(const ManeuverInput& input, const Eigen::Vector2d& from_map_m);
  void approach(const ManeuverInput& input);
  Progress flyOverPattern(const ManeuverInput& input);
  void descend(common::Time now, const std::string& reason);

  ManeuverSetup setup_;
  PathFlight flight_;
  tl::expected<void, std::string> commanded_;
  Phase phase_ = Phase::kStops;
  std::optional<common::Time> since_;                     ///< When the landing began.
  Eigen::Vector2d here_map_m_ = Eigen::Vector2d::Zero();  ///< Where it stopped to land; not in Phase::kStops.
  std::optional<Eigen::Vector2d> place_map_m_;            ///< Where it flies to; nullopt before it is chosen.
  std::optional<PatternDescent> pattern_;                 ///< nullopt where no landing pattern is seen.
  std::string no_path_;                                   ///< Why there is no path to the place; empty if it has one.
};

Land::Land(const common::LandIntent&, const ManeuverSetup& setup)
    : setup_(setup), flight_(setup, common::FlightMode::kCareful) {}

Progress Land::step(const ManeuverInput& input) {
  if (!since_) since_ = input.now;
  if (!control::isAirborne(setup_.controller.state())) return onGround(input);
  if (setup_.controller.state() != FlightState::kFlying) {
    if (phase_ != Phase::kDescends) descend(input.now, {});
  } else {
    if (phase_ == Phase::kStops) begin(input);
    if (phase_ == Phase::kOverPattern) return flyOverPattern(input);
    if (phase_ == Phase::kLooksBeyond || phase_ == Phase::kFliesThere) approach(input);
  }
  return commanded_ ? Progress::running() : Progress::failed(commanded_.error());
}

/// A landing is a success only at a place that is known.
Progress Land::onGround(const ManeuverInput& input) const {
  if (input.drift_m > ManeuverInput::kKnown_m)
    return Progress::failed(fmt::format("on the ground, at a place that is uncertain by {:.1f} m", input.drift_m));
  if (!pattern_) return Progress::done("on the ground");
  return Progress::done(
      fmt::format("on the ground, {:.2f} m off the middle of `{}`", pattern_->off_m(input), pattern_->name()));
}

/// Where the vehicle stops it looks for a place. Without a position it lands where it is.
void Land::begin(const ManeuverInput& input) {
  const auto cost_map = setup_.desk.costMap();
  const auto pattern = input.state.horizontal_valid ? PatternDescent::below(input) : std::nullopt;
  const bool knows = input.state.horizontal_valid && input.surfaces && !input.surfaces->levels.empty() && cost_map;
  if ((!knows && !pattern) || setup_.retreat.active()) return descend(input.now, {});
  if (!setup_.controller.stopped() && (input.now - *since_).seconds() < kStopping_s) return;

  here_map_m_ = input.position_map_m();
  if (pattern) {
    pattern_.emplace(*pattern);
    phase_ = Phase::kOverPattern;
    return;
  }
  if (const auto& stood_map_m = setup_.memory.stood_map_m;
      stood_map_m && (*stood_map_m - here_map_m_).norm() < kTakeOffPlace_m && !isLethalAt(*cost_map, *stood_map_m)) {
    place_map_m_ = stood_map_m;
    phase_ = Phase::kFliesThere;
    return;
  }
  place_map_m_ = planning::placeToLookFrom(*cost_map, *input.surfaces, here_map_m_, needsOf(*cost_map));
  if (place_map_m_)
    phase_ = Phase::kLooksBeyond;
  else
    choose(input, here_map_m_);
}

/// Without a position, or kept off by a retreat or the wind, it lands where it is.
Progress Land::flyOverPattern(const ManeuverInput& input) {
  const bool may_fly = input.state.horizontal_valid && !setup_.retreat.active();
  const auto status = may_fly ? pattern_->step(input, setup_.controller) : PatternDescent::Status::kKeptOff;
  if (status == PatternDescent::Status::kFlies)
    return Progress::running(
        fmt::format("landing on `{}`, {:.2f} m off its middle", pattern_->name(), pattern_->off_m(input)));
  const bool kept_off = status == PatternDescent::Status::kKeptOff;
  descend(input.now, kept_off ? "it was kept off the middle of `" + pattern_->name() + "`" : "");
  return commanded_ ? Progress::running("descending") : Progress::failed(commanded_.error());
}

void Land::choose(const ManeuverInput& input, const Eigen::Vector2d& from_map_m) {
  const auto cost_map = setup_.desk.costMap();
  if (!cost_map || !input.surfaces) return descend(input.now, {});
  const planning::LandingNeeds needs = needsOf(*cost_map);
  no_path_.clear();
  place_map_m_ = planning::landingPlace(*cost_map, *input.surfaces, from_map_m, needs);
  if (!place_map_m_)
    return descend(input.now, fmt::format("no level place for the hull is known within {:.0f} m", needs.reach_m));
  phase_ = Phase::kFliesThere;
  const double distance_m = (*place_map_m_ - from_map_m).norm();
  if (distance_m > kTolerance_m)
    setup_.memory.log.info(input.now, kFlightSource, "landing at " + input.names.of(*place_map_m_),
                           fmt::format("the surface here is not level, {:.1f} m aside it is", distance_m));
}

/// A place to look from need not be reached; what is seen on the way counts, too.
void Land::approach(const ManeuverInput& input) {
  const bool there = (*place_map_m_ - input.position_map_m()).norm() < kTolerance_m && setup_.controller.stopped();
  const bool late = (input.now - *since_).seconds() > kApproach_s;
  if (phase_ == Phase::kLooksBeyond && (there || late || !no_path_.empty())) return choose(input, here_map_m_);
  if (there) {  // The edge of a table that was first seen on the way may be nearer than the place allows.
    const Eigen::Vector2d reached_map_m = *place_map_m_;
    const bool took_off_here = reached_map_m == setup_.memory.stood_map_m;
    if (!took_off_here && !late) choose(input, reached_map_m);
    if (phase_ == Phase::kFliesThere && *place_map_m_ == reached_map_m) descend(input.now, {});
    return;
  }
  // While a person passes there is no path; a moment later there is one.
  if (late || !input.state.horizontal_valid)
    return descend(input.now, "the level place was not reached" + (no_path_.empty() ? "" : ": " + no_path_));
  if (!setup_.retreat.active() && flight_.keep(input) && flight_.mayAsk())
    flight_.ask(input, GoalRequest{*place_map_m_, kTolerance_m});
}

Progress Land::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || phase_ == Phase::kDescends) return Progress::running();
  no_path_ = *answer.path ? "" : answer.path->error().text;
  if (*answer.path) flight_.offer(**answer.path, now, state);
  return Progress::running();
}

/// Lands where the vehicle is; `reason` says why not at a better place.
void Land::descend(Time now, const std::string& reason) {
  phase_ = Phase::kDescends;
  if (!reason.empty()) setup_.memory.log.warn(now, kFlightSource, "landing where it is", reason);
  if (setup_.controller.state() != FlightState::kLanding && setup_.controller.state() != FlightState::kEmergencyLanding)
    commanded_ = setup_.controller.command(control::Land{});
}

}  // namespace

std::unique_ptr<Maneuver> maneuverFor(const common::LandIntent& intent, const ManeuverSetup& setup) {
  return std::make_unique<Land>(intent, setup);
}

}  // namespace swiftlet::autonomy
