#include "autonomy/autonomy.hpp"

#include <algorithm>
#include <utility>

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::MissionState;
using common::Time;

namespace {
/// Ids of the supervisor's own intents; those of the mission count from 1.
constexpr std::uint64_t kSupervisorHold = 1ULL << 62;
constexpr std::uint64_t kSupervisorLand = kSupervisorHold + 1;
constexpr double kTrailStep_m = 0.05;

/// Nobody counts on seeing more than the laser sees.
AutonomyConfig seeing(AutonomyConfig config, const common::LaserConfig& laser) {
  double& avoidance_deg = config.reactive.avoidance.field_of_view_deg;
  planning::ExplorationConfig& exploration = config.execution.exploration;
  avoidance_deg = std::min(avoidance_deg, laser.field_of_view_deg);
  exploration.laser_field_of_view_deg = std::min(exploration.laser_field_of_view_deg, laser.field_of_view_deg);
  exploration.laser_range_m = std::min(exploration.laser_range_m, laser.range_max_m);
  return config;
}

}  // namespace

void AutonomyConfig::describe(common::config::Fields& fields) {
  fields.section("estimator", estimator, "From raw samples to a state and a map.");
  fields.section("reactive", reactive, "Braking and retreat at the laser rate.");
  fields.section("execution", execution, "Planning and exploring to carry out intents.");
  fields.section("control", control, "State machine, trajectories and controllers.");
  fields.section("supervisor", supervisor, "Hold and landing above the mission.");
  fields("behavior_rate_hz", behavior_rate_hz, {1, 100}, "Ticks of the mission's tree a second.");
  fields("scan_latency_s", scan_latency_s, {0, 0.2}, "Declared time for projecting and matching one scan.");
  fields("max_height_m", max_height_m, {0.2, 100},
         "Greatest height over the take-off floor; a mission that asks for more is refused.");
}

std::vector<std::string> AutonomyConfig::validate() const {
  std::vector<std::string> problems;
  for (const std::string& problem : reactive.problemsWith(execution.clearance_m))
    problems.push_back("reactive.avoidance." + problem);
  return problems;
}

Autonomy::Autonomy(const AutonomyConfig& config, const common::VehicleConfig& vehicle, const common::LaserConfig& laser,
                   behaviors::Mission mission, std::unique_ptr<common::JobRunner> jobs, const GivenMap* given)
    : config_(seeing(config, laser)),
      vehicle_(vehicle),
      estimator_(config.estimator, laser, vehicle, given, *jobs),
      reactive_(config_.reactive, vehicle.hullRadius_m(), config.estimator.slam.grid),
      controller_(config.control, vehicle),
      executor_(config_.execution, vehicle, config.estimator.slam.grid.resolution_m, controller_, *jobs),
      supervisor_(config.supervisor),
      mission_(std::move(mission)),
      jobs_(std::move(jobs)),
      trail_(std::make_shared<std::vector<Eigen::Vector2d>>()) {
  context_.goal_limits.greatest_height_m = config.max_height_m;
  mission_status_.accepts_goals = mission_.acceptsGoals();
  takeSnapshot(Time{});
}

Autonomy::~Autonomy() = default;

void Autonomy::process(const common::SensorEvent& event) {
  const Time arrived = common::stampsOf(event).arrived;
  jobs_->deliverDue(arrived);
  if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
    estimator_.addImu(*imu);
  } else if (const auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event)) {
    scans_.push_back({*scan, arrived + common::Duration::fromSeconds(config_.scan_latency_s)});
  } else if (const auto* battery = std::get_if<common::BatterySample>(&event)) {
    if (!supervisor_.batteryArrived(arrived, *battery)) return;
    status_.battery_voltage_v = battery->voltage_v;
    status_.battery_remaining = battery->remaining;
  } else if (const auto* pilot = std::get_if<common::PilotSample>(&event)) {
    supervisor_.pilotArrived(arrived, pilot->takes_over);
  }
}

