#include "apps/system.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "control/controllers/lqr.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::apps {
namespace {

/// "config/sensors has sick_lms_291, urg_04lx", of the shipped files; empty if there are too many to read.
std::string namesIn(const std::string& folder) {
  constexpr std::size_t kMost = 12;
  std::set<std::string> names;
  std::error_code error;
  for (const std::filesystem::path& data : common::dataFolders())
    for (const auto& entry : std::filesystem::directory_iterator(data / "config" / folder, error))
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  return names.empty() || names.size() > kMost ? "" : fmt::format("config/{} has {}", folder, fmt::join(names, ", "));
}

/// "utm_30lx" -> config/sensors/utm_30lx.yaml; anything with a dot or a slash is a file.
std::string fileFor(const std::string& name, const std::string& folder) {
  if (name.find('/') != std::string::npos || name.find('.') != std::string::npos)
    return common::findData(name).string();
  try {
    return common::findData(std::filesystem::path("config") / folder / (name + ".yaml")).string();
  } catch (const common::InputError& e) {
    common::Problem problem = e.problems().front();
    if (const std::string names = namesIn(folder); !names.empty()) problem.hint = names;
    throw common::InputError(problem);
  }
}

/// What a profile names by `key`: a file of the user is searched for beside the profile first.
std::string namedFile(const std::string& name, const std::string& folder, const std::string& key,
                      const common::SourceLocation& place) {
  const std::filesystem::path beside = std::filesystem::path(place.file).parent_path() / name;
  std::error_code error;
  if (std::filesystem::is_regular_file(beside, error)) return beside.string();
  try {
    return fileFor(name, folder);
  } catch (const common::InputError& e) {
    common::Problem problem = e.problems().front();
    problem.message = fmt::format("{}: {}", name, problem.message);
    problem.element = key;
    problem.location = place;
    throw common::InputError(problem);
  }
}

constexpr std::string_view kBasedOn =
    "Another profile, or a path, of which this one differs in the settings that it names; a list is given whole.";

/// Reads a profile over those that it is based on. `chain` are the files that are being read.
common::config::YamlReader readProfile(const std::string& file, SystemConfig& config, std::vector<std::string> chain) {
  common::config::YamlReader reader = common::config::YamlReader::fromFile(file);
  std::string base;
  reader("based_on", base, kBasedOn);
  chain.push_back(file);
  if (!base.empty()) {
    const common::SourceLocation place = reader.locationOf("based_on");
    const std::string base_file = namedFile(base, "systems", "based_on", place);
    // One file may be named in many ways, `a.yaml` and `./a.yaml`.
    std::error_code error;
    if (std::any_of(chain.begin(), chain.end(),
                    [&](const std::string& above) { return std::filesystem::equivalent(above, base_file, error); }))
      throw common::InputError(common::Problem{place, "based_on",
                                               fmt::format("{} is based on this profile itself", base),
                                               "name another one, or leave based_on out"});
    (void)readProfile(base_file, config, std::move(chain));
  }
  reader.read(config);
  if (reader.writtenKeys().empty())
    throw common::InputError(
        common::Problem{{file}, "", "names no setting, so it is no profile", "the least one is `based_on: swiftlet`"});
  config.based_on.clear();
  return reader;
}

/// A flight never starts half configured: a model of another vehicle or battery, or a controller without its model.
void refuseUnfitModel(const System& system, const common::config::YamlReader& profile) {
  std::vector<common::Problem> problems;
  if (system.model)
    for (const std::string& problem : system.model->problemsFor(system.vehicle))
      problems.push_back({profile.locationOf("vehicle_model"), "vehicle_model",
                          fmt::format("{}: {}", system.config.vehicle_model, problem), ""});
  const bool needs_model = system.config.autonomy.control.controller.kind == control::ControllerKind::kLqr;
  if (needs_model && !(system.model && system.model->hasAxes()))
    problems.push_back({profile.locationOf("autonomy.control.controller.kind"), "autonomy.control.controller.kind",
                        system.model
                            ? fmt::format("lqr needs every axis, but {} lacks some", system.config.vehicle_model)
                            : std::string("lqr needs a vehicle_model, and the profile names none"),
                        fmt::format("`swiftlet identify` makes one from flights of `{}`", system.vehicle.name)});
  else if (needs_model)
    for (const std::string& problem :
         control::Lqr::problemsOf(system.config.autonomy.control.controller.lqr, *system.model))
      problems.push_back({profile.locationOf("autonomy.control.controller.lqr"), "autonomy.control.controller.lqr",
                          problem, "weights nearer to the default ones"});
  if (!problems.empty()) throw common::InputError(std::move(problems));
}

/// One sensor makes the 3D map, and an upright laser has no mirror, whose beams would be placed wrongly.
void refuseUnfitVerticalLaser(const System& system, const common::config::YamlReader& profile) {
  if (!system.vertical_laser) return;
  const common::SourceLocation place = profile.locationOf("vertical_laser");
  if (system.rgbd_camera)
    throw common::InputError(common::Problem{place, "vertical_laser",
                                             "one sensor makes the 3D map, and the profile names an rgbd_camera too",
                                             "leave out one of the two"});
  if (system.vertical_laser->mirror_beams > 0)
    throw common::InputError(
        common::Problem{place, "vertical_laser",
                        fmt::format("{} has a mirror ({} beams), and an upright laser has none",
                                    system.config.vertical_laser, system.vertical_laser->mirror_beams),
                        "name a sheet such as `utm_30lx_upright`"});
}

/// Puts "# " before every line.
std::string asComment(const std::string& yaml) {
  std::string text;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  return text;
}

}  // namespace

