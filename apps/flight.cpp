#include "apps/flight.hpp"

#include <chrono>
#include <ctime>
#include <mutex>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "apps/pictures.hpp"
#include "apps/wall_clock.hpp"
#include "apps/web_link.hpp"
#include "autonomy/autonomy.hpp"
#include "behaviors/mission.hpp"
#include "common/jobs.hpp"
#include "common/world.hpp"
#include "common/world/mission_layer.hpp"

namespace swiftlet::apps {
namespace {

using interfaces::Outcome;

constexpr double kPicturePeriod_s = 5.0;
constexpr auto kPictureLatency = common::Duration::fromMilliseconds(1000);

class Flight {
 public:
  Flight(const FlightSetup& setup, const FlightHooks& hooks)
      : setup_(setup),
        hooks_(hooks),
        vehicle_(makeVehicle(setup)),
        recorder_(vehicle_->T_world_map(), setup.map ? setup.map->T_world_given : std::nullopt),
        autonomy_(makeAutonomy(setup)),
        folder_(folderOf(setup), runInfo(setup), setup.system.toYaml(true)) {}

  FlightResult fly() {
    for (const std::string& warning : vehicle_->world().warnings)
      tell({now_, common::Severity::kWarning, "world", warning, ""});
    while (!over()) {
      now_ += common::kControlPeriod;
      step();
      pace();
    }
    return finish();
  }

 private:
  static std::unique_ptr<simulation::SimulatedVehicle> makeVehicle(const FlightSetup& setup) {
    simulation::Scenario scenario = setup.scenario;
    scenario.vehicle = setup.system.vehicle;
    scenario.laser = setup.system.laser;
    static std::mutex sdformat_is_not_thread_safe;
    const std::scoped_lock lock(sdformat_is_not_thread_safe);
    return std::make_unique<simulation::SimulatedVehicle>(simulation::loadWorld(scenario.world, scenario.model_paths),
                                                          scenario);
  }

  static autonomy::Autonomy makeAutonomy(const FlightSetup& setup) {
    std::optional<autonomy::GivenMap> given;
    if (setup.map) {
      given = setup.map->map;
      given->seed = static_cast<std::uint64_t>(setup.scenario.seed);
    }
    return autonomy::Autonomy(setup.system.config.autonomy, setup.system.vehicle, setup.system.laser,
                              behaviors::Mission::fromFile(setup.mission_file), common::makeLockstepJobs(1),
                              given ? &*given : nullptr);
  }

  static std::filesystem::path folderOf(const FlightSetup& setup) {
    if (!setup.out.empty()) return setup.out;
    return interfaces::freshRunFolder("runs", setup.started, runInfo(setup).mission);
  }

  static interfaces::RunInfo runInfo(const FlightSetup& setup) {
    interfaces::RunInfo info;
    info.mission = std::filesystem::path(setup.mission_file).stem().string();
    info.mission_file = setup.mission_file;
    info.world = setup.scenario.world;
    info.system = setup.system.name;
    if (setup.map) info.given_map = setup.map->name;
    info.seed = setup.scenario.seed;
    info.version = SWIFTLET_VERSION;
    info.started = setup.started;
    return info;
  }

  bool over() {
    if (outcome_ != Outcome::kFlying) return true;
    if (hooks_.stop && *hooks_.stop) return end(Outcome::kStopped, "stopped from outside");
    if (now_.seconds() >= setup_.time_limit_s) return end(Outcome::kStopped, "the time limit is over");
    if (folder_.failure()) return end(Outcome::kStopped, *folder_.failure());
    if (autonomy_.finished()) {
      const common::MissionStatus& mission = autonomy_.missionStatus();
      const bool done = mission.state == common::MissionState::kDone;
      return end(done                           ? Outcome::kDone
                 : autonomy_.landedByOperator() ? Outcome::kStopped
                                                : Outcome::kFailed,
                 mission.reason);
    }
    return false;
  }

  bool end(Outcome outcome, std::string reason) {
    outcome_ = outcome;
    reason_ = std::move(reason);
    return true;
  }

  void step() {
    sensor_events_.clear();
    if (hooks_.web) vehicle_->setCameraConsumer(hooks_.web->cameraWanted());
    const bool alive = vehicle_->advanceTo(now_, sensor_events_);
    for (const common::SensorEvent& event : sensor_events_) {
      const auto* frame = std::get_if<std::shared_ptr<const common::CameraFrame>>(&event);
      if (frame && hooks_.web) {
        hooks_.web->camera().post(*frame);
      } else {
        autonomy_.process(event);
      }
    }
    if (hooks_.web)
      for (const common::OperatorCommand& command : hooks_.web->takeCommands()) autonomy_.process(command, now_);
    vehicle_->apply(autonomy_.tick(now_));
    publish();
    if (alive) return;
    tell({now_, common::Severity::kError, "vehicle", "the flight has ended", vehicle_->stopReason()});
    end(Outcome::kCrashed, vehicle_->stopReason());
  }

