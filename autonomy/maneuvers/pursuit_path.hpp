// The path of the next seconds on which a walking person stays in sight and at the right distance, whatever that
// person is likely to do. Dynamic programming over places and time, with the expected loss over what the person may do
// [LaValle, Gonzalez-Banos, Becker, Latombe 1997, "Motion strategies for maintaining visibility of a moving target"].
#pragma once

#include <span>

#include <Eigen/Core>

#include "autonomy/maneuvers/follow_config.hpp"
#include "common/occupancy_grid.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {

/// What a person may do: walk on from a place with a velocity. In `map`.
struct PossibleWalk {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_map_m_s = Eigen::Vector2d::Zero();
  double weight = 1.0;  ///< Positive.
};

/// References are read during the call only.
struct PursuitQuestion {
  const planning::CostMap& costs;
  const common::OccupancyGrid& grid;
  Eigen::Vector2d here_map_m;
  std::span<const PossibleWalk> walks;  ///< At least one.
  /// Where the person walked lately: the map may still show the person there.
  std::span<const Eigen::Vector2d> walked_map_m;
  double distance_m = 2.0;  ///< To be kept from the person.
  double speed_m_s = 0.7;   ///< Of the vehicle.
  PursuitConfig config = {};
  double half_width_m = 0.25;  ///< Of the person.
};

struct PursuitPath {
  /// From here; one point: it is best to stay. In the lethal zone it begins with the escape from there, which is flown
  /// also if it is best to stay behind it.
  planning::Path path;
  double in_sight = 0.0;  ///< Probability that the person is seen from its end, at the end.
};

/// A pure function; safe from any thread.
PursuitPath pursuitPath(const PursuitQuestion& question);

}  // namespace swiftlet::autonomy
