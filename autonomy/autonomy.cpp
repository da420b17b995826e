#include "autonomy/autonomy.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/flight_sensors.hpp"
#include "common/check.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::MissionState;
using common::Time;

namespace {
/// Nearer to the end of a path the vehicle brakes, so its speed there tells nothing of a long path. The shipped
/// profiles brake within v^2 / (2 a) = 0.33 m; the rest is margin for faster ones.
constexpr double kFarFromGoal_m = 1.0;

/// The reactive layer acts on what is near: at 1.5 m/s and 1 m/s^2 the vehicle stops within 1.1 m, and the hull is 0.3
/// m.
constexpr double kNear_m = 2.0;

/// Of the missions that the operator starts in flight, as `fly` checks the first one.
behaviors::MissionLimits limitsOf(const AutonomyConfig& config, const AutonomySetup& setup, const MapShelf& maps) {
  return {.clearance_problems = [config](double clearance_m) { return config.problemsWith(clearance_m); },
          .max_height_m = setup.vehicle.max_height_m,
          .measured_height_m = measuredHeight_m(setup.laser),
          .least_measured_height_m = leastMeasuredHeight_m(setup.laser),
          .has_camera = setup.camera != nullptr,
          .target_names = config.estimator.targets.names(),
          .has_map = setup.given != nullptr,
          .map_problem = [&maps](const std::string& map, const std::string&) -> std::optional<common::Problem> {
            const std::string why = maps.problemOf(map);
            return why.empty() ? std::nullopt : std::optional(common::Problem{{}, "", why, ""});
          }};
}

}  // namespace

Autonomy::Autonomy(AutonomySetup setup)
    : config_(setup.config),
      vehicle_(setup.vehicle),
      vehicle_name_(std::move(setup.vehicle_name)),
      camera_(setup.camera != nullptr ? std::optional(*setup.camera) : std::nullopt),
      estimator_(config_.estimator, setup.laser, vehicle_, setup.given, *setup.jobs, setup.camera,
                 setup.vertical_laser),
      reactive_(config_.reactive, vehicle_.hullRadius_m()),
      controller_(config_.control, vehicle_, setup.model),
      executor_(config_.execution, vehicle_, config_.estimator.slam.grid.resolution_m, controller_, *setup.jobs,
                camera_ ? &*camera_ : nullptr),
      supervisor_(config_.supervisor),
      supervisor_intents_(config_.execution.clearance_m),
      requests_(vehicle_.hullRadius_m(), setup.camera),
      missions_(std::move(setup.mission), limitsOf(config_, setup, map_shelf_)),
      jobs_(std::move(setup.jobs)),
      scans_(config_.scans, 1.0 / setup.laser.rate_hz),
      inertial_(config_.inertial, config_.control.position.attitude_lag_s),
      given_map_(setup.given),
      camera_obstacles_(vehicle_.hull_height_m),
      lower_obstacles_(vehicle_.hull_height_m),
      assist_(config_.assist, vehicle_.max_tilt_deg, config_.reactive.avoidance),
      energy_monitor_(config_.energy, vehicle_, config_.control.position.thrust.table.voltage_exponent),
      world_builder_(vehicle_name_) {
  if (setup.memory != nullptr) controller_.recallThrust(setup.memory->thrust);
  followMission();
  takeSnapshot(Time{});
}

Autonomy::~Autonomy() = default;

/// What the rest of the autonomy knows of the mission; another one may have taken its place.
void Autonomy::followMission() {
  const behaviors::Mission& mission = missions_.mission();
  const double max_height_m = mission.maxHeight_m().value_or(vehicle_.max_height_m);
  context_.goal_limits.greatest_height_m = max_height_m;
  controller_.setMaxHeight(max_height_m);
  mission_status_.accepts_goals = mission.acceptsGoals();
  mission_status_.name = mission.name();
}

