#include "autonomy/commander.hpp"

#include <algorithm>
#include <utility>

#include "autonomy/autonomy_config.hpp"
#include "autonomy/flight_sensors.hpp"
#include "autonomy/navigator.hpp"
#include "autonomy/trail_back.hpp"
#include "behaviors/named_places.hpp"
#include "common/check.hpp"
#include "common/segment.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "control/actuation.hpp"
#include "control/flight_state_machine.hpp"
#include "planning/costs/landing_place.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::MissionState;
using common::Severity;
using common::Time;

namespace {

/// Of the missions that the operator starts in flight, as `fly` checks the first one.
behaviors::MissionLimits limitsOf(const AutonomyConfig& config, const AutonomySetup& setup, const MapShelf& maps) {
  return {.clearance_problems = [config](double clearance_m) { return config.problemsWith(clearance_m); },
          .max_height_m = setup.vehicle.max_height_m,
          .measured_height_m = measuredHeight_m(setup.laser),
          .least_measured_height_m = leastMeasuredHeight_m(setup.laser),
          .has_camera = setup.camera != nullptr && !setup.camera->isStereo(),
          .target_names = config.estimator.targets.names(),
          .has_map = setup.given != nullptr,
          .places = setup.places,
          .map_problem = [&maps](const std::string& map, const std::string&) -> std::optional<common::Problem> {
            const auto why = maps.problemOf(map);
            return why ? std::optional(common::Problem{{}, "", *why, ""}) : std::nullopt;
          }};
}

/// Why the vehicle had better come down where it is: no course is free of people, and the ground below is level. Empty
/// if it had not.
std::string peopleAllRound(const Percept& percept, const Navigator& navigator) {
  const std::string& why = navigator.avoidance().nothing_free;
  const auto map = navigator.executor().costMapHere();
  if (why.empty() || !map || !percept.state.horizontal_valid) return {};
  planning::LandingNeeds needs;
  needs.hull_radius_m = map->footprint().hull_radius_m;
  needs.reach_m = 2.0 * map->resolution_m();  // Where it is, by the cells of the map.
  const Eigen::Vector2d here_map_m = percept.state.T_map_body_planar().position_m();
  return planning::landingPlace(*map, percept.estimator->seenSurfaces(), here_map_m, needs) ? why : std::string();
}

bool isHome(const common::Intent& intent, const Eigen::Vector2d& home_map_m) {
  const auto* goal = std::get_if<common::GoToIntent>(&intent.kind);
  return goal != nullptr && (goal->goal_map_m - home_map_m).norm() < common::kHomeShift_m;
}

}  // namespace

Commander::Commander(const AutonomyConfig& config, AutonomySetup& setup, common::EventLog& log)
    : config_(config.supervisor),
      log_(log),
      vehicle_max_height_m_(setup.vehicle.max_height_m),
      supervisor_(config.supervisor, log),
      supervisor_intents_(config.execution.clearance_m),
      requests_(setup.vehicle.hullRadius_m(), setup.camera, log),
      missions_(std::move(setup.mission), limitsOf(config, setup, map_shelf_)),
      map_given_(setup.given != nullptr) {
  followMission();
}

/// Gives the mission's data to the rest of the autonomy; another mission may have replaced it.
void Commander::followMission() {
  const behaviors::Mission& mission = missions_.mission();
  decision_.max_height_m = mission.maxHeight_m().value_or(vehicle_max_height_m_);
  context_.goal_limits.greatest_height_m = decision_.max_height_m;
  status_.accepts_goals = mission.acceptsGoals();
  status_.name = mission.name();
}

// ----------------------------------------------------------------------------------------------------- the operator

