// A system profile: which vehicle and laser, and how the autonomy is set. config/systems/NAME.yaml.
#pragma once

#include <string>
#include <vector>

#include "autonomy/autonomy.hpp"
#include "common/config_fwd.hpp"
#include "common/vehicle_config.hpp"
#include "perception/laser_odometry/motion_prediction.hpp"

namespace swiftlet::perception {
struct LaserSlamConfig;
}  // namespace swiftlet::perception

namespace swiftlet::apps {

struct SystemConfig {
  std::string vehicle = "cobra";
  std::string laser = "utm_30lx";
  autonomy::AutonomyConfig autonomy;
  perception::MotionPredictionConfig log_motion;

  void describe(common::config::Fields& fields);
};

struct System {
  std::string name;
  SystemConfig config;
  common::VehicleConfig vehicle;
  common::LaserConfig laser;

  /// The effective profile as YAML that loadSystem reads back; with comments, also the data sheets it names.
  std::string toYaml(bool comments) const;
};

/// `name` is a profile of config/systems or a file. The autonomy counts on seeing no more than the laser does. Throws
/// common::InputError.
System loadSystem(const std::string& name);

/// `name` is a data sheet of config/sensors or a file. Throws common::InputError.
common::LaserConfig loadLaser(const std::string& name);

/// SLAM with a laser that is carried level, as the profile has odometry and SLAM.
perception::LaserSlamConfig laserSlamOf(const System& system);

/// The names of the profiles that come along.
std::vector<std::string> systemNames();

}  // namespace swiftlet::apps