std::optional<common::Setpoint> Autonomy::process(const Input& input) {
  if (const auto* timer = std::get_if<Tick>(&input)) return tick(timer->now);
  if (const auto* event = std::get_if<common::SensorEvent>(&input)) take(*event);
  if (const auto* command = std::get_if<CommandInput>(&input)) take(command->command, command->taken);
  if (const auto* delivery = std::get_if<common::JobDelivery>(&input)) jobs_->deliver(*delivery);
  return std::nullopt;
}

/// A frame of the observing camera changes nothing here. It is an input so that recordings contain it.
void Autonomy::take(const common::SensorEvent& event) {
  const Time arrived = common::stampsOf(event).arrived;
  if (!stamps_.accepts(event)) return;
  if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
    if (const auto sample = inertial_.take(estimator_.withAttitude(*imu))) estimator_.addImu(*sample);
  } else if (const auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event)) {
    take(*scan);
  } else if (const auto* frame = std::get_if<std::shared_ptr<const common::RgbdFrame>>(&event)) {
    if (estimator_.addFrame(*frame)) requests_.addFrame(*frame, estimator_.state());
  } else if (const auto* sweep = std::get_if<std::shared_ptr<const common::VerticalScan>>(&event)) {
    estimator_.addSweep(*sweep);
  } else if (const auto* battery = std::get_if<common::BatterySample>(&event)) {
    if (!supervisor_.batteryArrived(arrived, *battery)) return;
    battery_v_ = battery->voltage_v;
    energy_monitor_.add(*battery, control::isAirborne(controller_.state()), controller_.thrustMargin(),
                        estimator_.state().velocity_odom_m_s.head<2>().norm());
  } else if (const auto* pilot = std::get_if<common::PilotSample>(&event)) {
    supervisor_.pilotArrived(arrived, pilot->takes_over);
    assist_.pilotArrived(*pilot);
  }
}

/// The first scan that is left out leaves an event, all of them a figure of the run.
void Autonomy::take(const std::shared_ptr<const common::LaserScan>& scan) {
  if (scans_.add(scan) || scans_.lateScans() > 1) return;
  const common::Stamps& stamps = scan->stamps;
  events_.push_back(
      {stamps.arrived, common::Severity::kWarning, "laser", "a scan came too late to be used",
       fmt::format("{:.0f} ms after it was measured, {:.0f} ms behind a later one; further ones are only counted",
                   1e3 * (stamps.arrived - stamps.measured).seconds(),
                   1e3 * (scans_.lastMeasured() - stamps.measured).seconds())});
}

common::Setpoint Autonomy::tick(Time now) {
  while (const auto sample = inertial_.predicted(now)) estimator_.addImu(*sample, true);
  processDueScans(now);
  estimator_.updateMap3d(now);

  const double period_s = 1.0 / config_.behavior_rate_hz;
  if (!last_behaviors_ || (now - *last_behaviors_).seconds() >= period_s - 1e-6) {
    last_behaviors_ = now;
    tickBehaviors(now);
    restMotors(now);
  }

  control::FlightTick flight;
  flight.now = now;
  flight.state = estimator_.state();
  flight.raw_height = std::exchange(raw_height_, std::nullopt);
  flight.battery_v = battery_v_;
  flight.pilot_flies = supervisor_.pilotFlies();
  flight.fusion_diverged = estimator_.fusionStatus() == perception::FusionStatus::kDiverged;
  flight.inertial_fault = inertial_.fault(now);
  flight.inertial_contradicted = inertial_.contradicted();
  // What takes the place of a force comes from the thrust that was given: a controller would hear itself.
  if (!flight.inertial_contradicted) flight.acceleration_odom_m_s2 = estimator_.accelerationOdom_m_s2();
  flight.horizon_offset_rad = estimator_.horizonOffset_rad();
  assistPilot(flight);
  const common::Setpoint setpoint = controller_.tick(flight);
  last_thrust_ = setpoint.thrust;
  tellInertialInput(setpoint, flight.thrust_applies && !flight.pilot_flies);
  if (controller_.followsPath() && controller_.pathRemaining_m() > kFarFromGoal_m)
    energy_monitor_.followed(flight.state.velocity_odom_m_s.head<2>().norm(), common::kControlPeriod.seconds());
  estimator_.setAtRest(!control::isAirborne(controller_.state()));
  estimator_.setBelowMap(executor_.dip_m());
  estimator_.setAtFlightHeight(controller_.state() == FlightState::kFlying && executor_.dip_m() == 0.0);
  followMapHeight(flight.state.T_odom_body.position_m.z());
  prepare(now);
  return setpoint;
}