void Commander::take(const common::OperatorCommand& asked, Time now, const common::World& world, Navigator& navigator) {
  common::OperatorCommand command = asked;
  const common::PlaceNames names = world.map->names();
  const auto answered = [&](common::CommandResult result) { answer(command, std::move(result), now, names); };
  std::string refusal = supervisor_.refusal(command);
  const bool lands = std::holds_alternative<common::LandCommand>(command.kind);
  const bool holds = std::holds_alternative<common::HoldCommand>(command.kind) ||
                     std::holds_alternative<common::ResumeCommand>(command.kind);
  const bool flies_home = supervisor_.supervision().home > 0 || supervisor_.supervision().hold;
  if (refusal.empty() && missionOver() && !lands && !(holds && flies_home)) refusal = "the mission has ended";
  if (refusal.empty()) refusal = resolvePlaces(command, world);
  if (!refusal.empty()) return answered({command.id, false, std::move(refusal)});
  if (auto result = takeMission(command, control::isAirborne(navigator.controller().state())))
    return answered(std::move(*result));
  if (const auto* other = std::get_if<common::ControllerCommand>(&command.kind)) {
    const auto switched = navigator.switchController(other->controller);
    return answered({command.id, switched.has_value(), switched ? std::string() : switched.error()});
  }
  if (auto result = supervisor_.take(command, now)) {
    const auto next = missions_.waitingCommand();
    if (result->accepted && next && std::holds_alternative<common::ResumeCommand>(command.kind))
      result->reason = "next: " + toString(*next, names);
    return answered(std::move(*result));
  }
  if (auto result = requests_.take(command, world)) return answered(std::move(*result));
  if (std::holds_alternative<common::HomeCommand>(command.kind)) {
    if (missions_.noneFollows()) return answered(supervisor_.goHome(command, AtHome::kWaitForMission));
    if (!missions_.mission().acceptsGoals()) return answered(supervisor_.goHome(command));
  }
  context_.commands.push_back(command);
}

/// Sets the places in `map` of places in the given map. Returns why one has none; empty if all have.
std::string Commander::resolvePlaces(common::OperatorCommand& command, const common::World& world) const {
  auto* goal = std::get_if<common::GoalCommand>(&command.kind);
  auto* zone = std::get_if<common::KeepOutCommand>(&command.kind);
  const bool goal_given = goal != nullptr && goal->goal_given_m;
  const bool zone_given = zone != nullptr && !zone->corners_given_m.empty();
  if (!goal_given && !zone_given) return {};
  const auto places = behaviors::NamedPlaces::in(world);
  if (!places) return places.error();
  if (!places->given()) return "the flight was given no map";
  if (goal_given) goal->goal_map_m = places->inMap_m(*goal->goal_given_m);
  if (!zone_given) return {};
  zone->area.corners_map_m.clear();
  for (const Eigen::Vector2d& corner_given_m : zone->corners_given_m)
    zone->area.corners_map_m.push_back(places->inMap_m(corner_given_m));
  return {};
}

/// The maps of a mission that is refused are not kept.
std::optional<common::CommandResult> Commander::takeMission(const common::OperatorCommand& command, bool airborne) {
  const auto* mission = std::get_if<common::StartMissionCommand>(&command.kind);
  if (mission == nullptr) {
    auto result = missions_.take(command);
    if (result && result->accepted && !airborne)
      result->reason = "the vehicle stays on the ground until a mission is started";
    return result;
  }
  const MapShelf before = map_shelf_;
  map_shelf_.offer(mission->maps);
  auto result = missions_.take(command);
  if (!result->accepted)
    map_shelf_ = before;
  else if (const std::string hold = supervisor_.holdReason(); !hold.empty())
    result->reason += (result->reason.empty() ? "" : ", ") + behaviors::flownAfterHold(hold);
  return result;
}

/// Every command leaves an event, whether it was accepted or refused.
void Commander::answer(const common::OperatorCommand& command, common::CommandResult result, Time now,
                       const common::PlaceNames& names) {
  log_.add({now, result.accepted ? Severity::kInfo : Severity::kWarning, "operator",
            toString(command, names) + (result.accepted ? " accepted" : " refused"), result.reason});
  results_.push_back(std::move(result));
}

void Commander::pilotArrived(const common::PilotSample& sample) {
  supervisor_.pilotArrived(sample.stamps.arrived, sample.takes_over);
}

// --------------------------------------------------------------------------------------------------------- the tick

/// The flight home ends above the thrust at which the vehicle has to land where it is, by what a tilt needs.
common::EnergyLayer Commander::energy(const Percept& percept, const Navigator& navigator,
                                      const common::World* last) const {
  FlightHome home{navigator.executor().desk().home_m(), 0.0, navigator.controller().landing_s()};
  if (last != nullptr && !home.planned_m)
    home.trail_m = common::polylineLength(trailBackWithoutLoops(last->vehicle->trail.points_map_m()));
  return percept.consumption->layer(percept.now, home, navigator.controller().thrust().margin(),
                                    config_.battery_land_share, control::kKeptForHeight + config_.least_thrust_margin);
}

