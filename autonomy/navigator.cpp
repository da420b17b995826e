#include "autonomy/navigator.hpp"

#include <utility>

#include "autonomy/autonomy_config.hpp"
#include "autonomy/health/checks.hpp"
#include "control/controller_choice.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::Time;

namespace {

/// Nearer to the end of a path the vehicle brakes, so its speed there does not represent a long path. The shipped
/// profiles brake within v^2 / (2 a) = 0.33 m; the rest is margin for faster ones.
constexpr double kFarFromGoal_m = 1.0;

/// The reactive layer acts on what is near: at 1.5 m/s and 1 m/s^2 the vehicle stops within 1.1 m, and the hull is 0.3
/// m.
constexpr double kNear_m = 2.0;

std::shared_ptr<const common::LaserPoints> pointsOf(const ScanOutcome& outcome) {
  auto points = std::make_shared<common::LaserPoints>();
  for (const Eigen::Vector2f& point : outcome.scan.points_level_m)
    points->points_map_m.push_back((outcome.T_map_body * Eigen::Vector2d(point.cast<double>())).cast<float>());
  return points;
}

}  // namespace

Navigator::Navigator(const AutonomyConfig& config, const AutonomySetup& setup, common::EventLog& log)
    : camera_(setup.camera != nullptr ? std::optional(*setup.camera) : std::nullopt),
      controller_(config.control, setup.vehicle, log, setup.model,
                  setup.memory != nullptr ? setup.memory->thrust : control::ThrustPoints()),
      executor_(config.execution, setup.vehicle, config.estimator.slam.grid.resolution_m, controller_, *setup.jobs, log,
                camera_ ? &*camera_ : nullptr),
      reactive_(config.reactive, setup.vehicle.hullRadius_m()),
      camera_obstacles_(setup.vehicle.hull_height_m),
      obstacles_here_(setup.vehicle.hull_height_m),
      assist_(config.assist, setup.vehicle.max_tilt_deg, config.reactive.avoidance),
      readiness_(log) {
  flown_.thrust_margin = controller_.thrust().margin();
}

tl::expected<void, std::string> Navigator::switchController(std::string_view name) {
  const auto kind = control::controllerNamed(name);
  if (!kind) return tl::unexpected(std::string("there is no controller of that name"));
  return controller_.command(control::SwitchController{*kind});
}

bool Navigator::knowsWallsAround(const common::VehicleState& state) const {
  return executor_.costMapHere() != nullptr && executor_.desk().wallsAround(state);
}

std::optional<Eigen::Vector3d> Navigator::reference_odom_m() const {
  if (controller_.state() != FlightState::kFlying) return std::nullopt;
  return controller_.follower().reference().position_odom_m;
}

// -------------------------------------------------------------------------------------------------- at the scan's rate

void Navigator::react(const Percept& percept, const KeepOutZones& keep_out) {
  for (const SeenScan& seen : percept.scans) {
    const ScanOutcome& outcome = seen.outcome;
    const auto cost_map = executor_.costMapHere();
    const auto& decision = reactive_.update(
        {outcome.scan, outcome.T_map_body, seen.state, (percept.now - outcome.scan.stamp).seconds(), outcome.drift_m,
         seen.people, assisted_ ? assist_.wantedVelocity_map_m_s(seen.state) : executor_.aim().velocity_map_m_s,
         cost_map ? &cost_map->clearance() : nullptr,
         obstaclesOfCamera().pointsNear_level_m(outcome.T_map_body, kNear_m),
         keep_out.edgesNear_level_m(outcome.T_map_body, kNear_m)});
    executor_.react(decision, seen.state);
    laser_points_ = pointsOf(outcome);
    camera_obstacles_.forget(outcome.gone);
    if (executor_.dip_m() != 0.0) obstacles_here_.forget(outcome.gone);
  }
}

// --------------------------------------------------------------------------------------------- at the behaviours' rate

void Navigator::carryOut(const Decision& decision, const Percept& percept, const KeepOutZones& keep_out) {
  controller_.setMaxHeight(decision.max_height_m);
  if (decision.unseen) executor_.endRetreat();
  const Surroundings& around = *percept.around;
  const Estimator& estimator = *percept.estimator;
  std::shared_ptr<const common::LevelMap> surfaces;
  if (std::holds_alternative<common::LandIntent>(decision.intent.kind) && controller_.state() == FlightState::kFlying)
    surfaces = std::make_shared<common::LevelMap>(estimator.seenSurfaces());
  updateCameraObstacles(percept);
  executor_.tick(decision.intent,
                 {percept.now, percept.state, camera_obstacles_.grid(), around.levels, std::move(surfaces),
                  estimator.people().discs(percept.now), estimator.people().anyMoves(), reactive_.decision(),
                  decision.spare_s, percept.drift_m, decision.take_off_refusal, estimator.people().obstacles(),
                  &estimator.people().seen(), keep_out.zones(), common::PlaceNames::in(around.T_map_given),
                  around.map3d, [&estimator, now = percept.now] { return estimator.whyUnready(now); }, around.objects});
  // With more drift the walls are not where the map has them.
  const bool knows_walls = percept.drift_m < kDriftBack_m;
  controller_.setEscape(knows_walls ? executor_.escape_map_m(percept.state) : Eigen::Vector2d(Eigen::Vector2d::Zero()));
  restMotors(decision, percept.now);
}

