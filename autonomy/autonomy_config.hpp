// What an autonomy is made of: its settings, data sheets, mission and clock.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "autonomy/arrivals/scan_queue.hpp"
#include "autonomy/energy/energy_monitor.hpp"
#include "autonomy/estimator.hpp"
#include "autonomy/health/supervisor_config.hpp"
#include "autonomy/maneuvers/executor_config.hpp"
#include "autonomy/pilot_assist.hpp"
#include "autonomy/reactive.hpp"
#include "autonomy/vehicle_memory.hpp"
#include "behaviors/mission.hpp"
#include "common/config_fwd.hpp"
#include "common/given_map.hpp"
#include "common/jobs.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::common {
struct TopologicalMap;
}

namespace swiftlet::autonomy {

/// Ticks of the mission's tree a second: a leaf answers within two scans of a laser at 40 Hz.
inline constexpr double kBehaviorRate_hz = 20.0;

/// All settings of the autonomy, read from a system profile (config/systems).
struct AutonomyConfig {
  EstimatorConfig estimator;
  ReactiveConfig reactive;
  ExecutorConfig execution;
  control::FlightController::Config control;
  SupervisorConfig supervisor;
  EnergyConfig energy;
  ScanQueueConfig scans;
  PilotAssistConfig assist;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
  /// Lowers the fields of view and ranges that avoidance and exploration use to those of the laser.
  void limitTo(const common::LaserConfig& laser);
  /// Why the reactive layer would stop the vehicle, or make it retreat, on a path planned at this clearance; empty if
  /// it would not.
  std::vector<common::Problem> problemsWith(double clearance_m) const;
};

/// The parts of an autonomy. The objects of the pointers are read only while it is made, and may be destroyed then.
struct AutonomySetup {
  AutonomyConfig config = {};
  common::VehicleConfig vehicle;  ///< Data sheet of the vehicle; the true plant may differ.
  common::LaserConfig laser;      ///< Data sheet of the level laser.
  behaviors::Mission mission;     ///< The first mission; the operator may start others in its place.
  /// Never null. Runs the jobs, and sets the clock by which they are delivered (common/jobs.hpp).
  std::unique_ptr<common::JobRunner> jobs;
  const common::GivenMap* given = nullptr;  ///< A map to localize in; null: no given map.
  /// Appears in the snapshots and in the events of the loop; empty if there is only one vehicle.
  std::string vehicle_name = {};
  const VehicleMemory* memory = nullptr;  ///< What earlier flights of the vehicle have learned; null: no memory.
  const common::RgbdCameraConfig* camera = nullptr;  ///< Data sheet of an RGB-D camera; null without one.
  const control::VehicleModel* model = nullptr;      ///< The identified model of the vehicle; null: not identified.
  std::shared_ptr<const common::TopologicalMap> places = nullptr;  ///< What missions may name; null: nothing.
  /// Data sheet of a second laser, whose scan plane stands upright; null without one.
  const common::LaserConfig* vertical_laser = nullptr;
};

}  // namespace swiftlet::autonomy
