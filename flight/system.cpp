#include "flight/system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "autonomy/flight_sensors.hpp"
#include "autonomy/health/checks.hpp"
#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "common/error.hpp"
#include "common/former_settings.hpp"
#include "common/geometry.hpp"
#include "common/misleading.hpp"
#include "common/read_bytes.hpp"
#include "control/controllers/lqr.hpp"
#include "flight/files_of_kind.hpp"
#include "perception/recognition/house_model.hpp"
#include "perception/recognition/known_objects.hpp"
#include "perception/slam2d/laser_slam.hpp"

namespace swiftlet::flight {
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

planning::CameraFrustum frustumOf(const common::RgbdCameraConfig& camera) {
  const double across = std::tan(0.5 * camera.field_of_view_deg * common::kRadPerDeg);
  return {across, across * camera.height_px / camera.width_px, camera.mount.pitch_deg * common::kRadPerDeg,
          camera.range_min_m, camera.range_max_m};
}

bool isPath(const std::string& name) { return name.find_first_of("/.") != std::string::npos; }

bool isShipped(const std::string& folder, const std::string& file) {
  const std::vector<std::filesystem::path> folders = common::dataFolders();
  return std::any_of(folders.begin(), folders.end(), [&](const std::filesystem::path& data) {
    std::error_code error;
    return std::filesystem::exists(data / "config" / folder / file, error);
  });
}

/// "utm_30lx" -> config/sensors/utm_30lx.yaml; anything with a dot or a slash is a file.
std::string fileFor(const std::string& name, const std::string& folder) {
  try {
    if (isPath(name)) return common::findData(name).string();
    return common::findData(std::filesystem::path("config") / folder / (name + ".yaml")).string();
  } catch (const common::InputError& e) {
    common::Problem problem = e.problems().front();
    const std::filesystem::path file(name);
    const bool could_be_ours = !file.has_parent_path() && file.extension() == ".yaml";
    if (common::misleadingIn(name)) throw;
    if (!isPath(name)) {
      if (const std::string names = namesIn(folder); !names.empty()) problem.hint = names;
    } else if (could_be_ours && isShipped(folder, name)) {
      problem.hint = fmt::format("did you mean `{}`?", file.stem().string());
    }
    throw common::InputError(problem);
  }
}

/// What a profile names by `key`: a file of the user is searched for beside the profile first.
std::string namedFile(const std::string& name, const std::string& folder, const std::string& key,
                      const common::SourceLocation& place) {
  const std::filesystem::path beside = std::filesystem::path(place.file).parent_path() / name;
  std::error_code error;
  const bool there = std::filesystem::exists(beside, error);
  // What is there and cannot be followed, such as a loop of links, is not searched elsewhere: its reader reports why.
  if (error || (there && std::filesystem::is_regular_file(beside, error))) return beside.string();
  try {
    return fileFor(name, folder);
  } catch (const common::InputError& e) {
    common::Problem problem = e.problems().front();
    problem.message = problem.message.behind(name + ": ");
    problem.element = key;
    problem.location = place;
    throw common::InputError(problem);
  }
}

constexpr std::string_view kBasedOn =
    "Another profile, or a path, of which this one differs in the settings that it names; a list is given whole.";

/// Where the settings of a profile are written: each in the profile itself or in one that it is based on.
class ProfilePlaces {
 public:
  void add(const common::config::YamlReader& reader) {
    for (const std::string& key : reader.writtenKeys()) places_[key] = reader.locationOf(key);
  }
  void setFile(std::string file) { file_ = std::move(file); }
  /// The profile without a line for a setting that is in none of the files.
  common::SourceLocation of(const std::string& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? common::SourceLocation{file_} : place->second;
  }

 private:
  std::string file_;
  std::map<std::string, common::SourceLocation> places_;
};

/// Reads a profile over those that it is based on. `chain` are the files that are being read.
void readProfile(const std::string& file, SystemConfig& config, ProfilePlaces& places, std::vector<std::string> chain) {
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
      throw common::InputError(place, "based_on",
                               common::Message("profile.circle", "{} is based on this profile itself", base),
                               "name another one, or leave based_on out");
    readProfile(base_file, config, places, std::move(chain));
  }
  std::optional<common::FormerSettings> former;
  reader.explainFormerKeys([&](const std::string& path) {
    if (!former) former.emplace(common::findData("config/former_settings.yaml").string());
    return former->whatBecameOf(path);
  });
  reader.read(config);
  if (reader.writtenKeys().empty())
    throw common::InputError({file}, "", common::Message("profile.no-setting", "names no setting, so it is no profile"),
                             "the least one is `based_on: swiftlet`");
  config.based_on.clear();
  places.add(reader);
  places.setFile(file);
}

