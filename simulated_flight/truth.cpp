#include "simulated_flight/truth.hpp"

#include <utility>
#include <variant>
#include <vector>

#include "common/world.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/operator_script.hpp"
#include "evaluation/phase_words.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::simulated_flight {

using WorldPtr = std::shared_ptr<const common::World>;

void Truth::input(const autonomy::Input& input) {
  if (const auto* command = std::get_if<autonomy::CommandInput>(&input)) {
    const bool ends = std::holds_alternative<common::LandCommand>(command->command.kind) ||
                      std::holds_alternative<common::HomeCommand>(command->command.kind);
    if (ends) recorder_.order(command->taken, "the operator's order: " + toString(command->command));
  }
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr) return;
  const auto* pilot = std::get_if<common::PilotSample>(event);
  if (pilot != nullptr && pilot->takes_over) recorder_.order(pilot->stamps.arrived, "the pilot took over");
  if (const auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(event)) recorder_.scan((*scan)->stamps);
}
void Truth::ticked(const autonomy::TickOutcome& outcome) {
  std::vector<Eigen::Vector2d> people_world_m;
  for (const simulation::Actor& walker : vehicle_.walkers()) people_world_m.emplace_back(walker.position_world_m);
  recorder_.people(std::move(people_world_m));
  recorder_.motors(outcome.setpoint.motors_on);
  recorder_.motors(outcome.setpoint.motors_on);
  recorder_.tick(vehicle_.truth(), outcome.state, outcome.reference_odom_m);
  recorder_.intent(outcome.now, outcome.intent, outcome.intent_status);
}
void Truth::world(const WorldPtr& world) {
  recorder_.world(*world);
  vehicle_.tellPhase(evaluation::phaseWords(*world));
}

void Truth::event(const common::Event& event) { recorder_.event(event); }

common::Pose3 Truth::T_map_body() const { return vehicle_.trueT_map_body(); }
Eigen::Vector3d Truth::velocity_map_m_s() const {
  return vehicle_.T_world_map().rotation.conjugate() * vehicle_.truth().velocity_world_m_s;
}
common::Pose3 Truth::T_map_camera() const {
  const simulation::Scenario& scenario = vehicle_.scenario();
  return T_map_body() * scenario.sensors.rgbd_errors.T_body_camera(scenario.rgbd_camera->mount);
}
bool Truth::airborne() const { return vehicle_.truth().airborne; }
const common::Trajectory& Truth::path_map() const { return recorder_.truth_map(); }

void OperatorSink::ticked(const autonomy::TickOutcome& outcome) {
  script_.intent(outcome.intent, outcome.intent_status);
}
void OperatorSink::world(const WorldPtr& world) { script_.world(*world); }
void OperatorSink::event(const common::Event& event) { script_.event(event); }
void OperatorSink::result(const common::CommandResult& result) { script_.result(result); }

}  // namespace swiftlet::simulated_flight
