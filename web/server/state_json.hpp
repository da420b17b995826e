// The world as JSON: one document for /api/state, and for the page the parts that changed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/event.hpp"
#include "common/given_map.hpp"
#include "common/level_map.hpp"
#include "common/world/frontier.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::web {

/// Data of the server that are not in the world.
struct Observation {
  std::uint64_t sequence = 0;             ///< Number of the world.
  double world_age_s = 0.0;               ///< Time since the server first saw the world.
  std::optional<double> camera_age_s;     ///< nullopt before the first camera picture.
  std::optional<double> depth_age_s;      ///< nullopt before the first depth image.
  std::optional<double> realtime_factor;  ///< Simulated seconds per second; nullopt until two worlds were seen.
};

/// An event with its number in the flight's list.
struct NumberedEvent {
  std::uint64_t number = 0;  ///< Counted from 1.
  common::Event event;
};

/// Lengths are in metres to the millimetre, angles in radians. Numbers that are not finite become null, and so does the
/// explored area while nothing was explored. A vehicle is named, in the state and in its events, only if it has a name.
std::string stateJson(const common::World& world, const Observation& observation);
std::string frontiersJson(const std::vector<common::Frontier>& frontiers, double resolution_m);
std::string levelsJson(const common::LevelMap& levels);
/// Where the tiles of the given map lie in its frame; null without one.
std::string givenMapJson(const common::GivenMap* given);
/// The points from `from` on; the page puts them after the first `from` it has.
std::string trailJson(std::span<const Eigen::Vector2d> trail_map_m, std::size_t from);
std::string eventsJson(std::span<const NumberedEvent> events);

/// The whole state in one object.
std::string completeJson(const common::World& world, const Observation& observation,
                         std::span<const NumberedEvent> events);

/// What a page needs once. `vehicles`: the names of several, of which the page shows `vehicle`; empty for one.
std::string helloJson(const std::string& title, double hull_diameter_m, const std::vector<std::string>& vehicles,
                      const std::string& vehicle);

}  // namespace swiftlet::web
