#include "apps/flight.hpp"

#include <chrono>
#include <ctime>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "apps/flight_sinks.hpp"
#include "apps/picture_sink.hpp"
#include "apps/wall_clock.hpp"
#include "apps/web_link.hpp"
#include "autonomy/autonomy.hpp"
#include "autonomy/flight_loop.hpp"
#include "common/mailbox.hpp"
#include "common/world.hpp"
#include "common/world/mission_layer.hpp"

namespace swiftlet::apps {
namespace {

using interfaces::Outcome;

std::unique_ptr<simulation::SimulatedVehicle> makeVehicle(const FlightSetup& setup) {
  simulation::Scenario scenario = setup.scenario;
  scenario.vehicle = setup.system.vehicle;
  scenario.laser = setup.system.laser;
  static std::mutex sdformat_is_not_thread_safe;
  const std::scoped_lock lock(sdformat_is_not_thread_safe);
  return std::make_unique<simulation::SimulatedVehicle>(simulation::loadWorld(scenario.world, scenario.model_paths),
                                                        scenario);
}

autonomy::Autonomy makeAutonomy(const FlightSetup& setup, behaviors::Mission mission) {
  std::optional<autonomy::GivenMap> given;
  if (setup.map) {
    given = setup.map->map;
    given->seed = static_cast<std::uint64_t>(setup.scenario.seed);
  }
  return autonomy::Autonomy(setup.system.config.autonomy, setup.system.vehicle, setup.system.laser, std::move(mission),
                            common::makeLockstepJobs(1), given ? &*given : nullptr);
}

interfaces::RunInfo runInfo(const FlightSetup& setup) {
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

std::filesystem::path folderOf(const FlightSetup& setup) {
  if (!setup.out.empty()) return setup.out;
  return interfaces::freshRunFolder("runs", setup.started, runInfo(setup).mission);
}

/// One vehicle, its autonomy, the loop between them with its sinks, and the pace of simulated time.
class Flight {
 public:
  Flight(const FlightSetup& setup, behaviors::Mission mission, const FlightHooks& hooks)
      : setup_(setup),
        hooks_(hooks),
        vehicle_(makeVehicle(setup)),
        recorder_(vehicle_->T_world_map(), setup.map ? setup.map->T_world_given : std::nullopt),
        autonomy_(makeAutonomy(setup, std::move(mission))),
        folder_(folderOf(setup), runInfo(setup), setup.system.toYaml(true)),
        pictures_(folder_, recorder_, setup.system.vehicle.hull_diameter_m),
        sinks_(makeSinks()),
        loop_(*vehicle_, autonomy_, hooks.web ? hooks.web->commands() : no_commands_, sinks()) {}

  FlightResult fly() {
    for (const std::string& warning : vehicle_->world().warnings)
      for (autonomy::FlightSink* sink : sinks())
        sink->event({loop_.now(), common::Severity::kWarning, "world", warning, ""});
    while (!over()) {
      if (hooks_.web) vehicle_->setCameraConsumer(hooks_.web->cameraWanted());
      if (!loop_.step(loop_.now() + common::kControlPeriod)) end(Outcome::kCrashed, vehicle_->stopReason());
      pace();
    }
    loop_.finish();
    return finish();
  }

 private:
  std::vector<std::unique_ptr<autonomy::FlightSink>> makeSinks() {
    std::vector<std::unique_ptr<autonomy::FlightSink>> sinks;
    sinks.push_back(std::make_unique<FolderSink>(folder_));
    sinks.push_back(std::make_unique<TruthSink>(*vehicle_, recorder_));
    if (hooks_.event) sinks.push_back(std::make_unique<EventSink>(hooks_.event));
    if (hooks_.web) sinks.push_back(std::make_unique<PageSink>(*hooks_.web));
    return sinks;
  }

  /// The pictures come last, because they show what the other sinks have written.
  std::vector<autonomy::FlightSink*> sinks() {
    std::vector<autonomy::FlightSink*> all;
    for (const auto& sink : sinks_) all.push_back(sink.get());
    all.push_back(&pictures_);
    return all;
  }

  bool over() {
    if (outcome_ != Outcome::kFlying) return true;
    if (hooks_.stop && *hooks_.stop) return end(Outcome::kStopped, "stopped from outside");
    if (loop_.now().seconds() >= setup_.time_limit_s) return end(Outcome::kStopped, "the time limit is over");
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

  void pace() {
    const double wall_s = secondsSince(begin_);
    if (hooks_.progress && wall_s - last_progress_s_ >= 0.1) {
      last_progress_s_ = wall_s;
      hooks_.progress({autonomy_.world(), loop_.now().seconds(), wall_s});
    }
    if (setup_.speed <= 0.0) return;
    const auto due = begin_ + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(loop_.now().seconds() / setup_.speed));
    std::this_thread::sleep_until(due);
  }

  FlightResult finish() {
    const double wall_s = secondsSince(begin_);
    if (hooks_.progress) hooks_.progress({autonomy_.world(), loop_.now().seconds(), wall_s});
    pictures_.drawNow(*autonomy_.world());
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

  /// The pages need time to show how the flight ended.
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
  PictureSink pictures_;
  std::vector<std::unique_ptr<autonomy::FlightSink>> sinks_;
  common::LosslessQueue<common::OperatorCommand> no_commands_;
  autonomy::FlightLoop loop_;

  Outcome outcome_ = Outcome::kFlying;
  std::string reason_;
  Clock::time_point begin_ = Clock::now();
  double last_progress_s_ = 0.0;
};

}  // namespace

FlightResult flySimulated(const FlightSetup& setup, behaviors::Mission mission, const FlightHooks& hooks) {
  return Flight(setup, std::move(mission), hooks).fly();
}

std::string startedNow() { return fmt::format("{:%Y-%m-%d_%H-%M-%S}", fmt::localtime(std::time(nullptr))); }

}  // namespace swiftlet::apps