const Decision& Commander::decide(const Percept& percept, const std::shared_ptr<const common::World>& world,
                                  const Navigator& navigator) {
  hear(percept, navigator);
  decision_.given_map.clear();
  if (percept.around) {
    context_.world = world;
    context_.now = percept.now;
    if (navigator.prepared()) decision_.intent = nextIntent(percept, navigator);
    decision_.take_off_refusal = supervisor_.supervision().take_off_refusal;
  }
  decision_.mission_over = missionOver();
  if (world && world->energy) decision_.spare_s = spareTime_s(*world->energy, config_);
  decision_.pilot_flies = supervisor_.pilotFlies();
  decision_.unseen = supervisor_.supervision().unseen;
  return decision_;
}

/// In the open no beam returns. Between walls that is a laser which has gone blind.
void Commander::hear(const Percept& percept, const Navigator& navigator) {
  for (const SeenFrame& seen : percept.frames) requests_.addFrame(seen.frame, seen.state);
  for (const SeenScan& seen : percept.scans) {
    const auto& counts = seen.outcome.scan.counts;
    if (counts.hits > 0 || (counts.no_returns > 0 && !navigator.knowsWallsAround(seen.state)))
      supervisor_.surroundingsSeen(percept.now);
  }
}

common::Intent Commander::nextIntent(const Percept& percept, const Navigator& navigator) {
  const Supervision& supervision = supervisor_.tick(percept.now, condition(percept, navigator));
  fillContext(supervision, navigator);
  if (const auto wanted_to_see = navigator.executor().aim().wants_to_see_map_m)
    supervisor_intents_.remember(*wanted_to_see);
  else if (!supervision.hold)
    supervisor_intents_.forget();
  common::Intent intent = chooseIntent(supervision, navigator);
  tellWhoFlies(supervision, intent, navigator);
  return intent;
}

VehicleCondition Commander::condition(const Percept& percept, const Navigator& navigator) const {
  VehicleCondition condition;
  condition.flight = navigator.controller().state();
  condition.lands = std::holds_alternative<common::LandIntent>(decision_.intent.kind);
  condition.goes_home = isHome(decision_.intent, context_.world->vehicle->home_map.position_m());
  condition.energy = *context_.world->energy;
  condition.gauge_fault = percept.consumption->gaugeFault(percept.now);
  const common::VehicleState& state = percept.state;
  condition.vertical_age_s = state.verticalAge_s(percept.now);
  const double age_s = std::max(state.horizontalAge_s(percept.now), condition.vertical_age_s);
  condition.position_measured = state.horizontal_valid && state.vertical_valid && age_s < kUnseenHold_s;
  condition.sensor_lies = percept.must_land;
  condition.people_all_round = peopleAllRound(percept, navigator);
  condition.drift_m = percept.drift_m;
  if (percept.drift_m > kDriftLand_m) condition.walls_around = navigator.executor().desk().wallsAround(state);
  return condition;
}

void Commander::fillContext(const Supervision& supervision, const Navigator& navigator) {
  context_.goal_map = navigator.executor().desk().goalMap();
  context_.status = navigator.executor().status();
  context_.hold = supervision.hold;
  context_.hold_reason = supervision.hold_reason;
}

/// The supervisor's intent comes before the mission's.
common::Intent Commander::chooseIntent(const Supervision& supervision, const Navigator& navigator) {
  const bool airborne = control::isAirborne(navigator.controller().state());
  if (supervision.land) {
    endMission(supervision.land_reason);
    return SupervisorIntents::land();
  }
  if (!missionOver()) tickMission(navigator);
  if (!airborne && !missionOver())
    return waitsToTakeOff(supervision) ? SupervisorIntents::hold() : context_.intent.value_or(common::Intent{});
  if (missionOver() && (!airborne || !supervisor_.sentHome())) return SupervisorIntents::land();
  const SupervisedFlight flight{context_.now, *context_.world, decision_.intent, navigator.executor().status(),
                                navigator.executor().desk().home_m().has_value()};
  if (auto intent = supervisor_intents_.flight(supervision, flight, supervisor_)) return *intent;
  if (missionOver() || missions_.waits() || (supervision.hold && status_.state != MissionState::kHeld))
    return SupervisorIntents::hold();
  return context_.intent.value_or(common::Intent{});
}

/// A hold keeps the vehicle on the ground whatever the mission does; TakeOff continues when it ends.
bool Commander::waitsToTakeOff(const Supervision& supervision) const {
  return supervision.hold && context_.intent && std::holds_alternative<common::TakeOffIntent>(context_.intent->kind);
}