void Autonomy::process(const common::OperatorCommand& command, Time now) {
  if (auto result = supervisor_.take(command, now)) {
    results_.push_back(std::move(*result));
    return;
  }
  if (missionOver()) {
    results_.push_back({command.id, false, "the mission has ended"});
    return;
  }
  context_.commands.push_back(command);
}

common::Setpoint Autonomy::tick(Time now) {
  jobs_->deliverDue(now);
  processDueScans(now);

  const double period_s = 1.0 / config_.behavior_rate_hz;
  if (!last_behaviors_ || (now - *last_behaviors_).seconds() >= period_s - 1e-6) {
    last_behaviors_ = now;
    tickBehaviors(now);
    if (missionOver() && controller_.state() == FlightState::kLanded)
      (void)controller_.command(control::DisengageMotors{});
  }

  control::FlightTick flight;
  flight.now = now;
  flight.state = estimator_.state();
  flight.raw_height = std::exchange(raw_height_, std::nullopt);
  flight.battery_v = status_.battery_voltage_v;
  flight.pilot_flies = supervisor_.pilotFlies();
  flight.fusion_diverged = estimator_.health().status == perception::FusionStatus::kDiverged;
  const common::Setpoint setpoint = controller_.tick(flight);
  estimator_.setAtRest(!control::isAirborne(controller_.state()));
  estimator_.setAtFlightHeight(controller_.state() == FlightState::kFlying);
  // Not while landing: the map stays that of the flight.
  if (controller_.state() == FlightState::kTakingOff || controller_.state() == FlightState::kFlying)
    estimator_.setFlightHeight(flight.state.T_odom_body.position_m.z());
  prepare();
  return setpoint;
}

bool Autonomy::finished() const {
  return missionOver() &&
         (controller_.state() == FlightState::kPoweredOff || controller_.state() == FlightState::kPreparation);
}

