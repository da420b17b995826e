// The map of the place that a flight is given, read from its file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "autonomy/estimation/flight_localizer.hpp"
#include "autonomy/map_shelf.hpp"
#include "common/error.hpp"
#include "interfaces/files/map_server.hpp"

namespace swiftlet::flight {

struct FlightMap {
  autonomy::GivenMap map;                   ///< The map, with the name that the user gave it; flights share its grid.
  std::vector<common::Problem> notes = {};  ///< What is odd about its files.
};

/// Throws common::InputError if the file is not a map, or is a map in which nothing can be localized.
interfaces::StoredMap readUsableMap(const std::filesystem::path& yaml_file);
/// The file of a map that a mission names: beside the mission's own file, or where data is. Throws common::InputError.
std::filesystem::path missionMap(const std::string& map, const std::string& mission_file);
/// What is odd about the files of maps that a mission may load. Throws common::InputError.
std::vector<common::Problem> mapNotes(const std::vector<std::string>& maps, const std::string& mission_file);
/// The maps that a mission may load, in the order in which it names them. Throws common::InputError.
std::vector<autonomy::OfferedMap> offeredMaps(const std::vector<std::string>& maps, const std::string& mission_file,
                                              std::uint64_t seed);

/// The map of a file. Throws common::InputError.
FlightMap readFlightMap(const std::filesystem::path& yaml_file);

}  // namespace swiftlet::flight