/// Paths are planned at the height of flight, also while the vehicle is at another one; what it brakes for is at
/// its own height.
void Navigator::updateCameraObstacles(const Percept& percept) {
  const Surroundings& around = *percept.around;
  const Eigen::Vector3d body_map_m = percept.state.T_map_body().position_m;
  const double dip_m = executor_.dip_m();
  camera_obstacles_.update(around.map3d, around.grid_for_paths, body_map_m + dip_m * Eigen::Vector3d::UnitZ());
  if (dip_m != 0.0) obstacles_here_.update(around.map3d, around.grid_for_paths, body_map_m);
}

/// A vehicle that stands and is not to take off has its motors off, also while its mission waits for a person
/// who changes the battery.
void Navigator::restMotors(const Decision& decision, Time now) {
  const bool takes_off = std::holds_alternative<common::TakeOffIntent>(decision.intent.kind);
  const bool stands = controller_.state() == FlightState::kLanded && (!takes_off || decision.mission_over);
  rests_.update(stands, now);
  if (stands && (decision.mission_over || rests_.active())) (void)controller_.command(control::DisengageMotors{});
}

// ----------------------------------------------------------------------------------------------------- at every tick

common::Setpoint Navigator::fly(const Decision& decision, const Percept& percept, const KeepOutZones& keep_out) {
  if (percept.around) carryOut(decision, percept, keep_out);
  control::FlightTick flight = flightTick(decision, percept);
  assistPilot(decision, flight);
  flown_.setpoint = controller_.tick(flight);
  flown_.inertial = inertialContext(flight, flown_.setpoint);
  followMapHeight(percept.state.T_odom_body.position_m.z());
  flown_.airborne = control::isAirborne(controller_.state());
  flown_.below_map_m = executor_.dip_m();
  flown_.at_flight_height = controller_.state() == FlightState::kFlying && executor_.dip_m() == 0.0;
  flown_.flight_height_m = flown_.airborne ? std::optional(map_height_m_) : std::nullopt;
  flown_.thrust_margin = controller_.thrust().margin();
  const bool far_from_goal =
      controller_.follower().followsPath() && controller_.follower().remaining_m() > kFarFromGoal_m;
  flown_.path_speed_m_s =
      far_from_goal ? std::optional(percept.state.velocity_odom_m_s.head<2>().norm()) : std::nullopt;
  flown_.given_map = decision.given_map;
  readiness_.watch(percept, controller_);
  return flown_.setpoint;
}

control::FlightTick Navigator::flightTick(const Decision& decision, const Percept& percept) const {
  control::FlightTick flight;
  flight.now = percept.now;
  flight.state = percept.state;
  flight.raw_height = percept.raw_height;
  flight.battery_v = percept.battery_v;
  flight.pilot_flies = decision.pilot_flies;
  flight.fusion_diverged = percept.fusion_diverged;
  flight.inertial_fault = percept.inertial_fault;
  flight.inertial_contradicted = percept.inertial_contradicted;
  // What takes the place of a force comes from the thrust that was given: a controller that used it would measure its
  // own command.
  if (!flight.inertial_contradicted) flight.acceleration_odom_m_s2 = percept.acceleration_odom_m_s2;
  flight.horizon_offset_rad = percept.horizon_offset_rad;
  return flight;
}

/// The pilot flies, and the program with the pilot: it has the controller, but not the last word.
void Navigator::assistPilot(const Decision& decision, control::FlightTick& flight) {
  const bool before = std::exchange(assisted_, assist_.assists(flight.pilot_flies, controller_.state(), flight.state));
  if (before && !assisted_) controller_.hold();
  if (!assisted_) return;
  flight.thrust_applies = assist_.thrustApplies(flown_.setpoint.thrust);
  // The last scan is outdated then: without it the program requests a stop.
  const planning::AvoidanceDecision& avoidance = decision.unseen ? planning::AvoidanceDecision() : reactive_.decision();
  flight.pilot_flies = !assist_.fly(controller_, avoidance, flight.state, decision.max_height_m);
}

/// The height of flight is the reference's: a vehicle that sinks does not move the slice of the map that is
/// shown, and neither do a landing and a path in space, after which the vehicle is back at the height of flight.
void Navigator::followMapHeight(double height_m) {
  if (controller_.state() == FlightState::kTakingOff) map_height_m_ = height_m;
  if (controller_.state() == FlightState::kFlying)
    map_height_m_ = controller_.follower().reference().position_odom_m.z() + executor_.dip_m();
}

InertialContext Navigator::inertialContext(const control::FlightTick& flight, const common::Setpoint& setpoint) const {
  // Below this height over the ground, contact may carry a part of the weight. A vehicle that comes down without a
  // measured height may have reached it, whatever the estimate says.
  constexpr double kNearGround_m = 0.45;
  const common::VehicleState& state = flight.state;
  const bool low = state.height_above_ground_m < kNearGround_m || !state.vertical_valid ||
                   state.verticalAge_s(setpoint.stamp) > control::EmergencyDescent::kBlindAfter_s;
  return {control::isAirborne(controller_.state()), low && controller_.state() != FlightState::kFlying,
          flight.thrust_applies && !flight.pilot_flies, setpoint.thrust / controller_.carryingCommand()};
}

}  // namespace swiftlet::autonomy
