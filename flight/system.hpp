// A system profile: vehicle, laser, and the settings of the autonomy. config/systems/NAME.yaml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/autonomy_config.hpp"
#include "common/config_fwd.hpp"
#include "common/error.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/vehicle_config.hpp"
#include "control/vehicle_model.hpp"
#include "interfaces/flight_summary.hpp"
#include "perception/laser_odometry/motion_prediction.hpp"

namespace swiftlet::perception {
struct LaserSlamConfig;
}  // namespace swiftlet::perception

namespace swiftlet::flight {

struct SystemConfig {
  std::string based_on = {};
  std::string vehicle = "cobra";
  std::string laser = "utm_30lx";
  std::string rgbd_camera = {};
  std::string vertical_laser = {};
  std::string vehicle_model = {};
  autonomy::AutonomyConfig autonomy;
  perception::MotionPredictionConfig log_motion;

  void describe(common::config::Fields& fields);
};

struct System {
  std::string name;
  SystemConfig config;
  common::VehicleConfig vehicle;
  common::LaserConfig laser;
  std::optional<common::RgbdCameraConfig> rgbd_camera;
  std::optional<common::LaserConfig> vertical_laser;
  std::optional<control::VehicleModel> model;
  /// The files of the sheets and of the model that are not shipped, by the keys of the profile that name them.
  std::map<std::string, std::string> own_files;
  common::SourceLocation laser_place;  ///< Where the profile, or one that it is based on, names the laser.

  /// An RGB-D camera: the pairs of a stereo camera have no depths.
  bool hasDepthCamera() const { return rgbd_camera && !rgbd_camera->isStereo(); }

  /// The effective profile as YAML that loadSystem can read; with comments, it includes the data sheets that it names.
  std::string toYaml(bool comments) const;

  /// The sheets of the user and the model for the folder of a profile, where `namingKeptSheets` finds them.
  std::vector<interfaces::RunText> keptSheets() const;
  System namingKeptSheets() const;
  /// Names the sheets of the user by absolute paths, so that the profile may be kept in another folder.
  System namingSheetsByPath() const;
};

/// `name` is a profile of config/systems or a file. The profile that it is based on is read first. Field of view and
/// range of the autonomy are limited to those of the laser. Throws common::InputError, with the place in the profile,
/// also for a model that does not fit the vehicle and a controller that lacks its model.
System loadSystem(const std::string& name);

/// Why the controller lqr cannot fly this system: messages and hints without places; empty if it can.
std::vector<common::Problem> problemsOfLqr(const System& system);

/// Why the sensors of this system cannot carry a flight, each with the place in the profile; empty if they can. They
/// may serve for logs nevertheless.
std::vector<common::Problem> problemsOfSensors(const System& system);

/// `name` is a data sheet of config/sensors or a file. Throws common::InputError.
common::LaserConfig loadLaser(const std::string& name);

/// `name` is a data sheet of config/vehicles or a file. Throws common::InputError.
common::VehicleConfig loadVehicle(const std::string& name);

/// SLAM with a laser that is carried level, with the profile's odometry and SLAM.
perception::LaserSlamConfig laserSlamOf(const System& system);

/// The names of the shipped profiles.
std::vector<std::string> systemNames();

}  // namespace swiftlet::flight