void Autonomy::tellInertialInput(const common::Setpoint& setpoint, bool thrust_applies) {
  // Below this height over the ground, contact may carry a part of the weight. A vehicle that comes down without a
  // measured height may have reached it, whatever the estimate says.
  constexpr double kNearGround_m = 0.45;
  const common::VehicleState state = estimator_.state();
  const bool low = state.height_above_ground_m < kNearGround_m || !state.vertical_valid ||
                   state.verticalAge_s(setpoint.stamp) > config_.control.emergency.blind_after_s;
  const bool near = low && controller_.state() != FlightState::kFlying;
  inertial_.flown(setpoint, {control::isAirborne(controller_.state()), near, thrust_applies,
                             setpoint.thrust / controller_.carryingCommand()});
}

/// The height of flight is that of the reference: a vehicle that sinks does not move the slice of the map that is
/// shown, and neither do a landing and a flight below something, behind which the path rises again.
void Autonomy::followMapHeight(double height_m) {
  if (controller_.state() == FlightState::kTakingOff) map_height_m_ = height_m;
  if (controller_.state() == FlightState::kFlying)
    map_height_m_ = controller_.reference().position_odom_m.z() + executor_.dip_m();
  if (control::isAirborne(controller_.state())) estimator_.setFlightHeight(map_height_m_);
}

bool Autonomy::finished() const {
  return missionOver() &&
         (controller_.state() == FlightState::kPoweredOff || controller_.state() == FlightState::kPreparation);
}

std::optional<Eigen::Vector3d> Autonomy::reference_odom_m() const {
  if (controller_.state() != FlightState::kFlying) return std::nullopt;
  return controller_.reference().position_odom_m;
}

