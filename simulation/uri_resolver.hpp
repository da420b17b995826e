// Finds the files to which `model://`, `file://`, relative and Gazebo Fuel URIs of an SDF file refer.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulation/fuel_address.hpp"

namespace swiftlet::simulation {

class UriResolver {
 public:
  /// Searches in this order: `model_paths`, the folders of the environment's SDF_PATH, GZ_SIM_RESOURCE_PATH,
  /// IGN_GAZEBO_RESOURCE_PATH, GAZEBO_MODEL_PATH and GAZEBO_RESOURCE_PATH, the folder of `sdf_file`, the folders
  /// `models` and `media` in it and in the one above, the working folder, and what Gazebo downloaded:
  /// GZ_FUEL_CACHE_PATH, IGN_FUEL_CACHE_PATH, ~/.gz/fuel, ~/.ignition/fuel and ~/.gazebo/models.
  UriResolver(const std::filesystem::path& sdf_file, const std::vector<std::string>& model_paths);

  /// The file or folder of a URI in the file `used_in`; nullopt if it does not exist. An address of Fuel is
  /// found in a cache of Fuel, whatever the case of its letters, or in a folder that has a folder of the model's name.
  /// A `model://` that is nowhere else is found in a cache of Fuel, if only one owner there has a model of that name.
  std::optional<std::filesystem::path> find(const std::string& uri, const std::filesystem::path& used_in = {}) const;

  /// What the user can do about a URI that was not found: a name that differs by case, or where to put the file.
  std::string hintFor(const std::string& uri, const std::filesystem::path& used_in = {}) const;

 private:
  struct Place {
    std::filesystem::path folder;
    std::string path;
  };
  std::vector<Place> placesOf(const std::string& uri, const std::filesystem::path& used_in) const;
  std::optional<std::filesystem::path> findFuel(const FuelAddress& address) const;

  std::vector<std::filesystem::path> folders_;
};

}  // namespace swiftlet::simulation
