#include "apps/flight.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "apps/files_of_kind.hpp"
#include "apps/mission_limits.hpp"
#include "apps/trial_world.hpp"
#include "apps/vehicle_flight.hpp"
#include "apps/wall_clock.hpp"
#include "interfaces/run_files.hpp"
#include "simulation/arena.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<simulation::Arena> makeArena(const FlightSetup& setup) {
  simulation::Scenario scenario = setup.scenario;
  scenario.vehicle = setup.system.vehicle;
  scenario.laser = setup.system.laser;
  scenario.rgbd_camera = setup.system.rgbd_camera;
  scenario.vertical_laser = setup.system.vertical_laser;
  static std::mutex sdformat_is_not_thread_safe;
  const std::scoped_lock lock(sdformat_is_not_thread_safe);
  return std::make_shared<simulation::Arena>(loadWorldOf(scenario), scenario);
}

fs::path folderOf(const FlightSetup& setup) {
  if (setup.out.empty())
    return interfaces::freshRunFolder("runs", setup.started, fs::path(setup.mission_file).stem().string());
  checkFlightFolder(setup.out, setup.scenario);
  return setup.out;
}

/// The vehicles of one arena, tick by tick, and the pace of simulated time.
class Flight {
 public:
  Flight(const FlightSetup& setup, std::vector<FlightMission> missions, const FlightHooks& hooks)
      : setup_(setup), hooks_(hooks) {
    if (setup.record_rgbd) requireCamera(setup.system);
    const auto arena = makeArena(setup);
    folder_ = folderOf(setup);
    const std::vector<std::string> names = vehicleNames(setup.scenario);
    for (std::size_t i = 0; i < missions.size(); ++i)
      vehicles_.push_back(std::make_unique<VehicleFlight>(setup, hooks, arena, i, std::move(missions[i]),
                                                          names.empty() ? folder_ : folder_ / names[i]));
  }

  FlightResult fly() {
    for (const auto& vehicle : vehicles_) vehicle->reportWarnings();
    while (anyFlies()) {
      now_ += common::kControlPeriod;
      for (const auto& vehicle : vehicles_)
        if (!vehicle->finished()) vehicle->step(now_);
      pace();
    }
    if (hooks_.progress) hooks_.progress(progress(secondsSince(begin_)));
    FlightResult result{folder_, {}};
    for (const auto& vehicle : vehicles_) result.vehicles.push_back(vehicle->result());
    linger();
    return result;
  }

 private:
  /// Those that are over are finished: the others fly on without them.
  bool anyFlies() {
    bool any = false;
    for (const auto& vehicle : vehicles_) {
      if (vehicle->finished()) continue;
      if (vehicle->over())
        vehicle->finish(secondsSince(begin_), memory_);
      else
        any = true;
    }
    return any;
  }

  FlightProgress progress(double wall_s) const {
    FlightProgress progress{{}, now_.seconds(), wall_s};
    for (const auto& vehicle : vehicles_) progress.worlds.push_back(vehicle->world());
    return progress;
  }

  void pace() {
    memory_.look();
    const double wall_s = secondsSince(begin_);
    if (hooks_.progress && wall_s - last_progress_s_ >= 0.1) {
      last_progress_s_ = wall_s;
      hooks_.progress(progress(wall_s));
    }
    if (setup_.speed <= 0.0) return;
    const auto due = begin_ + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(now_.seconds() / setup_.speed));
    std::this_thread::sleep_until(due);
  }

  /// Keeps the server up, so that the pages show how the flight ended. After a stop by the user it does so only
  /// briefly.
  void linger() const {
    constexpr double kEnoughForPages_s = 0.5;  // Several snapshots of the page.
    const Clock::time_point begin = Clock::now();
    const auto enough_s = [&] {
      const bool in_haste = hooks_.stop && *hooks_.stop;
      return in_haste ? std::min(kEnoughForPages_s, setup_.linger_s) : setup_.linger_s;
    };
    while (secondsSince(begin) < enough_s()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  const FlightSetup& setup_;
  const FlightHooks& hooks_;
  fs::path folder_;
  std::vector<std::unique_ptr<VehicleFlight>> vehicles_;
  common::Time now_;
  MemoryWatch memory_;
  Clock::time_point begin_ = Clock::now();
  double last_progress_s_ = 0.0;
};

}  // namespace

bool FlightResult::done() const {
  return std::all_of(vehicles.begin(), vehicles.end(),
                     [](const auto& vehicle) { return vehicle.summary.outcome == interfaces::Outcome::kDone; });
}

std::optional<std::string> FlightResult::writeFailure() const {
  for (const VehicleResult& vehicle : vehicles)
    if (vehicle.write_failure) return vehicle.write_failure;
  return std::nullopt;
}

std::vector<std::string> vehicleNames(const simulation::Scenario& scenario) {
  std::vector<std::string> names;
  for (const simulation::ScenarioVehicle& vehicle : scenario.vehicles) names.push_back(vehicle.name);
  return names;
}

void checkFlightFolder(const fs::path& folder, const simulation::Scenario& scenario) {
  if (scenario.vehicles.empty()) return interfaces::checkRunFolder(folder);
  if (fs::exists(folder / "mission.json"))
    throw common::InputError(common::Problem{{folder.string()},
                                             "--out",
                                             "holds the run of one vehicle, among whose files several would be lost",
                                             "give an empty or new folder"});
  for (const std::string& name : vehicleNames(scenario)) interfaces::checkRunFolder(folder / name);
}

void requireCamera(const System& system) {
  if (system.rgbd_camera) return;
  throw common::InputError(common::Problem{{},
                                           "--record-rgbd",
                                           "the vehicle of `" + system.name + "` has no RGB-D camera",
                                           "`--system swiftlet_3d` has one"});
}

std::vector<FlightMission> soundMissions(const FlightSetup& setup, bool has_map) {
  std::vector<FlightMission> missions;
  std::map<std::string, std::vector<common::Problem>> problems;  // By file: several may fly a wrong one.
  for (const std::string& file : missionFiles(setup.scenario, setup.mission_file)) {
    try {
      const std::string found = findMission(file);
      behaviors::Mission mission =
          behaviors::Mission::fromFile(found, missionLimits(setup.system, has_map), setup.types);
      std::vector<autonomy::OfferedMap> maps =
          offeredMaps(mission.mapFiles(), found, static_cast<std::uint64_t>(setup.scenario.seed));
      missions.push_back({found, std::move(mission), std::move(maps)});
    } catch (const common::InputError& wrong) {
      problems[file] = wrong.problems();
    }
  }
  std::vector<common::Problem> all = problemsOfSensors(setup.system);
  for (const auto& [file, of_file] : problems) all.insert(all.end(), of_file.begin(), of_file.end());
  if (!all.empty()) throw common::InputError(std::move(all));
  return missions;
}

FlightResult flySimulated(const FlightSetup& setup, std::vector<FlightMission> missions, const FlightHooks& hooks) {
  return Flight(setup, std::move(missions), hooks).fly();
}

std::string startedNow() { return fmt::format("{:%Y-%m-%d_%H-%M-%S}", fmt::localtime(std::time(nullptr))); }

}  // namespace swiftlet::apps
