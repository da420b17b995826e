// Settings that a configuration once had, for the refusal of files that still give them.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace swiftlet::common {

/// Read from a list such as config/former_settings.yaml: the path of each setting, with its value of today and its
/// meaning.
class FormerSettings {
 public:
  /// Throws InputError when the file cannot be read as such a list.
  explicit FormerSettings(const std::string& file);

  /// "is no longer a setting: it is 3.5: Half width of all confidence regions.", or the text for a section all of whose
  /// settings are gone. nullopt for a path that never existed. `path` is such as "autonomy.scans.latency_s".
  std::optional<std::string> whatBecameOf(const std::string& path) const;

 private:
  std::map<std::string, std::string> texts_;  ///< By path.
};

}  // namespace swiftlet::common
