// The settings of a simulated flight, its observers, and the result of each vehicle.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/given_map.hpp"
#include "apps/system.hpp"
#include "apps/vehicle_memory_file.hpp"
#include "behaviors/mission.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/operator_script.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/run_folder.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::apps {

class GrootLink;
class WebLink;

struct FlightSetup {
  System system;
  behaviors::NodeTypes types = behaviors::missionNodes();  ///< Of the missions.
  std::string mission_file;                                ///< Of every vehicle without a mission file of its own.
  simulation::Scenario scenario;         ///< World, starts, weather, seed; vehicle and laser are taken from the system.
  std::shared_ptr<const FlightMap> map;  ///< The map to localize in; null: no given map.
  std::vector<evaluation::OperatorStep> operator_steps = {};
  std::vector<evaluation::PhaseConfig> phases = {};
  VehicleMemorySetup memory;
  bool visual_odometry_alone = false;  ///< The RGB-D camera is tracked without any other sensor, too, for the score.
  bool control_log = false;            ///< Whether the run keeps control.tsv.
  bool record_rgbd = false;            ///< Whether the run keeps the frames of the RGB-D camera.
  std::filesystem::path out;
  std::string started;           ///< For the run's records.
  bool wait = false;             ///< On the ground, until the operator starts a mission.
  double speed = 0.0;            ///< Times real time; 0: as fast as the machine can.
  double time_limit_s = 1800.0;  ///< Of simulated time.
  double linger_s = 0.0;         ///< Time on the wall clock to wait after the end, so that a page sees it.
};

struct FlightMission {
  std::string file;  ///< For the run's records; what is flown is the mission read from it.
  behaviors::Mission mission;
  std::vector<autonomy::OfferedMap> maps = {};  ///< Maps that the mission may load.
};

struct FlightProgress {
  std::vector<std::shared_ptr<const common::World>> worlds;  ///< One a vehicle, in the order of the scenario.
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

struct FlightHooks {
  std::function<void(const FlightProgress&)> progress;  ///< About ten times a second of wall time.
  std::function<void(const common::Event&)> event;
  WebLink* web = nullptr;                   ///< With a channel for each vehicle.
  GrootLink* groot = nullptr;               ///< Shows the tree of the first vehicle.
  const std::atomic<bool>* land = nullptr;  ///< Lands every vehicle, as the operator's command does.
  const std::atomic<bool>* stop = nullptr;  ///< Ends the flight from outside, in the air too.
  /// At the end of each vehicle's flight, before the run's last files are written: adds to them what a scorer finds.
  std::function<void(const evaluation::FlightRecord&, const simulation::SimulatedVehicle&, interfaces::FlightEnd&)>
      score;
};

struct VehicleResult {
  std::string name;  ///< Empty when it flew alone.
  interfaces::FlightSummary summary;
  std::filesystem::path folder;
  std::optional<std::string> write_failure;
};

}  // namespace swiftlet::apps