void SystemConfig::describe(common::config::Fields& fields) {
  fields("based_on", based_on, kBasedOn);
  fields("vehicle", vehicle, "A file of config/vehicles, without .yaml, or a path.");
  fields("laser", laser, "A file of config/sensors, without .yaml, or a path.");
  fields("rgbd_camera", rgbd_camera,
         "A file of config/sensors, without .yaml, or a path; empty without such a camera.");
  fields(
      "vertical_laser", vertical_laser,
      "A second laser whose scan plane stands upright, which makes the 3D map where there is no RGB-D camera: a file "
      "of config/sensors, without .yaml, or a path; empty without one.");
  fields("vehicle_model", vehicle_model,
         "What `swiftlet identify` found of the vehicle: a file of config/models, without .yaml, or a path; empty "
         "without one.");
  fields.section("autonomy", autonomy, "How the autonomy is set.");
  fields.section("log_motion", log_motion, "Recorded logs: what the next step of the robot is expected to be.");
}

std::string System::toYaml(bool comments) const {
  using common::config::YamlPrinter;
  if (!comments) return YamlPrinter(YamlPrinter::Comments::kNo).print(config);
  const auto print = [](const auto& any) { return YamlPrinter(YamlPrinter::Comments::kYes).print(any); };
  std::string sheets = "\n# The data sheets these name:\n#\n# vehicle " + config.vehicle + "\n" +
                       asComment(print(vehicle)) + "#\n# laser " + config.laser + "\n" + asComment(print(laser));
  if (rgbd_camera) sheets += "#\n# rgbd_camera " + config.rgbd_camera + "\n" + asComment(print(*rgbd_camera));
  if (vertical_laser)
    sheets += "#\n# vertical_laser " + config.vertical_laser + "\n" + asComment(print(*vertical_laser));
  return print(config) + sheets;
}

System loadSystem(const std::string& name) {
  System system;
  system.name = name;
  const common::config::YamlReader reader = readProfile(fileFor(name, "systems"), system.config, {});
  const auto sheet = [&](const std::string& named, const char* folder, const char* key) {
    return namedFile(named, folder, key, reader.locationOf(key));
  };
  system.vehicle = common::config::readFile<common::VehicleConfig>(sheet(system.config.vehicle, "vehicles", "vehicle"));
  system.laser = common::config::readFile<common::LaserConfig>(sheet(system.config.laser, "sensors", "laser"));
  if (!system.config.rgbd_camera.empty())
    system.rgbd_camera =
        common::config::readFile<common::RgbdCameraConfig>(sheet(system.config.rgbd_camera, "sensors", "rgbd_camera"));
  if (!system.config.vertical_laser.empty())
    system.vertical_laser =
        common::config::readFile<common::LaserConfig>(sheet(system.config.vertical_laser, "sensors", "vertical_laser"));
  if (!system.config.vehicle_model.empty())
    system.model =
        common::config::readFile<control::VehicleModel>(sheet(system.config.vehicle_model, "models", "vehicle_model"));
  refuseUnfitModel(system, reader);
  refuseUnfitVerticalLaser(system, reader);
  system.config.autonomy.limitTo(system.laser);
  return system;
}

perception::LaserSlamConfig laserSlamOf(const System& system) {
  const autonomy::EstimatorConfig& estimator = system.config.autonomy.estimator;
  perception::LaserSlamConfig config;
  config.front_end.odometry = estimator.laser.odometry;
  config.front_end.motion = system.config.log_motion;
  config.slam = estimator.slam;
  return config;
}

common::LaserConfig loadLaser(const std::string& name) {
  return common::config::readFile<common::LaserConfig>(fileFor(name, "sensors"));
}

common::VehicleConfig loadVehicle(const std::string& name) {
  return common::config::readFile<common::VehicleConfig>(fileFor(name, "vehicles"));
}

std::vector<std::string> systemNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(common::findData("config/systems")))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace swiftlet::apps
