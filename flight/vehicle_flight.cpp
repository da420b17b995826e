#include "flight/vehicle_flight.hpp"

#include <utility>

#include "common/quantile.hpp"
#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "flight/build_version.hpp"
#include "flight/flight_sinks.hpp"
#include "flight/groot_link.hpp"
#include "flight/motion_reference.hpp"
#include "flight/web_link.hpp"

namespace swiftlet::flight {
namespace {

using interfaces::Outcome;

autonomy::Autonomy makeAutonomy(const FlightSetup& setup, const interfaces::RunInfo& info, behaviors::Mission mission,
                                std::unique_ptr<common::JobRunner> jobs) {
  std::optional<autonomy::GivenMap> given;
  if (setup.map) {
    given = setup.map->map;
    given->seed = static_cast<std::uint64_t>(info.seed);
  }
  const System& system = setup.system;
  return autonomy::Autonomy({.config = system.config.autonomy,
                             .vehicle = system.vehicle,
                             .laser = system.laser,
                             .mission = std::move(mission),
                             .jobs = std::move(jobs),
                             .given = given ? &*given : nullptr,
                             .vehicle_name = info.vehicle,
                             .memory = setup.memory.read.get(),
                             .camera = system.rgbd_camera ? &*system.rgbd_camera : nullptr,
                             .model = system.model ? &*system.model : nullptr,
                             .places = setup.places,
                             .vertical_laser = system.vertical_laser ? &*system.vertical_laser : nullptr});
}

interfaces::RunInfo runInfo(const FlightSetup& setup, interfaces::RunInfo info, const std::string& mission_file) {
  info.mission = std::filesystem::path(mission_file).stem().string();
  info.mission_file = mission_file;
  info.system = setup.system.name;
  info.version = buildVersion();
  info.started = setup.started;
  info.sheets = setup.system.keptSheets();
  if (setup.memory.read) info.vehicle_memory_yaml = toYaml(*setup.memory.read);
  return info;
}

/// Where the camera was found to be mounted and how late its clock is.
void addCameraFigures(const common::CameraEstimate& camera, std::vector<interfaces::Figure>& figures) {
  const common::RollPitchYaw mount = common::rollPitchYaw(camera.T_body_camera.rotation);
  const Eigen::Vector3d& sigma_rad = camera.mount_sigma_rad;
  const auto add = [&](const char* name, double value) { figures.push_back({name, value}); };
  add("camera_roll_deg", mount.roll_rad / common::kRadPerDeg);
  add("camera_roll_sigma_deg", sigma_rad.x() / common::kRadPerDeg);
  add("camera_pitch_deg", mount.pitch_rad / common::kRadPerDeg);
  add("camera_pitch_sigma_deg", sigma_rad.y() / common::kRadPerDeg);
  add("camera_yaw_deg", mount.yaw_rad / common::kRadPerDeg);
  add("camera_yaw_sigma_deg", sigma_rad.z() / common::kRadPerDeg);
  add("camera_clock_offset_s", camera.clock_offset_s);
  add("camera_clock_sigma_s", camera.clock_sigma_s);
}

/// What became of the camera's frames.
void addFrameFigures(const autonomy::AutonomyCounts& counts, common::Duration flown,
                     std::vector<interfaces::Figure>& figures) {
  const auto add = [&](const char* name, std::uint64_t count) {
    figures.push_back({name, static_cast<double>(count)});
  };
  if (const auto& camera = counts.estimator.camera) {
    add("camera_frames", camera->frames);
    add("camera_frames_skipped", camera->skipped);
    add("camera_frames_blank", camera->blank);
    add("camera_frames_lost", camera->lost);
  }
  if (const auto& radio = counts.estimator.radio) {
    const double kB_s = 1e-3 / flown.seconds();
    figures.push_back({"radio_kB_s", kB_s * static_cast<double>(radio->bytes)});
    figures.push_back({"radio_raw_kB_s", kB_s * static_cast<double>(radio->raw_bytes)});
    add("radio_frames", radio->sent);
    add("radio_frames_dropped", radio->replaced + radio->late + radio->broken);
    add("radio_frames_halved", radio->halved);
  }
}

}  // namespace

VehicleFlight::VehicleFlight(const FlightSetup& setup, const FlightHooks& hooks, FlownVehicle flown,
                             FlightMission mission, std::unique_ptr<common::JobRunner> jobs)
    : setup_(setup),
      hooks_(hooks),
      flown_(std::move(flown)),
      autonomy_(makeAutonomy(setup, flown_.info, std::move(mission.mission), timed(std::move(jobs), job_meter_))),
      record_(setup, runInfo(setup, flown_.info, mission.file), flown_.folder, flown_.reference),
      loop_(flown_.vehicle, autonomy_, commands(), sinks()),
      begin_(loop_.now()) {
  end_.outcome = Outcome::kFlying;
  if (setup.wait) autonomy_.waitForStart();
  autonomy_.offerMaps(std::move(mission.maps));
  autonomy_.setFilterListener(record_.filterListener());
}

VehicleFlight::~VehicleFlight() = default;

std::vector<autonomy::FlightSink*> VehicleFlight::sinks() {
  if (hooks_.event) watchers_.push_back(std::make_unique<EventSink>(hooks_.event));
  if (flown_.web) watchers_.push_back(std::make_unique<PageSink>(*flown_.web));
  if (flown_.groot) watchers_.push_back(std::make_unique<GrootSink>(*flown_.groot));
  std::vector<autonomy::FlightSink*> all = flown_.sinks;
  for (const auto& watcher : watchers_) all.push_back(watcher.get());
  const std::vector<autonomy::FlightSink*> kept = record_.sinks();
  all.insert(all.end(), kept.begin(), kept.end());
  return all;
}

void VehicleFlight::tell(common::Severity severity, std::string source, std::string text, std::string reason,
                         common::Concern concern) {
  loop_.tell({loop_.now(), severity, std::move(source), std::move(text), std::move(reason), {}, concern});
}

common::LosslessQueue<common::OperatorCommand>& VehicleFlight::commands() {
  return flown_.web ? flown_.web->commands() : own_commands_;
}

void VehicleFlight::begin() {
  if (setup_.memory.read)
    tell(common::Severity::kInfo, "memory", "starts from what earlier flights learned of its thrust", "");
}

/// The answer has no client, so its id is one that no page uses.
void VehicleFlight::landIfAsked() {
  if (asked_to_land_ || !hooks_.land || !*hooks_.land) return;
  asked_to_land_ = true;
  tell(common::Severity::kWarning, "program", "asked to end: landing", "asked again, it stops at once",
       common::Concern::kLanding);
  commands().push({0, common::LandCommand{}});
}

/// The flight continues; only its record is lost.
void VehicleFlight::warnOfUnwrittenFiles() {
  const std::optional<std::string>& failure = record_.folder().failure();
  if (warned_of_unwritten_files_ || !failure) return;
  warned_of_unwritten_files_ = true;
  tell(common::Severity::kWarning, "record", "the run is no longer recorded; the flight goes on", *failure);
}

void VehicleFlight::step(common::Time now) {
  landIfAsked();
  warnOfUnwrittenFiles();
  if (!loop_.step(now)) end(flown_.when_silent, flown_.vehicle.stopReason());
}

void VehicleFlight::end(Outcome outcome, std::string reason) {
  if (end_.outcome != Outcome::kFlying) return;
  end_.outcome = outcome;
  end_.reason = std::move(reason);
}

bool VehicleFlight::over() {
  if (hooks_.stop && *hooks_.stop) end(Outcome::kStopped, "stopped from outside");
  if (end_.outcome == Outcome::kFlying && autonomy_.finished() && cameToRest()) {
    const common::MissionStatus& mission = autonomy_.missionStatus();
    const bool done = mission.state == common::MissionState::kDone;
    end(done ? Outcome::kDone : autonomy_.landedByOperator() ? Outcome::kStopped : Outcome::kFailed, mission.reason);
  }
  return end_.outcome != Outcome::kFlying;
}

/// A vehicle whose motors were switched off above the ground still falls, and how it lands is part of its flight.
bool VehicleFlight::cameToRest() {
  constexpr double kLongestFall_s = 2.0;  // From 20 m.
  if (!motors_off_since_) motors_off_since_ = loop_.now();
  const bool seen_at_rest = flown_.reference != nullptr && !flown_.reference->airborne();
  return seen_at_rest || (loop_.now() - *motors_off_since_).seconds() > kLongestFall_s;
}

void VehicleFlight::finish(double wall_s, MemoryWatch& memory, const std::function<void(interfaces::FlightEnd&)>& add) {
  loop_.finish();
  record_.writeLast(*autonomy_.world());
  end_.wall_time_s = wall_s;
  end_.machine = machineUse(memory);
  if (flown_.reference) end_.ground_truth_map = flown_.reference->path_map();
  if (add) add(end_);
  end_.figures.push_back({"late_scans", static_cast<double>(autonomy_.counts().late_scans)});
  addFrameFigures(autonomy_.counts(), loop_.now() - begin_, end_.figures);
  if (const auto& map3d = autonomy_.world()->map3d; map3d && map3d->frame)
    addCameraFigures(map3d->camera, end_.figures);
  record_.finish(autonomy_.learned(), end_);
  if (flown_.web) showEnd();
}

common::MachineUse VehicleFlight::machineUse(MemoryWatch& memory) const {
  common::MachineUse use{memory.peak_MB(), std::nullopt, std::nullopt};
  if (const std::vector<double> plans_ms = job_meter_->took_ms("planning"); !plans_ms.empty()) {
    use.plan_median_ms = common::quantile(plans_ms, 0.5);
    use.plan_max_ms = common::quantile(plans_ms, 1.0);
  }
  if (!autonomy_.counts().estimator.camera) return use;
  if (const auto ends = job_meter_->ends("mapping3d")) {
    use.frame_first_ms = ends->first_ms;
    use.frame_last_ms = ends->last_ms;
  }
  return use;
}

void VehicleFlight::showEnd() const {
  auto last = std::make_shared<common::World>(*autonomy_.world());
  auto mission = std::make_shared<common::MissionLayer>(*last->mission);
  mission->ending = {std::string(interfaces::toString(end_.outcome)), end_.reason};
  last->mission = std::move(mission);
  flown_.web->world().post(std::move(last));
}

VehicleResult VehicleFlight::result() const {
  const interfaces::RunFolder& folder = record_.folder();
  return {folder.summary().info.vehicle, folder.summary(), folder.path(), record_.failure()};
}

}  // namespace swiftlet::flight
