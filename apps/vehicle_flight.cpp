#include "apps/vehicle_flight.hpp"

#include <utility>

#include "apps/flight_sinks.hpp"
#include "apps/groot_link.hpp"
#include "apps/web_link.hpp"
#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::apps {
namespace {

using interfaces::Outcome;

autonomy::Autonomy makeAutonomy(const FlightSetup& setup, const std::string& name, behaviors::Mission mission,
                                const std::shared_ptr<JobMeter>& meter) {
  std::optional<autonomy::GivenMap> given;
  if (setup.map) {
    given = setup.map->map;
    given->seed = static_cast<std::uint64_t>(setup.scenario.seed);
  }
  const auto& system = setup.system;
  return autonomy::Autonomy({.config = system.config.autonomy,
                             .vehicle = system.vehicle,
                             .laser = system.laser,
                             .mission = std::move(mission),
                             .jobs = timed(common::makeLockstepJobs(1), meter),
                             .given = given ? &*given : nullptr,
                             .vehicle_name = name,
                             .memory = setup.memory.read.get(),
                             .camera = system.rgbd_camera ? &*system.rgbd_camera : nullptr,
                             .model = system.model ? &*system.model : nullptr,
                             .vertical_laser = system.vertical_laser ? &*system.vertical_laser : nullptr});
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
void addFrameFigures(const autonomy::AutonomyCounts& counts, common::Time now,
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
    const double kB_s = 1e-3 / now.seconds();
    figures.push_back({"radio_kB_s", kB_s * static_cast<double>(radio->bytes)});
    figures.push_back({"radio_raw_kB_s", kB_s * static_cast<double>(radio->raw_bytes)});
    add("radio_frames", radio->sent);
    add("radio_frames_dropped", radio->replaced + radio->late + radio->broken);
    add("radio_frames_halved", radio->halved);
  }
}

}  // namespace

VehicleFlight::VehicleFlight(const FlightSetup& setup, const FlightHooks& hooks,
                             const std::shared_ptr<simulation::Arena>& arena, std::size_t number, FlightMission mission,
                             const std::filesystem::path& folder)
    : setup_(setup),
      hooks_(hooks),
      web_(hooks.web ? &hooks.web->channel(number) : nullptr),
      vehicle_(std::make_unique<simulation::SimulatedVehicle>(arena, number)),
      script_(setup.operator_steps, vehicle_->name()),
      autonomy_(makeAutonomy(setup, vehicle_->name(), std::move(mission.mission), job_meter_)),
      record_(setup, *vehicle_, mission.file, folder, observers(number)),
      loop_(*vehicle_, autonomy_, commands(), record_.sinks()) {
  end_.outcome = Outcome::kFlying;
  if (setup.wait) autonomy_.waitForStart();
  autonomy_.offerMaps(std::move(mission.maps));
  autonomy_.setFilterListener(record_.filterListener());
}

VehicleFlight::~VehicleFlight() = default;

VehicleFlightRecord::Observers VehicleFlight::observers(std::size_t number) {
  VehicleFlightRecord::Observers all;
  all.push_back(std::make_unique<OperatorSink>(script_));
  if (hooks_.event) all.push_back(std::make_unique<EventSink>(hooks_.event));
  if (web_) all.push_back(std::make_unique<PageSink>(*web_));
  if (hooks_.groot && number == 0) all.push_back(std::make_unique<GrootSink>(*hooks_.groot));
  return all;
}

void VehicleFlight::reportWarnings() {
  for (const std::string& warning : vehicle_->world().warnings) tell(common::Severity::kWarning, "world", warning, "");
  if (setup_.memory.read)
    tell(common::Severity::kInfo, "memory", "starts from what earlier flights learned of its thrust", "");
}

void VehicleFlight::tell(common::Severity severity, std::string source, std::string text, std::string reason,
                         common::Concern concern) {
  const common::Event event{loop_.now(),      severity, std::move(source), std::move(text), std::move(reason),
                            vehicle_->name(), concern};
  for (autonomy::FlightSink* sink : record_.sinks()) sink->event(event);
}

common::LosslessQueue<common::OperatorCommand>& VehicleFlight::commands() {
  return web_ ? web_->commands() : own_commands_;
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
  if (web_) vehicle_->setCameraConsumer(web_->cameraWanted());
  landIfAsked();
  for (const common::OperatorCommand& command : script_.due(now)) commands().push(command);
  warnOfUnwrittenFiles();
  if (!loop_.step(now)) end(Outcome::kCrashed, vehicle_->stopReason());
}

bool VehicleFlight::over() {
  if (end_.outcome != Outcome::kFlying) return true;
  if (hooks_.stop && *hooks_.stop) return end(Outcome::kStopped, "stopped from outside");
  if (loop_.now().seconds() >= setup_.time_limit_s) return end(Outcome::kStopped, "the time limit is over");
  if (autonomy_.finished() && cameToRest()) {
    const common::MissionStatus& mission = autonomy_.missionStatus();
    const bool done = mission.state == common::MissionState::kDone;
    return end(done                           ? Outcome::kDone
               : autonomy_.landedByOperator() ? Outcome::kStopped
                                              : Outcome::kFailed,
               mission.reason);
  }
  return false;
}

/// A vehicle whose motors were switched off above the ground still falls, and how it lands is part of its flight.
bool VehicleFlight::cameToRest() {
  constexpr double kLongestFall_s = 2.0;  // From 20 m.
  if (!motors_off_since_) motors_off_since_ = loop_.now();
  return !vehicle_->truth().airborne || (loop_.now() - *motors_off_since_).seconds() > kLongestFall_s;
}

bool VehicleFlight::end(Outcome outcome, std::string reason) {
  end_.outcome = outcome;
  end_.reason = std::move(reason);
  return true;
}

void VehicleFlight::finish(double wall_s, MemoryWatch& memory) {
  loop_.finish();
  record_.writeLast(*autonomy_.world());
  end_.wall_time_s = wall_s;
  end_.machine = machineUse(memory);
  end_.ground_truth_map = record_.truth_map();
  evaluation::FlightRecord record = record_.take();
  record.operator_answers = script_.answers();
  if (hooks_.score) hooks_.score(record, *vehicle_, end_);
  end_.figures.push_back({"late_scans", static_cast<double>(autonomy_.counts().late_scans)});
  addFrameFigures(autonomy_.counts(), loop_.now(), end_.figures);
  if (const std::size_t frames = record_.framesLeftOut(); frames > 0)
    end_.figures.push_back({"rgbd_frames_not_recorded", static_cast<double>(frames)});
  if (const auto& map3d = autonomy_.world()->map3d; map3d && map3d->frame)
    addCameraFigures(map3d->camera, end_.figures);
  if (setup_.memory.kept) record_.keepMemory(autonomy_.learned(), end_);
  record_.finish(end_);
  if (web_) showEnd();
  vehicle_.reset();
}

common::MachineUse VehicleFlight::machineUse(MemoryWatch& memory) const {
  common::MachineUse use{memory.peak_MB(), std::nullopt, std::nullopt};
  if (const std::vector<double> plans_ms = job_meter_->took_ms("planning"); !plans_ms.empty()) {
    use.plan_median_ms = evaluation::quantile(plans_ms, 0.5);
    use.plan_max_ms = evaluation::quantile(plans_ms, 1.0);
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
  web_->world().post(std::move(last));
}

VehicleResult VehicleFlight::result() const {
  const interfaces::RunFolder& folder = record_.folder();
  return {folder.summary().info.vehicle, folder.summary(), folder.path(), record_.failure()};
}

}  // namespace swiftlet::apps
