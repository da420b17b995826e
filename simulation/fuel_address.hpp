// Addresses of Gazebo Fuel, such as https://fuel.gazebosim.org/1.0/OpenRobotics/models/Oak Tree/3 or the same with
// fuel://, and where they lie in a folder: https://gazebosim.org/api/fuel_tools has the layout of its cache.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/file_address.hpp"

namespace swiftlet::simulation {

struct FuelAddress {
  std::string server;  ///< "fuel.gazebosim.org"
  std::string owner;
  std::string name;     ///< Of the model, "Oak Tree".
  std::string version;  ///< Empty: the newest.
  std::string inside;   ///< Path of a file in the model; empty for the model itself.
};

/// nullopt if the URI is not the address of a model.
std::optional<FuelAddress> fuelAddress(std::string_view uri);

using common::percentDecoded;

/// `relative` below `folder`, each part in whatever case it is there; none if there is no such file or folder.
std::optional<std::filesystem::path> findIgnoringCase(const std::filesystem::path& folder,
                                                      const std::filesystem::path& relative);

/// The model's folder if `folder` is a cache of Fuel, a part of one, or holds a copy of the model under its name.
std::optional<std::filesystem::path> findModelOfFuel(const std::filesystem::path& folder, const FuelAddress& address);

/// The folder of the newest version, if `model` holds a folder for each version as a cache of Fuel does; else `model`.
std::filesystem::path newestIn(const std::filesystem::path& model);

/// The model of that name if `folder` is a cache of Fuel and only one owner in it has such a model.
std::optional<std::filesystem::path> findNameInFuel(const std::filesystem::path& folder, const std::string& name);

/// The versions of the model that such a folder holds.
std::set<int> versionsOfFuel(const std::filesystem::path& folder, const FuelAddress& address);

}  // namespace swiftlet::simulation
