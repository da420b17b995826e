#include "apps/flight_sinks.hpp"

#include "apps/web_link.hpp"
#include "common/world.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/operator_script.hpp"
#include "evaluation/phase_words.hpp"
#include "interfaces/run_folder.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::apps {

using WorldPtr = std::shared_ptr<const common::World>;

void FolderSink::ticked(const autonomy::TickOutcome& outcome) { folder_.state(outcome.state); }
void FolderSink::world(const WorldPtr& world) { folder_.world(*world); }
void FolderSink::file(const autonomy::RunFile& file) {
  if (const auto* map = std::get_if<autonomy::SavedMap>(&file)) folder_.saveMap(map->name, *map->grid);
  if (const auto* photo = std::get_if<autonomy::Photo>(&file))
    folder_.savePhoto(photo->name, *photo->frame, photo->T_map_camera);
}
void FolderSink::event(const common::Event& event) { folder_.event(event); }

void TruthSink::input(const autonomy::Input& input) {
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
void TruthSink::ticked(const autonomy::TickOutcome& outcome) {
  std::vector<Eigen::Vector2d> people_world_m;
  for (const simulation::Actor& walker : vehicle_.walkers()) people_world_m.emplace_back(walker.position_world_m);
  recorder_.people(std::move(people_world_m));
  recorder_.tick(vehicle_.truth(), outcome.state, outcome.reference_odom_m);
  recorder_.intent(outcome.now, outcome.intent, outcome.intent_status);
}
void TruthSink::world(const WorldPtr& world) {
  recorder_.world(*world);
  vehicle_.tellPhase(evaluation::phaseWords(*world));
}

void OperatorSink::ticked(const autonomy::TickOutcome& outcome) {
  script_.intent(outcome.intent, outcome.intent_status);
}
void OperatorSink::world(const WorldPtr& world) { script_.world(*world); }
void OperatorSink::event(const common::Event& event) { script_.event(event); }
void OperatorSink::result(const common::CommandResult& result) { script_.result(result); }

void PageSink::input(const autonomy::Input& input) {
  const auto* event = std::get_if<common::SensorEvent>(&input);
  if (event == nullptr) return;
  if (const auto* frame = std::get_if<std::shared_ptr<const common::CameraFrame>>(event)) web_.camera().post(*frame);
}
void PageSink::world(const WorldPtr& world) { web_.world().post(world); }
void PageSink::event(const common::Event& event) { web_.postEvent(event); }
void PageSink::result(const common::CommandResult& result) { web_.postResult(result); }

}  // namespace swiftlet::apps