/// What a profile names by a key: a file of a folder of config, or one of the user.
struct SheetKey {
  const char* key;
  const char* folder;
  std::string SystemConfig::*name;
  bool needed;
};
constexpr std::array<SheetKey, 5> kSheetKeys{{{"vehicle", "vehicles", &SystemConfig::vehicle, true},
                                              {"laser", "sensors", &SystemConfig::laser, true},
                                              {"rgbd_camera", "sensors", &SystemConfig::rgbd_camera, false},
                                              {"vertical_laser", "sensors", &SystemConfig::vertical_laser, false},
                                              {"vehicle_model", "models", &SystemConfig::vehicle_model, false}}};

/// The file of each sheet that the profile names, by key. Those of the user are noted in the system.
std::map<std::string, std::string> findSheets(System& system, const ProfilePlaces& places) {
  std::map<std::string, std::string> files;
  for (const SheetKey& sheet : kSheetKeys) {
    const std::string& name = system.config.*sheet.name;
    if (name.empty() && !sheet.needed) continue;
    const common::SourceLocation place = places.of(sheet.key);
    const std::string& file = files[sheet.key] = namedFile(name, sheet.folder, sheet.key, place);
    // A plain name may be that of a sheet beside the profile too.
    std::error_code error;
    const std::filesystem::path beside = std::filesystem::path(place.file).parent_path() / name;
    if (isPath(name) || file == beside.string())
      system.own_files[sheet.key] = std::filesystem::absolute(file, error).lexically_normal().string();
  }
  return files;
}

std::string keptName(const std::string& key) { return key + ".yaml"; }

/// "pattern-landing.png", "house-home.yaml": the picture of a pattern or the model of a house in a run.
std::string keptPicture(const perception::KnownObjectConfig& object) {
  std::string name = object.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  if (perception::namesHouseModel(object.picture)) return "house-" + name + ".yaml";
  return "pattern-" + name + (object.picture_bytes.starts_with("\x89PNG") ? ".png" : ".jpg");
}

/// A flight never starts half configured: a model of another vehicle or battery, or a controller without its model.
void refuseUnfitModel(const System& system, const ProfilePlaces& places, const common::config::YamlReader* model) {
  std::vector<common::Problem> problems;
  const autonomy::AutonomyConfig& autonomy = system.config.autonomy;
  if (model)
    for (const common::Problem& problem : system.model->problemsFor(system.vehicle))
      problems.push_back({places.of("vehicle_model"), "vehicle_model",
                          problem.message.behind(
                              fmt::format("{}: {}: ", toString(model->locationOf(problem.element)), problem.element)),
                          problem.hint});
  if (autonomy.control.controller.kind == control::ControllerKind::kLqr)
    for (common::Problem& problem : problemsOfLqr(system)) {
      problem.element = "autonomy.control.controller.kind";
      problem.location = places.of(problem.element);
      problems.push_back(std::move(problem));
    }
  if (!problems.empty()) throw common::InputError(std::move(problems));
}

/// One sensor makes the 3D map, and an upright laser has no mirror, whose beams would be placed wrongly.
void refuseUnfitVerticalLaser(const System& system, const ProfilePlaces& places) {
  if (!system.vertical_laser) return;
  const common::SourceLocation place = places.of("vertical_laser");
  if (system.rgbd_camera)
    throw common::InputError(place, "vertical_laser",
                             common::Message("profile.two-sensors-of-3d-map",
                                             "one sensor makes the 3D map, and the profile names an rgbd_camera too"),
                             "leave out one of the two");
  if (system.vertical_laser->mirror_beams > 0)
    throw common::InputError(
        place, "vertical_laser",
        common::Message("profile.upright-mirror", "{} has a mirror ({} beams), and an upright laser has none",
                        system.config.vertical_laser, system.vertical_laser->mirror_beams),
        "name a sheet such as `utm_30lx_upright`");
}

