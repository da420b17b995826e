// The map of the place that a flight is given.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimation/flight_localizer.hpp"
#include "autonomy/map_shelf.hpp"
#include "common/error.hpp"
#include "common/geometry.hpp"
#include "interfaces/files/map_server.hpp"
#include "simulation/survey.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::apps {

struct FlightMap {
  autonomy::GivenMap map;  ///< The map, with the name that the user gave it; flights share its grid.
  /// Its pose in the simulated world, if it is known, for the score.
  std::optional<common::Pose2> T_world_given;
  std::vector<common::Problem> notes = {};  ///< What is odd about its files.
};

/// Throws common::InputError if the file is not a map, or is a map in which nothing can be localized.
interfaces::StoredMap readUsableMap(const std::filesystem::path& yaml_file);
/// The file of a map that a mission names: beside the mission's own file, or where data is. Throws common::InputError.
std::filesystem::path missionMap(const std::string& map, const std::string& mission_file);
/// What is odd about the files of maps that a mission may load. Throws common::InputError.
std::vector<common::Problem> mapNotes(const std::vector<std::string>& maps, const std::string& mission_file);
/// Shows each as "note: ..." where warnings go.
void showNotes(const std::vector<common::Problem>& notes);
/// The maps that a mission may load, in the order in which it names them. Throws common::InputError.
std::vector<autonomy::OfferedMap> offeredMaps(const std::vector<std::string>& maps, const std::string& mission_file,
                                              std::uint64_t seed);

/// The map of a file, with the pose of its origin in the world.
FlightMap readFlightMap(const std::filesystem::path& yaml_file);

/// A robot on wheels drives through the world, and SLAM makes a map of its scans. The pose of the map in the world is
/// the best fit of the scans' poses to the true ones. Written to `folder` as map.yaml and map.pgm. Throws
/// common::InputError.
FlightMap surveyedMap(const simulation::SurveyConfig& survey, const simulation::WorldModel& world,
                      const std::filesystem::path& folder);

}  // namespace swiftlet::apps
