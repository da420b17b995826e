// The snapshots of the world that Autonomy gives to those who watch.
#include "autonomy/autonomy.hpp"
#include "autonomy/trail_back.hpp"
#include "common/segment.hpp"
#include "control/actuation.hpp"
#include "control/flight_state_machine.hpp"

namespace swiftlet::autonomy {

using common::FlightState;
using common::MissionState;
using common::Time;

void Autonomy::takeSnapshot(Time now) {
  const common::VehicleState& state = estimator_.state();
  given_map_.update(now, state.T_map_body_planar(), state.T_map_odom, estimator_.localization(), estimator_.grid());
  WorldParts parts;
  parts.vehicle.state = estimator_.state();
  parts.vehicle.flight_state = controller_.state();
  parts.vehicle.avoidance = reactive_.decision().status;
  parts.vehicle.plan_map_m = executor_.remainingPlan_map_m();
  parts.vehicle.laser = laser_points_;
  parts.vehicle.drift_m = drift_m_;
  parts.mission = {mission_status_, executor_.status(), executor_.goal_map_m(), {}, {}};
  showWaiting(parts.mission);
  parts.mission.status.tree = missions_.mission().view();
  parts.map = {given_map_.grid(),
               estimator_.levels(),
               executor_.desk().frontiers(),
               executor_.desk().exploredArea_m2(),
               estimator_.localization(),
               given_map_.T_map_given(),
               requests_.keepOut().zones(),
               given_map_.flown(),
               given_map_.given()};
  for (const common::Disc& person : estimator_.people().expectedAt(now))
    parts.people.people.push_back({person.center_map_m, person.radius_m});
  parts.people.followed_map_m = executor_.followedPerson_map_m();
  FlightHome home{executor_.desk().home_m(), 0.0, controller_.landing_s()};
  if (world_ && !home.planned_m)
    home.trail_m = common::polylineLength(trailBackWithoutLoops(world_->vehicle->trail.points_map_m()));
  parts.map3d = estimator_.map3d();
  parts.targets.targets = estimator_.targets();
  // The flight home ends so far above the thrust at which the vehicle has to land where it is as a tilt needs.
  parts.energy = energy_ =
      energy_monitor_.layer(now, home, controller_.thrustMargin(), config_.supervisor.battery_land_share,
                            control::kKeptForHeight + config_.supervisor.least_thrust_margin);
  world_ = world_builder_.build(now, std::move(parts));
}

/// What flies the vehicle is told before the mission that waits: the controller's own landing, then the supervisor.
void Autonomy::tellWhoFlies(const Supervision& supervision, const common::Intent& intent) {
  mission_status_.flown_by = supervision.flown_by;
  if (supervision.land || missionOver()) return;
  const bool asked = std::holds_alternative<common::LandIntent>(intent.kind) ||
                     std::holds_alternative<common::EmergencyLandIntent>(intent.kind);
  const bool lands =
      !asked && (controller_.state() == FlightState::kLanding || controller_.state() == FlightState::kEmergencyLanding);
  const bool flies = supervision.back > 0 || supervision.home > 0;
  const bool holds = supervision.hold && mission_status_.state != MissionState::kHeld &&
                     (control::isAirborne(controller_.state()) || waitsToTakeOff(supervision));
  if (lands) mission_status_.flown_by = common::FlownBy::kSupervisor;
  if (!lands && !flies && !holds) return;
  mission_status_.phase = lands ? toString(controller_.state()) : phaseOf(supervision);
  mission_status_.reason = lands ? controller_.groundedReason() : supervision.hold_reason;
}

/// What the mission flies to after the hold, as long as nothing else is flown to.
void Autonomy::showWaiting(common::MissionLayer& layer) const {
  const auto command = missions_.waitingCommand();
  if (mission_status_.state != MissionState::kHeld || !command) return;
  layer.waiting = toString(*command, world_->map->names());
  if (layer.goal_map_m) return;
  const auto* goal = std::get_if<common::GoalCommand>(&command->kind);
  layer.goal_map_m = goal != nullptr ? goal->goal_map_m : world_->vehicle->home_map.position_m();
}

}  // namespace swiftlet::autonomy
