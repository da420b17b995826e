// The map of the place that a flight is given.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "autonomy/estimation/flight_localizer.hpp"
#include "common/geometry.hpp"
#include "interfaces/files/map_server.hpp"
#include "simulation/survey.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::apps {

struct FlightMap {
  std::string name;        ///< As the user gave it; for the run's record.
  autonomy::GivenMap map;  ///< Its grid is shared by flights.
  /// Where it lies in the simulated world, where that is known: for the score.
  std::optional<common::Pose2> T_world_given;
};

/// Throws common::InputError where the file is no map, or none one could be localized in.
interfaces::StoredMap readUsableMap(const std::filesystem::path& yaml_file);
/// The same, to be given to flights.
FlightMap readFlightMap(const std::filesystem::path& yaml_file);

/// A robot on wheels drives through the world, and its scans become a map by SLAM. It lies in the world where the
/// poses of its scans fit the true ones best. Written to `folder` as map.yaml and map.pgm. Throws common::InputError.
FlightMap surveyedMap(const simulation::SurveyConfig& survey, const simulation::WorldModel& world,
                      const std::filesystem::path& folder);

}  // namespace swiftlet::apps
