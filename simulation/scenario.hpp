// One scripted flight of one vehicle or several: world, starts, wind, people, doors, pushes, hands and faults, and what
// a seed varies. It is the `scenario` section of a trial file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "simulation/doors.hpp"
#include "simulation/fault_config.hpp"
#include "simulation/hand.hpp"
#include "simulation/plant_config.hpp"
#include "simulation/sensors/sensor_config.hpp"

namespace swiftlet::simulation {

class Nature;

/// Seeds are bounded, so that counting on from them does not overflow.
inline constexpr double kGreatestSeed = 1e9;

struct StartConfig {
  bool from_world = true;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double yaw_deg = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

enum class GustModel {
  kGaussMarkov,  ///< Each horizontal component of first order.
  kDryden,       ///< MIL-F-8785C: x of first order, y and z of second order, in the world's frame.
};

struct WindConfig {
  double mean_x_m_s = 0.0;
  double mean_y_m_s = 0.0;
  double gust_m_s = 0.0;
  double gust_time_s = 2.0;
  GustModel model = GustModel::kGaussMarkov;

  void describe(common::config::Fields& fields);
};

/// What a seed varies. Shifts, turns and the wind are uniform within +- the value.
struct Variation {
  double start_position_m = 0.0;
  double start_yaw_deg = 0.0;
  std::vector<double> start_area_world_m;
  std::vector<std::string> obstacles;
  double obstacle_m = 0.3;
  std::vector<std::string> tinted = {};
  double tint = 0.0;
  double light_tint = 0.0;
  double light_dimmed = 0.0;
  double wind_m_s = 0.0;
  double battery_remaining = 0.0;
  std::vector<double> reachable_map_m;
  double flight_height_m = 1.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

enum class WalkerMode {
  kPath,       ///< Walks its points.
  kCrossPath,  ///< Walks across the vehicle's path, some metres ahead, starting where the vehicle can see it.
  kFollow,     ///< Follows the vehicle along its trail.
};
enum class WalkerEnd { kStay, kLeave, kReturn, kLoop };

/// A person. It never yields.
struct WalkerConfig {
  WalkerMode mode = WalkerMode::kPath;
  std::vector<double> path_world_m;
  WalkerEnd at_end = WalkerEnd::kLoop;
  double speed_m_s = 1.0;
  double radius_m = 0.25;
  double height_m = 1.75;
  double start_s = 0.0;
  double distance_m = 2.5;
  double repeat_s = 0.0;
  std::string vehicle = {};
  std::vector<double> speeds_m_s = {};
  double pause_s = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct PushConfig {
  double time_s = 0.0;
  double x_n_s = 0.0;
  double y_n_s = 0.0;
  double z_n_s = 0.0;

  void describe(common::config::Fields& fields);
};

/// The pilot's sticks from `time_s` until the next entry.
struct PilotConfig {
  double time_s = 0.0;
  double roll = 0.0;
  double pitch = 0.0;
  double yaw_rate = 0.0;
  double thrust = 0.0;
  bool takes_over = false;

  void describe(common::config::Fields& fields);
};

/// One vehicle of several. For a single vehicle these settings are those of the scenario itself.
struct ScenarioVehicle {
  std::string name;
  StartConfig start;
  double battery_remaining = 1.0;
  std::vector<PushConfig> pushes;
  std::vector<FaultConfig> faults;
  std::vector<PilotConfig> pilot;
  std::string mission = {};
  std::vector<HandConfig> hands = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct Scenario {
  int seed = 1;
  std::string world;
  std::vector<std::string> model_paths;
  bool allow_incomplete_world = false;
  double indoor_light = 1.0;
  StartConfig start;
  double battery_remaining = 1.0;
  WindConfig wind;
  Variation variation;
  std::vector<WalkerConfig> walkers;
  std::vector<DoorConfig> doors = {};
  std::vector<PushConfig> pushes;
  std::vector<HandConfig> hands;
  std::vector<FaultConfig> faults;
  std::vector<PilotConfig> pilot;
  QuadrotorConfig quadrotor;
  AutopilotConfig autopilot;
  SensorsConfig sensors;
  /// All vehicles, in the order of their numbers. If it is empty, there is one vehicle without a name, with the
  /// `start`, `battery_remaining`, `pushes`, `hands`, `faults` and `pilot` above; otherwise these must have their
  /// defaults.
  std::vector<ScenarioVehicle> vehicles;

  /// The ranges that the plant is drawn from; null: the plant has the default values. It is not read from the file.
  std::shared_ptr<const Nature> nature;
  /// Keys that the scenario's file wrote out ("quadrotor.motor_lag_s"); a nature leaves them as they are.
  std::vector<std::string> written;

  /// The data sheets, which the autonomy also knows. They come from the system profile, not from the scenario's file.
  common::VehicleConfig vehicle;
  common::LaserConfig laser;
  std::optional<common::RgbdCameraConfig> rgbd_camera;  ///< Of vehicles that carry one.
  std::optional<common::LaserConfig> vertical_laser;    ///< Of vehicles that carry one.

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;

  /// Gives every vehicle that charge at the start, as if the scenario's file had written it out; nothing varies it.
  void setCharge(double remaining);
  std::size_t vehicleCount() const { return vehicles.empty() ? 1 : vehicles.size(); }
  /// The number of the vehicle with that name, which must exist; 0 for an empty name.
  std::size_t vehicleNumber(const std::string& name) const;
  /// This scenario with that vehicle alone: its start, charge, pushes, hands, faults and pilot, and no `vehicles`.
  Scenario withVehicleAlone(std::size_t number) const;
};

}  // namespace swiftlet::simulation