std::vector<common::Event> Autonomy::takeEvents() {
  collect(stamps_.takeEvents());
  collect(inertial_.takeEvents());
  collect(scan_watch_.takeEvents());
  collect(estimator_.takeEvents(common::PlaceNames::in(given_map_.T_map_given())));
  collect(given_map_.takeEvents());
  collect(supervisor_.takeEvents());
  collect(requests_.takeEvents());
  collect(executor_.takeEvents());
  collect(controller_.takeEvents());
  std::stable_sort(events_.begin(), events_.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return std::exchange(events_, {});
}

VehicleMemory Autonomy::learned() const {
  return {VehicleMemory::kVersion, vehicle_.name, controller_.learnedThrust()};
}

std::vector<common::CommandResult> Autonomy::takeResults() { return std::exchange(results_, {}); }

// --------------------------------------------------------------------------------------------------- perception

void Autonomy::processDueScans(Time now) {
  while (const auto scan = scans_.take(now)) processScan(*scan, now);
}

void Autonomy::processScan(const common::LaserScan& scan, Time now) {
  if (scan_watch_.repeats(scan)) return;
  auto outcome = estimator_.addScan(scan, now);
  if (!outcome) return;
  const auto cost_map = executor_.costMapHere();
  // In the open no beam returns. Between walls that is a laser which has gone blind.
  const auto& counts = outcome->scan.counts;
  if (counts.hits > 0 || (counts.no_returns > 0 && !(cost_map && executor_.desk().wallsAround(estimator_.state()))))
    supervisor_.surroundingsSeen(now);
  if (outcome->raw_height) raw_height_ = outcome->raw_height;
  drift_m_ = outcome->drift_m;

  const common::VehicleState state = estimator_.state();
  const auto& decision =
      reactive_.update({outcome->scan, outcome->T_map_body, state, (now - outcome->scan.stamp).seconds(), drift_m_,
                        estimator_.people().obstacles(),
                        assisted_ ? assist_.wantedVelocity_map_m_s(state) : executor_.wantedVelocity_map_m_s(),
                        cost_map.get(), obstaclesOfCamera().pointsNear_level_m(outcome->T_map_body, kNear_m),
                        requests_.keepOut().edgesNear_level_m(outcome->T_map_body, kNear_m)});
  executor_.react(decision, state);

  auto points = std::make_shared<common::LaserPoints>();
  for (const Eigen::Vector2f& point : outcome->scan.points_level_m)
    points->points_map_m.push_back((outcome->T_map_body * Eigen::Vector2d(point.cast<double>())).cast<float>());
  laser_points_ = std::move(points);
}

// --------------------------------------------------------------------------------------------------- behaviours

void Autonomy::tickBehaviors(Time now) {
  takeSnapshot(now);
  if (prepared_) intent_ = nextIntent(now);
  if (missionOver()) takeSnapshot(now);  // So that the last snapshot shows how the mission ended.
  std::shared_ptr<const common::LevelMap> surfaces;
  if (std::holds_alternative<common::LandIntent>(intent_.kind) && controller_.state() == FlightState::kFlying)
    surfaces = std::make_shared<common::LevelMap>(estimator_.seenSurfaces());
  updateCameraObstacles();
  executor_.tick(intent_,
                 {now, estimator_.state(), camera_obstacles_.grid(), estimator_.levels(), std::move(surfaces),
                  estimator_.people().discs(now), estimator_.people().anyMoves(), reactive_.decision(), drift_m_,
                  supervisor_.takeOffRefusal(energy_), estimator_.people().obstacles(), &estimator_.people().seen(),
                  requests_.keepOut().zones(), common::PlaceNames::in(given_map_.T_map_given()), estimator_.map3d(),
                  [this, now] { return estimator_.whyUnready(now); }});
  const bool knows_walls = drift_m_ < config_.supervisor.drift_back_m;
  controller_.setEscape(knows_walls ? executor_.escape_map_m(estimator_.state())
                                    : Eigen::Vector2d(Eigen::Vector2d::Zero()));
}

/// Paths are planned at the height of flight, also while the vehicle is below something; what it brakes for is at its
/// own height.
void Autonomy::updateCameraObstacles() {
  const Eigen::Vector3d body_map_m = estimator_.state().T_map_body().position_m;
  const double dip_m = executor_.dip_m();
  camera_obstacles_.update(estimator_.map3d(), given_map_.gridForPaths(),
                           body_map_m + dip_m * Eigen::Vector3d::UnitZ());
  if (dip_m > 0.0) lower_obstacles_.update(estimator_.map3d(), given_map_.gridForPaths(), body_map_m);
}

common::Intent Autonomy::nextIntent(Time now) {
  const Supervision& supervision = supervisor_.tick(now, condition(now));
  if (supervision.unseen) executor_.endRetreat();
  fillContext(supervision, now);
  if (const auto wanted_to_see = executor_.wantsToSee_map_m())
    supervisor_intents_.remember(*wanted_to_see);
  else if (!supervision.hold)
    supervisor_intents_.forget();
  common::Intent intent = chooseIntent(supervision, now);
  tellWhoFlies(supervision, intent);
  return intent;
}

/// The supervisor's intent comes before the mission's.
common::Intent Autonomy::chooseIntent(const Supervision& supervision, Time now) {
  const bool airborne = control::isAirborne(controller_.state());
  if (supervision.land) {
    endMission(supervision.land_reason, now);
    return SupervisorIntents::land();
  }
  if (missionOver()) return SupervisorIntents::land();
  tickMission();
  if (!airborne)
    return waitsToTakeOff(supervision) ? SupervisorIntents::hold() : context_.intent.value_or(common::Intent{});
  if (missionOver()) return SupervisorIntents::land();
  const SupervisedFlight flight{now, *world_, intent_, executor_.status(), executor_.desk().home_m().has_value()};
  if (auto intent = supervisor_intents_.flight(supervision, flight, supervisor_)) return *intent;
  if (missions_.waits() || (supervision.hold && mission_status_.state != MissionState::kHeld))
    return SupervisorIntents::hold();
  return context_.intent.value_or(common::Intent{});
}

/// A hold keeps the vehicle on the ground whatever the mission does; TakeOff goes on when it ends.
bool Autonomy::waitsToTakeOff(const Supervision& supervision) const {
  return supervision.hold && context_.intent && std::holds_alternative<common::TakeOffIntent>(context_.intent->kind);
}

void Autonomy::fillContext(const Supervision& supervision, Time now) {
  context_.world = world_;
  context_.goal_map = executor_.desk().goalMap();
  context_.status = executor_.status();
  context_.now = now;
  context_.hold = supervision.hold;
  context_.hold_reason = supervision.hold_reason;
}

/// The supervisor lands the vehicle for good. The mission may need several ticks to let go of it.
void Autonomy::endMission(const std::string& reason, Time now) {
  if (!missionOver()) {
    mission_status_.state = supervisor_.landedByOperator() ? MissionState::kStopped : MissionState::kFailed;
    mission_status_.reason = "landed: " + reason;
    mission_status_.phase = "land";
    releasing_mission_ = true;
  }
  for (const auto& command : std::exchange(context_.commands, {}))
    answer(command, {command.id, false, "the vehicle is landing: " + reason}, now);
  if (releasing_mission_) releasing_mission_ = !missions_.mission().letGo(context_);
  collect(std::exchange(context_.events, {}));
}

VehicleCondition Autonomy::condition(common::Time now) const {
  VehicleCondition condition;
  condition.flight = controller_.state();
  condition.lands = std::holds_alternative<common::LandIntent>(intent_.kind);
  condition.energy = energy_;
  condition.charge_counted_on = energy_monitor_.countedOn(now);
  const common::VehicleState state = estimator_.state();
  condition.vertical_age_s = state.verticalAge_s(now);
  const double age_s = std::max(state.horizontalAge_s(now), condition.vertical_age_s);
  condition.position_measured =
      state.horizontal_valid && state.vertical_valid && age_s < config_.supervisor.unseen_hold_s;
  condition.sensor_lies = inertial_.mustLandFor(now);
  condition.drift_m = drift_m_;
  if (drift_m_ > config_.supervisor.drift_land_m) condition.walls_around = executor_.desk().wallsAround(state);
  return condition;
}

void Autonomy::tickMission() {
  context_.intent.reset();
  context_.answers = requests_.takeAnswers(context_.now);
  const std::vector<common::OperatorCommand> asked = context_.commands;
  const behaviors::TickResult result = missions_.tick(context_);
  for (const common::MissionRequest& request : std::exchange(context_.requests, {}))
    if (auto answer = map_shelf_.take(request, estimator_, given_map_)) {
      if (given_map_.given()) missions_.mapIsGiven();
      requests_.answered(std::move(*answer), context_.now);
    } else {
      requests_.take(request, *world_);
    }
  collect(std::exchange(context_.events, {}));
  std::vector<common::CommandResult> answers = std::exchange(context_.results, {});
  SWIFTLET_CHECK(answers.size() == asked.size(), answers.size(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) answer(asked[i], std::move(answers[i]), context_.now);
  followMission();
  mission_status_.state = result.state;
  mission_status_.phase = result.phase;
  mission_status_.reason = result.reason;
  mission_status_.question = missions_.mission().question();
  if (result.state == MissionState::kFailed && control::isAirborne(controller_.state()))
    events_.push_back({context_.now,
                       common::Severity::kWarning,
                       "mission",
                       "the mission has failed: the vehicle lands",
                       result.reason,
                       {},
                       common::Concern::kLanding});
}

void Autonomy::collect(std::vector<common::Event> events) {
  std::move(events.begin(), events.end(), std::back_inserter(events_));
}

}  // namespace swiftlet::autonomy
