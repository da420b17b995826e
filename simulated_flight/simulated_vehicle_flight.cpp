#include "simulated_flight/simulated_vehicle_flight.hpp"

#include <utility>

#include "evaluation/knowable_frame.hpp"
#include "flight/web_link.hpp"
#include "simulation/arena.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::simulated_flight {
namespace {

evaluation::FlightRecorder recorderOf(const SimulatedSetup& setup, const simulation::SimulatedVehicle& vehicle) {
  const common::Pose3 T_world_map = vehicle.T_world_map();
  evaluation::FlightRecorder recorder(T_world_map,
                                      evaluation::knowableFrame(T_world_map, vehicle.scenario().sensors.laser_errors),
                                      setup.T_world_given);
  recorder.watch(setup.phases);
  recorder.watchEvents(setup.event_orders);
  return recorder;
}

std::unique_ptr<VisualOdometrySink> visualOdometryOf(const SimulatedSetup& setup) {
  if (!setup.visual_odometry_alone || !setup.system.rgbd_camera || setup.system.rgbd_camera->isStereo()) return nullptr;
  return std::make_unique<VisualOdometrySink>(setup.system.config.autonomy.estimator.rgbd.mapper,
                                              setup.system.rgbd_camera->mount.pose());
}

interfaces::RunInfo runInfo(const simulation::Scenario& scenario, const simulation::SimulatedVehicle& vehicle) {
  interfaces::RunInfo info;
  info.world = scenario.world;
  info.vehicle = vehicle.name();
  info.seed = scenario.seed;
  const simulation::Nature calm = simulation::Nature::calm();
  const simulation::Nature& nature = scenario.nature ? *scenario.nature : calm;
  info.nature = nature.name();
  info.nature_yaml = nature.valuesIn(vehicle.scenario());
  return info;
}

}  // namespace

SimulatedVehicleFlight::SimulatedVehicleFlight(const SimulatedSetup& setup, const SimulatedHooks& hooks,
                                               const std::shared_ptr<simulation::Arena>& arena, std::size_t number,
                                               flight::FlightMission mission, const std::filesystem::path& folder)
    : setup_(setup),
      hooks_(hooks),
      vehicle_(std::make_unique<simulation::SimulatedVehicle>(arena, number)),
      recorder_(recorderOf(setup, *vehicle_)),
      script_(setup.operator_steps, vehicle_->name()),
      truth_(*vehicle_, recorder_),
      operator_(script_),
      visual_odometry_(visualOdometryOf(setup)),
      web_(hooks.web ? &hooks.web->channel(number) : nullptr),
      flight_(setup, hooks, flown(number, folder), std::move(mission), common::makeLockstepJobs(1)) {}

flight::FlownVehicle SimulatedVehicleFlight::flown(std::size_t number, const std::filesystem::path& folder) {
  flight::FlownVehicle flown{.vehicle = *vehicle_,
                             .folder = folder,
                             .info = runInfo(setup_.scenario, *vehicle_),
                             .web = web_,
                             .groot = number == 0 ? hooks_.groot : nullptr,
                             .sinks = {&truth_, &operator_},
                             .reference = &truth_,
                             .when_silent = interfaces::Outcome::kCrashed};
  if (visual_odometry_) flown.sinks.push_back(visual_odometry_.get());
  return flown;
}

void SimulatedVehicleFlight::begin() {
  for (const common::Problem& warning : vehicle_->world().warnings)
    flight_.tell(common::Severity::kWarning, "world", toString(warning), "");
  flight_.begin();
}

void SimulatedVehicleFlight::step(common::Time now) {
  if (web_ != nullptr) vehicle_->setCameraConsumer(web_->cameraWanted());
  for (const common::OperatorCommand& command : script_.due(now)) flight_.commands().push(command);
  flight_.step(now);
}

bool SimulatedVehicleFlight::over() {
  if (flight_.now().seconds() >= setup_.time_limit_s)
    flight_.end(interfaces::Outcome::kStopped, "the time limit is over");
  return flight_.over();
}

void SimulatedVehicleFlight::finish(double wall_s, flight::MemoryWatch& memory) {
  flight_.finish(wall_s, memory, [this](interfaces::FlightEnd& end) {
    if (!hooks_.score) return;
    evaluation::FlightRecord record = recorder_.finish();
    if (visual_odometry_) record.visual_odometry = visual_odometry_->record();
    record.operator_answers = script_.answers();
    // The setpoint of the tick in which an emergency landing feels the ground still has the motors on.
    if (flight_.finished()) record.motors_off = true;
    hooks_.score(record, *vehicle_, end);
  });
  vehicle_.reset();
}

}  // namespace swiftlet::simulated_flight
