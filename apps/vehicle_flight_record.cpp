#include "apps/vehicle_flight_record.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "apps/build_version.hpp"
#include "apps/flight_sinks.hpp"
#include "evaluation/knowable_frame.hpp"
#include "interfaces/run_files.hpp"
#include "simulation/nature.hpp"

namespace swiftlet::apps {
namespace {

std::unique_ptr<VisualOdometrySink> visualOdometryOf(const FlightSetup& setup) {
  if (!setup.visual_odometry_alone || !setup.system.rgbd_camera) return nullptr;
  return std::make_unique<VisualOdometrySink>(setup.system.config.autonomy.estimator.rgbd.mapper,
                                              setup.system.rgbd_camera->mount.pose());
}

std::unique_ptr<RgbdSink> rgbdSinkOf(const FlightSetup& setup, const interfaces::RunFolder& folder,
                                     const simulation::SimulatedVehicle& vehicle) {
  if (!setup.record_rgbd) return nullptr;
  return std::make_unique<RgbdSink>(
      folder.path(), vehicle, vehicle.scenario().sensors.rgbd_errors.T_body_camera(setup.system.rgbd_camera->mount));
}

interfaces::RunInfo runInfo(const FlightSetup& setup, const simulation::SimulatedVehicle& vehicle,
                            const std::string& mission_file) {
  interfaces::RunInfo info;
  info.mission = std::filesystem::path(mission_file).stem().string();
  info.mission_file = mission_file;
  info.world = setup.scenario.world;
  info.system = setup.system.name;
  info.vehicle = vehicle.name();
  info.seed = setup.scenario.seed;
  info.version = buildVersion();
  info.started = setup.started;
  const simulation::Nature calm = simulation::Nature::calm();
  const simulation::Nature& nature = setup.scenario.nature ? *setup.scenario.nature : calm;
  info.nature = nature.name();
  info.nature_yaml = nature.valuesIn(vehicle.scenario());
  info.sheets = setup.system.keptSheets();
  if (setup.memory.read) info.vehicle_memory_yaml = toYaml(*setup.memory.read);
  return info;
}

}  // namespace

VehicleFlightRecord::VehicleFlightRecord(const FlightSetup& setup, simulation::SimulatedVehicle& vehicle,
                                         const std::string& mission_file, const std::filesystem::path& folder,
                                         Observers observers)
    : setup_(setup),
      recorder_(vehicle.T_world_map(),
                evaluation::knowableFrame(vehicle.T_world_map(), vehicle.scenario().sensors.laser_errors),
                setup.map ? setup.map->T_world_given : std::nullopt),
      folder_(folder, runInfo(setup, vehicle, mission_file), setup.system.namingKeptSheets().toYaml(true)),
      control_log_(setup.control_log ? std::make_unique<ControlLogSink>(folder_.path(), vehicle) : nullptr),
      rgbd_(rgbdSinkOf(setup, folder_, vehicle)),
      visual_odometry_(visualOdometryOf(setup)),
      pictures_(folder_, recorder_, setup.system.vehicle.hull_diameter_m),
      map3d_(folder_) {
  recorder_.watch(setup.phases);
  sinks_.push_back(std::make_unique<FolderSink>(folder_));
  sinks_.push_back(std::make_unique<TruthSink>(vehicle, recorder_));
  std::move(observers.begin(), observers.end(), std::back_inserter(sinks_));
}

std::vector<autonomy::FlightSink*> VehicleFlightRecord::sinks() {
  std::vector<autonomy::FlightSink*> all;
  for (const auto& sink : sinks_) all.push_back(sink.get());
  if (control_log_) all.push_back(control_log_.get());
  if (rgbd_) all.push_back(rgbd_.get());
  if (visual_odometry_) all.push_back(visual_odometry_.get());
  all.push_back(&pictures_);
  all.push_back(&map3d_);
  return all;
}

void VehicleFlightRecord::writeLast(const common::World& world) {
  pictures_.drawNow(world);
  map3d_.writeNow(world);
  if (control_log_) control_log_->finish();
}

evaluation::FlightRecord VehicleFlightRecord::take() {
  evaluation::FlightRecord record = recorder_.finish();
  if (visual_odometry_) record.visual_odometry = visual_odometry_->record();
  return record;
}

/// A crash contains no lesson for the next flight.
void VehicleFlightRecord::keepMemory(const autonomy::VehicleMemory& learned, interfaces::FlightEnd& end) {
  end.vehicle_memory_yaml = toYaml(learned);
  if (setup_.memory.file.empty() || end.outcome == interfaces::Outcome::kCrashed) return;
  if (const auto written = writeVehicleMemory(setup_.memory.file, learned); !written)
    memory_failure_ = fmt::format("--vehicle-memory: cannot be written: {}; what was learned is in {}",
                                  written.error().message, (folder_.path() / interfaces::kMemoryLearnedFile).string());
}

std::optional<std::string> VehicleFlightRecord::failure() const {
  if (memory_failure_) return memory_failure_;
  if (folder_.failure()) return folder_.failure();
  if (control_log_ && control_log_->failure()) return control_log_->failure();
  return rgbd_ ? rgbd_->failure() : std::nullopt;
}

}  // namespace swiftlet::apps