  void publish() {
    jobs_->deliverDue(now_);
    const common::VehicleState state = autonomy_.state();
    folder_.state(state);
    recorder_.tick(vehicle_->truth(), state);
    recorder_.intent(now_, autonomy_.intent(), autonomy_.intentStatus());
    if (const auto world = autonomy_.world(); world != last_world_) {
      last_world_ = world;
      if (hooks_.web) hooks_.web->world().post(world);
      recorder_.world(*world);
      folder_.world(*world);
      if ((now_ - last_picture_).seconds() >= kPicturePeriod_s) submitPictures();
    }
    for (const common::Event& event : autonomy_.takeEvents()) tell(event);
    for (common::CommandResult& result : autonomy_.takeResults())
      if (hooks_.web) hooks_.web->postResult(std::move(result));
  }

  void tell(const common::Event& event) {
    folder_.event(event);
    if (hooks_.event) hooks_.event(event);
    if (hooks_.web) hooks_.web->postEvent(event);
  }

  /// Drawn beside the flight; they take about as long as half a second of it.
  void submitPictures() {
    if (!jobs_->idle("pictures")) return;
    last_picture_ = now_;
    jobs_->submit("pictures", now_, kPictureLatency,
                  [this, world = last_world_, summary = folder_.summary(), truth = recorder_.record().truth_map,
                   hull_m = setup_.system.vehicle.hull_diameter_m]() -> common::JobRunner::Deliver {
                    auto pictures = reportPictures(*world, summary, truth, hull_m);
                    return [this, pictures = std::move(pictures)](common::Time) { folder_.show(pictures); };
                  });
  }

  void pace() {
    const double wall_s = secondsSince(begin_);
    if (hooks_.progress && wall_s - last_progress_s_ >= 0.1) {
      last_progress_s_ = wall_s;
      hooks_.progress({autonomy_.world(), now_.seconds(), wall_s});
    }
    if (setup_.speed <= 0.0) return;
    const auto due = begin_ + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(now_.seconds() / setup_.speed));
    std::this_thread::sleep_until(due);
  }

  FlightResult finish() {
    const double wall_s = secondsSince(begin_);
    if (hooks_.progress) hooks_.progress({autonomy_.world(), now_.seconds(), wall_s});
    folder_.show(reportPictures(*autonomy_.world(), folder_.summary(), recorder_.record().truth_map,
                                setup_.system.vehicle.hull_diameter_m));
    interfaces::FlightEnd end;
    end.outcome = outcome_;
    end.reason = reason_;
    end.wall_time_s = wall_s;
    if (hooks_.score) hooks_.score(recorder_.finish(), *vehicle_, end);
    folder_.finish(end);
    if (hooks_.web) {
      auto last = std::make_shared<common::World>(*autonomy_.world());
      auto mission = std::make_shared<common::MissionLayer>(*last->mission);
      mission->ending = {std::string(interfaces::toString(outcome_)), reason_};
      last->mission = std::move(mission);
      hooks_.web->world().post(std::move(last));
    }
    FlightResult result;
    result.summary = folder_.summary();
    result.folder = folder_.path();
    result.write_failure = folder_.failure();
    linger();
    return result;
  }

  /// So that the pages see how it ended.
  void linger() const {
    const Clock::time_point begin = Clock::now();
    while (secondsSince(begin) < setup_.linger_s && !(hooks_.stop && *hooks_.stop))
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  const FlightSetup& setup_;
  const FlightHooks& hooks_;
  std::unique_ptr<simulation::SimulatedVehicle> vehicle_;
  evaluation::FlightRecorder recorder_;
  autonomy::Autonomy autonomy_;
  interfaces::RunFolder folder_;

  common::Time now_;
  std::vector<common::SensorEvent> sensor_events_;
  std::shared_ptr<const common::World> last_world_;
  common::Time last_picture_;
  Outcome outcome_ = Outcome::kFlying;
  std::string reason_;
  Clock::time_point begin_ = Clock::now();
  double last_progress_s_ = 0.0;
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(1);  ///< Last: its jobs use what is above.
};

}  // namespace

FlightResult flySimulated(const FlightSetup& setup, const FlightHooks& hooks) { return Flight(setup, hooks).fly(); }

std::string startedNow() { return fmt::format("{:%Y-%m-%d_%H-%M-%S}", fmt::localtime(std::time(nullptr))); }

}  // namespace swiftlet::apps
