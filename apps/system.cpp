#include "apps/system.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "common/data_paths.hpp"

namespace swiftlet::apps {
namespace {

/// "utm_30lx" -> config/sensors/utm_30lx.yaml; anything with a dot or a slash is a file.
std::string fileFor(const std::string& name, const std::string& folder) {
  if (name.find('/') != std::string::npos || name.find('.') != std::string::npos)
    return common::findData(name).string();
  return common::findData(std::filesystem::path("config") / folder / (name + ".yaml")).string();
}

/// Every line behind "# ".
std::string asComment(const std::string& yaml) {
  std::string text;
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  return text;
}

}  // namespace

void SystemConfig::describe(common::config::Fields& fields) {
  fields("vehicle", vehicle, "A file of config/vehicles, without .yaml.");
  fields("laser", laser, "A file of config/sensors, without .yaml.");
  fields.section("autonomy", autonomy, "How the autonomy is set.");
}

std::vector<std::string> SystemConfig::validate() const { return {}; }

std::string System::toYaml(bool comments) const {
  using common::config::YamlPrinter;
  if (!comments) return YamlPrinter(YamlPrinter::Comments::kNo).print(config);
  const auto print = [](const auto& any) { return YamlPrinter(YamlPrinter::Comments::kYes).print(any); };
  return print(config) + "\n# The data sheets these name:\n#\n# vehicle " + config.vehicle + "\n" +
         asComment(print(vehicle)) + "#\n# laser " + config.laser + "\n" + asComment(print(laser));
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