/// Reads the pictures of the patterns that are to be recognized, which are searched for beside the profile first.
void readPatterns(System& system, const ProfilePlaces& places) {
  std::vector<perception::KnownObjectConfig>& objects = system.config.autonomy.estimator.recognition;
  if (objects.empty()) return;
  const std::string key = "autonomy.estimator.recognition";
  const common::SourceLocation place = places.of(key + "[0].name");
  const bool patterns = std::any_of(objects.begin(), objects.end(), [](const auto& one) { return one.isPattern(); });
  if (patterns && !system.rgbd_camera)
    throw common::InputError(
        place, key, common::Message("profile.recognition-blind", "no camera sees the patterns that are recognized"),
        "name an rgbd_camera, such as xtion, or recognize openings alone");
  for (std::size_t i = 0; i < objects.size(); ++i) {
    perception::KnownObjectConfig& object = objects[i];
    if (object.picture.empty()) continue;
    const std::string file =
        namedFile(object.picture, "patterns", key, places.of(fmt::format("{}[{}].picture", key, i)));
    object.picture_bytes = common::readBytes(file);
    std::error_code error;
    object.picture = std::filesystem::absolute(file, error).lexically_normal().string();
  }
  if (const auto known = perception::KnownObjects::create(objects, {}); !known)
    throw common::InputError(place, key, known.error().message, "give another picture");
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

std::vector<interfaces::RunText> System::keptSheets() const {
  using common::config::YamlPrinter;
  std::vector<interfaces::RunText> sheets;
  const auto keep = [&](const char* key, const auto& sheet) {
    if (own_files.contains(key))
      sheets.push_back({keptName(key), "# The " + std::string(key) + " of config.yaml, as it was flown.\n" +
                                           YamlPrinter(YamlPrinter::Comments::kNo).print(sheet)});
  };
  keep("vehicle", vehicle);
  keep("laser", laser);
  if (rgbd_camera) keep("rgbd_camera", *rgbd_camera);
  if (vertical_laser) keep("vertical_laser", *vertical_laser);
  if (model) keep("vehicle_model", *model);
  for (const perception::KnownObjectConfig& object : config.autonomy.estimator.recognition)
    if (!object.picture.empty()) sheets.push_back({keptPicture(object), object.picture_bytes});
  return sheets;
}

System System::namingKeptSheets() const {
  System system = *this;
  for (const SheetKey& sheet : kSheetKeys)
    if (own_files.contains(sheet.key)) system.config.*sheet.name = keptName(sheet.key);
  for (perception::KnownObjectConfig& object : system.config.autonomy.estimator.recognition)
    if (!object.picture.empty()) object.picture = keptPicture(object);
  return system;
}

System System::namingSheetsByPath() const {
  System system = *this;
  for (const SheetKey& sheet : kSheetKeys)
    if (const auto file = own_files.find(sheet.key); file != own_files.end()) system.config.*sheet.name = file->second;
  return system;
}

std::vector<common::Problem> problemsOfLqr(const System& system) {
  const std::string& name = system.config.vehicle_model;
  const std::string hint = fmt::format("`swiftlet identify` makes one from flights of `{}`", system.vehicle.name);
  if (!system.model)
    return {{{}, "", common::Message("lqr.no-model", "lqr needs a vehicle_model, and the profile names none"), hint}};
  if (!system.model->hasAxes())
    return {{{}, "", common::Message("lqr.axes-missing", "lqr needs every axis, but {} lacks some", name), hint}};
  std::vector<common::Problem> problems;
  for (const common::Problem& problem :
       control::Lqr::problemsOf(system.config.autonomy.control.controller.lqr, *system.model))
    problems.push_back({{}, "", messageOf(problem).behind("lqr: "), "weights nearer to the default ones would fit"});
  return problems;
}

std::vector<common::Problem> problemsOfSensors(const System& system) {
  const autonomy::AutonomyConfig& config = system.config.autonomy;
  const autonomy::ScanNeeds needs = {
      .least_beams = perception::ScanMatcher::kMinPoints,
      .longest_silence_s = autonomy::kUnseenHold_s,
      .longest_age_s =
          std::min(config.estimator.fusion.horizontal_timeout_s, config.estimator.fusion.vertical_timeout_s),
      .delay_s = config.scans.latency_s + config.scans.reorder_wait_s,
      .max_rise_m = config.estimator.laser.projection.max_rise_m,
  };
  common::LaserConfig laser = system.laser;
  laser.name = std::filesystem::path(system.config.laser).stem().string();  // A sheet made from another has its name.
  std::vector<common::Problem> problems = autonomy::problemsOfSensors(laser, system.vehicle, needs);
  for (common::Problem& problem : problems) problem.location = system.laser_place;
  return problems;
}

System loadSystem(const std::string& name) {
  System system;
  system.name = name;
  ProfilePlaces places;
  const std::string profile = fileFor(name, "systems");
  refuseOtherKind(profile, "a profile");
  readProfile(profile, system.config, places, {});
  const std::map<std::string, std::string> files = findSheets(system, places);
  system.laser_place = places.of("laser");
  using common::config::readFile;
  system.vehicle = readFile<common::VehicleConfig>(files.at("vehicle"));
  system.laser = readFile<common::LaserConfig>(files.at("laser"));
  if (const auto file = files.find("rgbd_camera"); file != files.end())
    system.rgbd_camera = readFile<common::RgbdCameraConfig>(file->second);
  if (system.rgbd_camera) system.config.autonomy.execution.planning.explorer.camera = frustumOf(*system.rgbd_camera);
  if (const auto file = files.find("vertical_laser"); file != files.end())
    system.vertical_laser = readFile<common::LaserConfig>(file->second);
  std::optional<common::config::YamlReader> model;
  if (const auto file = files.find("vehicle_model"); file != files.end()) {
    model.emplace(common::config::YamlReader::fromFile(file->second));
    model->read(system.model.emplace());
  }
  refuseUnfitModel(system, places, model ? &*model : nullptr);
  refuseUnfitVerticalLaser(system, places);
  readPatterns(system, places);
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

}  // namespace swiftlet::flight
