// The result of the senses at a tick.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "autonomy/energy/energy_monitor.hpp"
#include "autonomy/estimator.hpp"
#include "common/dynamic_obstacle.hpp"
#include "common/geometry.hpp"
#include "common/given_map.hpp"
#include "common/level_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "control/emergency_descent.hpp"

namespace swiftlet::autonomy {

/// A scan that was processed.
struct SeenScan {
  ScanOutcome outcome;
  common::VehicleState state;                   ///< After the scan.
  std::vector<common::DynamicObstacle> people;  ///< What the map does not explain, after the scan.
};

/// A frame of the RGB-D camera that can be used.
struct SeenFrame {
  std::shared_ptr<const common::RgbdFrame> frame;
  common::VehicleState state;  ///< At its arrival.
};

/// The maps, and what is in them.
struct Surroundings {
  std::shared_ptr<const common::OccupancyGrid> grid;            ///< The flight's over the given one.
  std::shared_ptr<const common::OccupancyGrid> grid_for_paths;  ///< See GivenMapOverlay::gridForPaths.
  std::shared_ptr<const common::OccupancyGrid> flown;           ///< The flight's alone.
  std::shared_ptr<const common::GivenMap> given;                ///< Null without one.
  std::optional<common::Pose2> T_map_given;                     ///< nullopt while the vehicle is not localized in it.
  std::optional<common::Localization> localization;             ///< nullopt without a given map.
  std::shared_ptr<const common::LevelMap> levels;
  std::shared_ptr<const common::Map3dLayer> map3d;  ///< Null without a sensor for it.
  std::vector<common::Target> targets;
  std::shared_ptr<const common::ObjectsLayer> objects;  ///< Null unless something is recognized.
};

/// Pointers are valid until the senses get their next input.
struct Percept {
  common::Time now;
  common::VehicleState state;
  std::vector<SeenScan> scans;                   ///< Since the last tick, in the order in which they were measured.
  std::vector<SeenFrame> frames;                 ///< Since the last tick.
  double drift_m = 0.0;                          ///< See DriftMonitor; of the last scan.
  std::optional<control::RawHeight> raw_height;  ///< The newest since the last tick; nullopt without a new one.
  double battery_v = 0.0;                        ///< 0 before the first sample.
  bool ready = false;                            ///< The filter has started.
  bool fusion_diverged = false;
  std::string_view inertial_fault;     ///< Why inertial samples cannot be used; empty if they can.
  bool inertial_contradicted = false;  ///< A part of them is replaced.
  std::string must_land;  ///< Why the vehicle must come down although samples arrive; empty if it need not.
  std::optional<Eigen::Vector3d> acceleration_odom_m_s2;
  Eigen::Vector2d horizon_offset_rad = Eigen::Vector2d::Zero();
  std::optional<Surroundings> around;    ///< At the ticks of the behaviours only.
  const Estimator* estimator = nullptr;  ///< For what is needed rarely, or large: people, surfaces, readiness.
  const EnergyMonitor* consumption = nullptr;
};

}  // namespace swiftlet::autonomy
