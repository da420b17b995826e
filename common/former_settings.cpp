#include "common/former_settings.hpp"

#include <yaml-cpp/yaml.h>

#include "common/error.hpp"
#include "common/read_bytes.hpp"
#include "common/yaml_problem.hpp"

namespace swiftlet::common {

FormerSettings::FormerSettings(const std::string& file) {
  try {
    texts_ = loadYaml(yamlText(readText(file, kMostYamlBytes)), file).as<std::map<std::string, std::string>>();
  } catch (const YAML::Exception& error) {
    throw InputError({file}, "", Message("former-settings.not-a-list", "{}", error.what()),
                     "it is a part of the program: install it again");
  }
}

std::optional<std::string> FormerSettings::whatBecameOf(const std::string& path) const {
  const auto setting = texts_.lower_bound(path);
  if (setting == texts_.end()) return std::nullopt;
  if (setting->first == path) return "is no longer a setting: it is " + setting->second;
  if (setting->first.starts_with(path + ".")) return "is no longer a section: what it set is fixed";
  return std::nullopt;
}

}  // namespace swiftlet::common
