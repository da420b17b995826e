#include "simulated_flight/flight.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "flight/wall_clock.hpp"
#include "interfaces/run_files.hpp"
#include "simulated_flight/simulated_vehicle_flight.hpp"
#include "simulated_flight/trial_world.hpp"
#include "simulation/arena.hpp"

namespace swiftlet::simulated_flight {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<simulation::Arena> makeArena(const SimulatedSetup& setup) {
  simulation::Scenario scenario = setup.scenario;
  scenario.vehicle = setup.system.vehicle;
  scenario.laser = setup.system.laser;
  scenario.rgbd_camera = setup.system.rgbd_camera;
  scenario.vertical_laser = setup.system.vertical_laser;
  static std::mutex sdformat_is_not_thread_safe;
  const std::scoped_lock lock(sdformat_is_not_thread_safe);
  return std::make_shared<simulation::Arena>(loadWorldOf(scenario), scenario);
}

/// The vehicles of one arena, tick by tick, and the pace of simulated time.
class Flight {
 public:
  Flight(const SimulatedSetup& setup, std::vector<flight::FlightMission> missions, const SimulatedHooks& hooks)
      : hooks_(hooks), pace_(setup.speed) {
    if (setup.record_rgbd) flight::requireCamera(setup.system);
    const auto arena = makeArena(setup);
    if (!setup.out.empty()) checkFlightFolder(setup.out, setup.scenario);
    folder_ = flight::folderOf(setup);
    const std::vector<std::string> names = vehicleNames(setup.scenario);
    for (std::size_t i = 0; i < missions.size(); ++i)
      vehicles_.push_back(std::make_unique<SimulatedVehicleFlight>(setup, hooks, arena, i, std::move(missions[i]),
                                                                   names.empty() ? folder_ : folder_ / names[i]));
  }

  FlightResult fly() {
    for (const auto& vehicle : vehicles_) vehicle->begin();
    while (anyFlies()) {
      now_ += common::kControlPeriod;
      for (const auto& vehicle : vehicles_)
        if (!vehicle->finished()) vehicle->step(now_);
      memory_.look();
      showProgress();
      pace_.waitUntil(now_);
    }
    if (hooks_.progress) hooks_.progress(progress(pace_.wall_s()));
    FlightResult result{folder_, {}};
    for (const auto& vehicle : vehicles_) result.vehicles.push_back(vehicle->result());
    if (hooks_.web) flight::lingerForPages(hooks_.stop);
    return result;
  }

 private:
  /// Those that are over are finished: the others fly on without them.
  bool anyFlies() {
    bool any = false;
    for (const auto& vehicle : vehicles_) {
      if (vehicle->finished()) continue;
      if (vehicle->over())
        vehicle->finish(pace_.wall_s(), memory_);
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

  void showProgress() {
    const double wall_s = pace_.wall_s();
    if (!hooks_.progress || wall_s - last_progress_s_ < 0.1) return;
    last_progress_s_ = wall_s;
    hooks_.progress(progress(wall_s));
  }

  const SimulatedHooks& hooks_;
  fs::path folder_;
  std::vector<std::unique_ptr<SimulatedVehicleFlight>> vehicles_;
  common::Time now_;
  flight::MemoryWatch memory_;
  flight::Pace pace_;
  double last_progress_s_ = 0.0;
};

}  // namespace

bool FlightResult::done() const {
  return std::all_of(vehicles.begin(), vehicles.end(), [](const auto& vehicle) { return vehicle.done(); });
}

std::optional<std::string> FlightResult::writeFailure() const {
  for (const flight::VehicleResult& vehicle : vehicles)
    if (vehicle.write_failure) return vehicle.write_failure;
  return std::nullopt;
}

std::vector<std::string> vehicleNames(const simulation::Scenario& scenario) {
  std::vector<std::string> names;
  for (const simulation::ScenarioVehicle& vehicle : scenario.vehicles) names.push_back(vehicle.name);
  return names;
}

std::vector<std::string> missionFiles(const simulation::Scenario& scenario, const std::string& otherwise) {
  if (scenario.vehicles.empty()) return {otherwise};
  std::vector<std::string> files;
  for (const simulation::ScenarioVehicle& vehicle : scenario.vehicles)
    files.push_back(vehicle.mission.empty() ? otherwise : vehicle.mission);
  return files;
}

std::vector<flight::FlightMission> soundMissions(const SimulatedSetup& setup, bool has_map) {
  return flight::soundMissions(missionFiles(setup.scenario, setup.mission_file), setup, has_map,
                               static_cast<std::uint64_t>(setup.scenario.seed));
}

void checkFlightFolder(const fs::path& folder, const simulation::Scenario& scenario) {
  if (scenario.vehicles.empty()) return interfaces::checkRunFolder(folder);
  if (fs::exists(folder / "mission.json"))
    throw common::InputError(
        {folder.string()}, "--out",
        common::Message("run.of-one-vehicle", "holds the run of one vehicle, among whose files several would be lost"),
        "give an empty or new folder");
  for (const std::string& name : vehicleNames(scenario)) interfaces::checkRunFolder(folder / name);
}

FlightResult flySimulated(const SimulatedSetup& setup, std::vector<flight::FlightMission> missions,
                          const SimulatedHooks& hooks) {
  return Flight(setup, std::move(missions), hooks).fly();
}

}  // namespace swiftlet::simulated_flight
