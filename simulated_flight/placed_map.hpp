// The map that a simulated flight is given, with its place in the world.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "common/pose2.hpp"
#include "flight/given_map.hpp"
#include "simulation/survey.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulated_flight {

struct PlacedMap {
  std::shared_ptr<const flight::FlightMap> map;  ///< Null: no map is given.
  std::optional<common::Pose2> T_world_given;    ///< If it is known; for the score.
};

/// A robot on wheels drives through the world, and SLAM makes a map of its scans. The pose of the map in the world is
/// the best fit of the scans' poses to the true ones. Written to `folder` as map.yaml and map.pgm. Throws
/// common::InputError.
PlacedMap surveyedMap(const simulation::SurveyConfig& survey, const simulation::WorldModel& world,
                      const std::filesystem::path& folder);

}  // namespace swiftlet::simulated_flight