/// Reports what controls the vehicle before the waiting mission: the controller's own landing, then the supervisor.
void Commander::tellWhoFlies(const Supervision& supervision, const common::Intent& intent, const Navigator& navigator) {
  const FlightState flight = navigator.controller().state();
  status_.flown_by = supervision.flown_by;
  if (supervision.land || (missionOver() && supervision.home == 0)) return;
  const bool asked = std::holds_alternative<common::LandIntent>(intent.kind) ||
                     std::holds_alternative<common::EmergencyLandIntent>(intent.kind);
  const bool lands = !asked && (flight == FlightState::kLanding || flight == FlightState::kEmergencyLanding);
  const bool flies = supervision.back > 0 || supervision.home > 0;
  const bool holds = supervision.hold && status_.state != MissionState::kHeld &&
                     (control::isAirborne(flight) || waitsToTakeOff(supervision));
  if (lands) status_.flown_by = common::FlownBy::kSupervisor;
  if (!lands && !flies && !holds) return;
  status_.phase = lands ? toString(flight) : phaseOf(supervision);
  status_.reason = lands ? navigator.controller().groundedReason() : supervision.hold_reason;
}

// ------------------------------------------------------------------------------------------------------ the mission

/// The supervisor lands the vehicle, which ends the mission. The mission may need several ticks to release control.
void Commander::endMission(const std::string& reason) {
  if (!missionOver()) {
    status_.state = supervisor_.landedByOperator() ? MissionState::kStopped : MissionState::kFailed;
    status_.reason = "landed: " + reason;
    status_.phase = "land";
    releasing_mission_ = true;
  }
  for (const auto& command : std::exchange(context_.commands, {}))
    answer(command, {command.id, false, "the vehicle is landing: " + reason}, context_.now,
           context_.world->map->names());
  if (releasing_mission_) releasing_mission_ = !missions_.mission().letGo(context_);
  for (common::Event& event : std::exchange(context_.events, {})) log_.add(std::move(event));
}

void Commander::tickMission(const Navigator& navigator) {
  context_.intent.reset();
  context_.answers = requests_.takeAnswers(context_.now);
  const std::vector<common::OperatorCommand> asked = context_.commands;
  const behaviors::TickResult result = missions_.tick(context_);
  for (const common::MissionRequest& request : std::exchange(context_.requests, {})) carryOut(request);
  for (common::Event& event : std::exchange(context_.events, {})) log_.add(std::move(event));
  std::vector<common::CommandResult> answers = std::exchange(context_.results, {});
  SWIFTLET_CHECK(answers.size() == asked.size(), answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i)
    answer(asked[i], std::move(answers[i]), context_.now, context_.world->map->names());
  followMission();
  status_.state = result.state;
  status_.phase = result.phase;
  status_.reason = result.reason;
  status_.question = missions_.mission().question();
  if (result.state != MissionState::kFailed) return;
  // Where no path is known, home is where the vehicle has just failed to get.
  const FlightState flight = navigator.controller().state();
  const bool knows_home = navigator.executor().desk().home_m().has_value();
  if (flight == FlightState::kFlying && knows_home && missions_.mission().fliesHomeOnFailure())
    supervisor_.missionFailed(context_.now, result.reason);
  else if (control::isAirborne(flight))
    log_.warn(context_.now, "mission", "the mission has failed: the vehicle lands", result.reason,
              common::Concern::kLanding);
}

void Commander::carryOut(const common::MissionRequest& request) {
  auto order = map_shelf_.take(request, map_given_);
  if (!order) return requests_.take(request, *context_.world);
  if (order->order) decision_.given_map.push_back(*order->order);
  if (order->order && order->order->load != nullptr) map_given_ = true;
  if (map_given_) missions_.mapIsGiven();
  requests_.answered(std::move(order->answer), context_.now);
}

/// While the mission holds, it shows what it flies to afterwards, unless something else is flown to.
common::MissionLayer Commander::missionLayer(const common::World* last) const {
  common::MissionLayer layer;
  layer.status = status_;
  layer.status.tree = missions_.mission().view();
  const auto command = missions_.waitingCommand();
  if (last == nullptr || status_.state != MissionState::kHeld || !command) return layer;
  layer.waiting = toString(*command, last->map->names());
  const auto* goal = std::get_if<common::GoalCommand>(&command->kind);
  layer.goal_map_m = goal != nullptr ? goal->goal_map_m : last->vehicle->home_map.position_m();
  return layer;
}

}  // namespace swiftlet::autonomy
