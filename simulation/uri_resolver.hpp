// Finds the files to which `model://`, `file://` and relative URIs of an SDF file refer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swiftlet::simulation {

class UriResolver {
 public:
  /// Searches in this order: `model_paths`, the folders of the environment's SDF_PATH, the folder of `sdf_file`, and
  /// the folders `models` and `media` in it and in the one above.
  UriResolver(const std::filesystem::path& sdf_file, const std::vector<std::string>& model_paths);

  /// The file or folder of a URI in the file `used_in`; none if there is no such file or folder.
  std::optional<std::filesystem::path> find(const std::string& uri, const std::filesystem::path& used_in = {}) const;

  /// The answer for libsdformat: a model's folder or an .sdf file, or an empty string.
  std::string findInclude(const std::string& uri) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace swiftlet::simulation
