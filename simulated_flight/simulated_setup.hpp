// The settings of a simulated flight and its observers, beyond those of any flight.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "common/pose2.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/operator_script.hpp"
#include "flight/flight_setup.hpp"
#include "interfaces/run_folder.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::flight {
class GrootLink;
class WebLink;
}  // namespace swiftlet::flight

namespace swiftlet::simulated_flight {

/// The mission file is that of every vehicle without one of its own.
struct SimulatedSetup : flight::FlightSetup {
  simulation::Scenario scenario = {};  ///< World, starts, weather, seed; the data sheets are taken from the system.
  std::optional<common::Pose2> T_world_given = {};  ///< Of the given map, if it is known; for the score.
  std::vector<evaluation::OperatorStep> operator_steps = {};
  std::vector<evaluation::PhaseConfig> phases = {};
  std::vector<evaluation::EventOrderConfig> event_orders = {};
  bool visual_odometry_alone = false;  ///< The RGB-D camera is tracked without any other sensor, too, for the score.
  double speed = 0.0;                  ///< Times real time; 0: as fast as the machine can.
  double time_limit_s = 1800.0;        ///< Of simulated time.
};

struct FlightProgress {
  std::vector<std::shared_ptr<const common::World>> worlds;  ///< One a vehicle, in the order of the scenario.
  double simulated_s = 0.0;
  double wall_s = 0.0;
};

struct SimulatedHooks : flight::FlightHooks {
  std::function<void(const FlightProgress&)> progress = {};  ///< About ten times a second of wall time.
  flight::WebLink* web = nullptr;                            ///< With a channel for each vehicle.
  flight::GrootLink* groot = nullptr;                        ///< Shows the tree of the first vehicle.
  /// At the end of each vehicle's flight, before the run's last files are written: adds to them what a scorer finds.
  std::function<void(const evaluation::FlightRecord&, const simulation::SimulatedVehicle&, interfaces::FlightEnd&)>
      score = {};
};

}  // namespace swiftlet::simulated_flight
