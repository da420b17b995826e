#include "apps/system.hpp"

#include <algorithm>
#include <filesystem>

#include "common/data_paths.hpp"

namespace swiftlet::apps {
namespace {

/// "utm_30lx" -> config/sensors/utm_30lx.yaml; anything with a dot or a slash is a file.
std::string fileFor(const std::string& name, const std::string& folder) {
  if (name.find('/') != std::string::npos || name.find('.') != std::string::npos) return name;
  return common::findData(std::filesystem::path("config") / folder / (name + ".yaml")).string();
}

struct Everything {
  SystemConfig config;
  common::VehicleConfig vehicle;
  common::LaserConfig laser;

  void describe(common::config::Fields& fields) {
    fields.section("system", config, "The profile.");
    fields.section("vehicle", vehicle, "The vehicle it names.");
    fields.section("laser", laser, "The laser it names.");
  }
};

}  // namespace

void SystemConfig::describe(common::config::Fields& fields) {
  fields("vehicle", vehicle, "A file of config/vehicles, without .yaml.");
  fields("laser", laser, "A file of config/sensors, without .yaml.");
  fields.section("autonomy", autonomy, "How the autonomy is set.");
}

std::vector<std::string> SystemConfig::validate() const { return {}; }

std::string System::toYaml(bool comments) const {
  using common::config::YamlPrinter;
  return YamlPrinter(comments ? YamlPrinter::Comments::kYes : YamlPrinter::Comments::kNo)
      .print(Everything{config, vehicle, laser});
}

System loadSystem(const std::string& name) {
  System system;
  system.name = name;
  system.config = common::config::readFile<SystemConfig>(fileFor(name, "systems"));
  system.vehicle = common::config::readFile<common::VehicleConfig>(fileFor(system.config.vehicle, "vehicles"));
  system.laser = common::config::readFile<common::LaserConfig>(fileFor(system.config.laser, "sensors"));
  return system;
}

std::vector<std::string> systemNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(common::findData("config/systems")))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace swiftlet::apps