std::vector<common::Event> Autonomy::takeEvents() {
  collect(estimator_.takeEvents());
  collect(supervisor_.takeEvents());
  collect(executor_.takeEvents());
  collect(controller_.takeEvents());
  std::stable_sort(events_.begin(), events_.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return std::exchange(events_, {});
}

std::vector<common::CommandResult> Autonomy::takeResults() { return std::exchange(results_, {}); }

// --------------------------------------------------------------------------------------------------- perception

void Autonomy::processDueScans(Time now) {
  while (!scans_.empty() && scans_.front().due <= now) {
    const auto scan = scans_.front().scan;
    scans_.erase(scans_.begin());
    processScan(*scan, now);
  }
}

void Autonomy::processScan(const common::LaserScan& scan, Time now) {
  auto outcome = estimator_.addScan(scan, now, reactive_.people(scan.stamps.measured));
  if (!outcome) return;
  const int hits = outcome->scan.counts.hits + outcome->scan.counts.no_returns;
  if (hits > 0) supervisor_.scanArrived(now);
  if (outcome->raw_height) raw_height_ = outcome->raw_height;

  const common::VehicleState state = estimator_.state();
  const auto cost_map = executor_.desk().costMap();
  const auto& decision = reactive_.update(outcome->scan, outcome->T_map_body, state, executor_.wishedVelocity_map_m_s(),
                                          estimator_.grid(), cost_map.get());
  executor_.react(decision, state);

  auto points = std::make_shared<common::LaserPoints>();
  for (const Eigen::Vector2f& point : outcome->scan.points_level_m)
    points->points_map_m.push_back((outcome->T_map_body * Eigen::Vector2d(point.cast<double>())).cast<float>());
  laser_points_ = std::move(points);
}

void Autonomy::prepare() {
  if (prepared_ || !estimator_.ready()) return;
  const common::VehicleState state = estimator_.state();
  if (!state.horizontal_valid || !state.vertical_valid) return;
  prepared_ = controller_.command(control::Prepared{}).has_value();
}

// --------------------------------------------------------------------------------------------------- behaviours

void Autonomy::tickBehaviors(Time now) {
  status_.flight_state = controller_.state();
  takeSnapshot(now);
  if (prepared_) wish_ = wishOf(now);
  if (missionOver()) takeSnapshot(now);  // So that the last snapshot shows how the mission ended.
  executor_.tick(wish_, {now, estimator_.state(), estimator_.grid(), estimator_.levels(), reactive_.discs(now),
                         reactive_.anybodyWalks(), reactive_.decision()});
}

/// The supervisor's wish before the mission's.
common::Intent Autonomy::wishOf(Time now) {
  const bool airborne = control::isAirborne(controller_.state());
  const Supervision& supervision = supervisor_.tick(now, airborne, status_);
  context_.world = world_;
  context_.goal_map = executor_.desk().goalMap();
  context_.status = executor_.status();
  context_.now = now;
  context_.hold = supervision.hold;
  context_.hold_reason = supervision.hold_reason;

  if (supervision.land) {
    if (!missionOver()) {
      mission_status_.state = supervisor_.landedByOperator() ? MissionState::kStopped : MissionState::kFailed;
      mission_status_.reason = "landed: " + supervision.land_reason;
      mission_status_.phase = "land";
      lets_go_ = true;
    }
    if (lets_go_) lets_go_ = !mission_.letGo(context_);
    collect(std::exchange(context_.events, {}));
    return {kSupervisorLand, common::LandIntent{}};
  }
  if (missionOver()) return {kSupervisorLand, common::LandIntent{}};
  tickMission();
  if (missionOver() && airborne) return {kSupervisorLand, common::LandIntent{}};
  if (supervision.hold && mission_status_.state != MissionState::kHeld && airborne)
    return {kSupervisorHold, common::HoldIntent{}};
  return context_.intent.value_or(common::Intent{});
}

void Autonomy::tickMission() {
  context_.intent.reset();
  const behaviors::TickResult result = mission_.tick(context_);
  collect(std::exchange(context_.events, {}));
  for (auto& answer : std::exchange(context_.results, {})) results_.push_back(std::move(answer));
  mission_status_.state = result.state;
  mission_status_.phase = result.phase;
  mission_status_.reason = result.reason;
}

void Autonomy::takeSnapshot(Time now) {
  const common::VehicleState state = estimator_.state();
  const Eigen::Vector2d position_odom_m = state.T_odom_body.position_m.head<2>();
  if (control::isAirborne(status_.flight_state)) {
    if (last_position_odom_m_) status_.distance_flown_m += (position_odom_m - *last_position_odom_m_).norm();
    const Eigen::Vector2d position_map_m = state.T_map_body().position_m.head<2>();
    if (trail_->empty() || (trail_->back() - position_map_m).norm() > kTrailStep_m) {
      trail_ = std::make_shared<std::vector<Eigen::Vector2d>>(*trail_);
      trail_->push_back(position_map_m);
    }
  }
  last_position_odom_m_ = position_odom_m;

  auto world = std::make_shared<common::World>();
  world->stamp = now;
  world->state = state;
  world->status = status_;
  world->avoidance = reactive_.decision().status;
  world->grid = estimator_.grid();
  world->levels = estimator_.levels();
  world->frontiers = executor_.desk().frontiers();
  world->plan_map_m = executor_.remainingPlan_map_m();
  world->trail_map_m = trail_;
  world->goal_map_m = executor_.goal_map_m();
  world->explored_area_m2 = executor_.desk().exploredArea_m2();
  world->intent = executor_.status();
  world->mission = mission_status_;
  world->mission.tree = mission_.view();
  world->laser = laser_points_;
  world->localization = estimator_.localization();
  world_ = std::move(world);
}

void Autonomy::collect(std::vector<common::Event> events) {
  std::move(events.begin(), events.end(), std::back_inserter(events_));
}

}  // namespace swiftlet::autonomy
