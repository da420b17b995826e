// The settings of a flight, who watches it, and its result: the same for a real vehicle and for a simulated one.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "behaviors/mission.hpp"
#include "common/event.hpp"
#include "flight/given_map.hpp"
#include "flight/system.hpp"
#include "flight/vehicle_memory_file.hpp"
#include "interfaces/flight_summary.hpp"

namespace swiftlet::flight {

/// "2026-11-21_14-03-55", local time.
std::string startedNow();

struct FlightSetup {
  System system;
  behaviors::NodeTypes types = behaviors::missionNodes();  ///< Of the missions.
  std::string mission_file;
  std::shared_ptr<const FlightMap> map = nullptr;  ///< The map to localize in; null: no given map.
  VehicleMemorySetup memory = {};
  std::shared_ptr<const common::TopologicalMap> places = nullptr;  ///< What missions may name; null: nothing.
  bool control_log = false;                                        ///< Whether the run keeps control.tsv.
  bool record_rgbd = false;            ///< Whether the run keeps the frames of the RGB-D camera.
  bool wait = false;                   ///< On the ground, until the operator starts a mission.
  std::filesystem::path out = {};      ///< Folder of the run; empty: a new one, runs/STARTED-MISSION.
  std::string started = startedNow();  ///< For the run's records.
};

struct FlightMission {
  std::string file;  ///< For the run's records; what is flown is the mission read from it.
  behaviors::Mission mission;
  std::vector<autonomy::OfferedMap> maps = {};  ///< Maps that the mission may load.
};

/// Who hears of a flight, and who may end it.
struct FlightHooks {
  std::function<void(const common::Event&)> event = {};
  const std::atomic<bool>* land = nullptr;  ///< Lands every vehicle, as the operator's command does.
  const std::atomic<bool>* stop = nullptr;  ///< Ends the flight from outside, in the air too.
};

struct VehicleResult {
  std::string name;  ///< Empty when it flew alone.
  interfaces::FlightSummary summary;
  std::filesystem::path folder;
  std::optional<std::string> write_failure;

  bool done() const { return summary.outcome == interfaces::Outcome::kDone; }
};

/// The missions of these files, read and checked for the profile. `seed` is that of the particles in the maps that they
/// load. Throws common::InputError with all problems, those of the profile's sensors included.
std::vector<FlightMission> soundMissions(const std::vector<std::string>& files, const FlightSetup& setup, bool has_map,
                                         std::uint64_t seed);

/// Throws common::InputError if the frames of a camera are to be recorded and the vehicle has none.
void requireCamera(const System& system);

/// The folder of the setup, or a new one.
std::filesystem::path folderOf(const FlightSetup& setup);

}  // namespace swiftlet::flight
